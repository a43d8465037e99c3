// Quake maps: BSP29, BSP2 and 2PSB with every index checked, plus external .ent and .vis. After parsing, every index in
// this structure is in range (a face's edges, an edge's vertices, a node's children, a model's faces, ...), node trees
// have no cycles, and floats are finite; so users need no checks of their own.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/maths.h"
#include "base/result.h"

namespace fb::formats {

enum class BspVersion { kBsp29, kBsp2, k2Psb };

struct BspTexture {
  std::string name;  // as stored, at most 15 characters; empty for a missing one
  int width = 0, height = 0;
  std::vector<std::uint8_t> indices;  // mip 0; empty when the map leaves the texels to a file outside
  bool missing() const { return indices.empty(); }
};
struct BspTexInfo {
  std::array<vec4, 2> axes;  // s = dot(axes[0].xyz, p) + axes[0].w, in texels; t likewise
  std::uint32_t texture;     // valid index, or kNoTexture
  std::uint32_t flags;       // kTexSpecial
};
constexpr std::uint32_t kNoTexture = 0xffffffffu;
constexpr std::uint32_t kTexSpecial = 1;

struct BspPlane {
  vec3 normal;
  float distance;
  std::int32_t type;
};
struct BspFace {
  std::uint32_t plane;
  bool back_side;
  std::uint32_t first_surfedge, surfedge_count;  // surfedges index
  std::uint32_t texinfo;
  std::array<std::uint8_t, 4> styles;
  std::int32_t light_offset;  // bytes into lighting, -1 none
};
struct BspNode {
  std::uint32_t plane;
  std::array<std::int32_t, 2> children;  // >= 0 node, < 0 leaf ~child
  vec3 mins, maxs;
  std::uint32_t first_face, face_count;
};
struct BspLeaf {
  std::int32_t contents;    // CONTENTS_*
  std::int32_t vis_offset;  // bytes into visibility, -1 sees all
  vec3 mins, maxs;
  std::uint32_t first_mark_face, mark_face_count;
  std::array<std::uint8_t, 4> ambient;
};
struct BspClipNode {
  std::uint32_t plane;
  std::array<std::int32_t, 2> children;  // >= 0 clip node, < 0 CONTENTS_*
};
struct BspModel {
  vec3 mins, maxs, origin;
  std::array<std::int32_t, 4> head_nodes;  // [0] node (or ~leaf), [1..3] clip nodes (or contents if negative)
  std::uint32_t visible_leafs;
  std::uint32_t first_face, face_count;
};

enum Contents : std::int32_t {
  kContentsEmpty = -1,
  kContentsSolid = -2,
  kContentsWater = -3,
  kContentsSlime = -4,
  kContentsLava = -5,
  kContentsSky = -6,
  kContentsOrigin = -7,
  kContentsClip = -8,
  kContentsCurrent0 = -9,
  kContentsCurrentDown = -14,
};

struct Bsp {
  BspVersion version = BspVersion::kBsp29;
  std::string entities;
  std::vector<BspPlane> planes;
  std::vector<BspTexture> textures;
  std::vector<vec3> vertices;
  std::vector<BspNode> nodes;
  std::vector<BspTexInfo> texinfos;
  std::vector<BspFace> faces;
  std::vector<BspClipNode> clip_nodes;
  std::vector<BspLeaf> leafs;
  std::vector<std::uint32_t> mark_faces;
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::int32_t> surfedges;  // edge e from 0 to 1, or -e from 1 to 0
  std::vector<BspModel> models;         // [0] is the world
  Bytes visibility;                     // run-length coded rows
  Bytes lighting;
  // BSPX lumps by name (RGBLIGHTING, LMSHIFT, ...): parts of the file kept as they are.
  std::vector<std::pair<std::string, Bytes>> bspx;

  // The k-th vertex of a face, k < surfedge_count.
  const vec3& face_vertex(const BspFace& face, std::uint32_t k) const {
    const std::int32_t e = surfedges[face.first_surfedge + k];
    return e >= 0 ? vertices[edges[static_cast<std::uint32_t>(e)][0]]
                  : vertices[edges[static_cast<std::uint32_t>(-e)][1]];
  }
};

Result<Bsp> parse_bsp(ByteView data, std::string_view name);

// External .vis (VisPatch): the record for `map_name` (as "start.bsp") replaces visibility and the leafs' vis_offset
// and contents-independent leaf data. nullopt when the file has no record for the map.
struct VisRecord {
  Bytes visibility;
  std::vector<BspLeaf> leafs;
};
Result<std::optional<VisRecord>> parse_vis(ByteView data, std::string_view name, std::string_view map_name,
                                           const Bsp& bsp);

}  // namespace fb::formats
