// Quake maps: BSP29, BSP2, 2PSB and Quake 64's with every index checked, plus external .ent and .vis. After parsing,
// every index in this structure is in range (a face's edges, an edge's vertices, a node's children, a model's faces,
// ...), node trees have no cycles and are at most kMaxBspDepth deep, and floats are finite, so that users need no
// checks of their own. Two cases remain for the user: a face may have fewer than three edges (draw nothing), and rows
// of visibility or samples of light may extend past the end of their lump (stop there).
//
// A file whose structure contradicts itself is refused. Faults that QuakeSpasm tolerates (a bad texture, a light offset
// beyond the lump, a node whose leaf does not exist, ...) are repaired and listed in `warnings`.
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

// kQuake64: the re-release's Quake 64 maps: BSP29 but for headers of textures and samples of light.
enum class BspVersion { kBsp29, kBsp2, k2Psb, kQuake64 };

constexpr std::uint32_t kMaxBspDepth =
    4096;                                  // of node and clip node trees: the depth that a recursive walk must support
constexpr float kMaxBspCoordinate = 1e6f;  // of a vertex, on each axis
constexpr std::size_t kMostEntityText = 16u << 20u;  // bytes; the largest known maps have five million

struct BspTexture {
  std::string name;                   // as stored, at most 15 characters; empty for an entry that is not there
  int width = 0, height = 0;          // 1..kMaxImageSize; 16x16 for a missing one of unknown size
  std::vector<std::uint8_t> indices;  // mip 0; empty if the texels are in an external file
  int shift = 0;                      // Quake 64; if not 0, a texel covers 2 * shift units of the texture axes
  bool missing() const { return indices.empty(); }
};
struct BspTexInfo {
  std::array<vec4, 2> axes;  // s = dot(axes[0].xyz, p) + axes[0].w, in texels; t likewise
  std::uint32_t texture;     // valid index, or kNoTexture
  std::uint32_t flags;       // kTexSpecial
};
constexpr int kMaxTextureShift = 16;  // the maps have 0 to 2
constexpr std::uint32_t kNoTexture = 0xffffffffu;
constexpr std::uint32_t kTexSpecial = 1;

struct BspPlane {
  vec3 normal;
  float distance;
  std::int32_t type;  // 0..2: normal is that axis; 3..5: any normal
};
struct BspFace {
  std::uint32_t plane;
  bool back_side;
  std::uint32_t first_surfedge, surfedge_count;  // surfedges index; fewer than 3 is possible
  std::uint32_t texinfo;
  std::array<std::uint8_t, 4> styles;
  std::int32_t light_offset;  // in samples of lighting (or of RGBLIGHTING, three bytes each); -1 none
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
  std::uint32_t visible_leafs;             // leafs 1..visible_leafs have visibility; below leafs.size()
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
  std::uint16_t entities_crc =
      0;  // of the lump without its last byte: part of the file name in QuakeSpasm's maps/name@crc.ent
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
  // BSPX lumps by name (RGBLIGHTING, LMSHIFT, ...): unparsed parts of the file. A Quake 64 map's light, which is
  // coloured, is RGBLIGHTING here, and `lighting` is empty.
  std::vector<std::pair<std::string, Bytes>> bspx;
  std::vector<std::string>
      warnings;  // what was repaired: one sentence for each kind of fault, with file and first offset

  // The k-th vertex of a face, k < surfedge_count.
  const vec3& face_vertex(const BspFace& face, std::uint32_t k) const {
    const std::int32_t e = surfedges[face.first_surfedge + k];
    return e >= 0 ? vertices[edges[static_cast<std::uint32_t>(e)][0]]
                  : vertices[edges[static_cast<std::uint32_t>(-e)][1]];
  }
};

// Memory is bounded by a small multiple of data.size().
Result<Bsp> parse_bsp(ByteView data, std::string_view name);

// Whether text of this size is accepted as a map's entities, from its lump or from the .ent file that replaces it.
// `name` starts the error message.
Status check_entity_text(std::size_t size, std::string_view name);

// External .vis (VisPatch, BSP29 and Quake 64 only): the record for `map_name` (as "start.bsp") replaces visibility and
// the leafs' vis_offset and contents-independent leaf data. nullopt if the file has no record for the map.
struct VisRecord {
  Bytes visibility;
  std::vector<BspLeaf> leafs;  // as many as the map has
};
Result<std::optional<VisRecord>> parse_vis(ByteView data, std::string_view name, std::string_view map_name,
                                           const Bsp& bsp);

}  // namespace fb::formats
