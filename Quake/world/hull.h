// Quake's collision hulls: trees of planes whose leafs are contents. A hull was expanded by a certain box, so that
// moving that box through the map is the same as moving a point through the hull. Hull 0 is the map's node tree (for a
// point); 1 and 2 are its clip nodes, for boxes of 32x32x56 and 64x64x88 units. The bounding box of an entity is a hull
// of six planes.
//
// Results must be equal to the last bit: the side of a plane on which a point lies decides what mods' monsters and
// players can do. The order and precision of each operation is Quake's as in QuakeSpasm (hull_plane_distance).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/maths.h"
#include "formats/bsp.h"

namespace fb::world {

// A node together with its plane: one cache line for each step.
struct HullNode {
  vec3 normal{0.0f};
  float distance = 0.0f;
  std::int32_t type = 0;                    // below 3: the normal is that axis
  std::array<std::int32_t, 2> children = {  // in front, behind: >= 0 a node, < 0 CONTENTS_*
      formats::kContentsEmpty, formats::kContentsEmpty};
};

// A view of nodes owned by MapHulls or BoxHull, which must outlive it.
struct Hull {
  std::span<const HullNode> nodes;
  std::int32_t first = formats::kContentsEmpty;  // root; < 0 if everything has the same contents
  vec3 clip_mins{0.0f}, clip_maxs{0.0f};         // of the box by which the hull was expanded
};

constexpr int kHullCount = 3;

// The hulls of every model of a map. Copies the data that it needs from the map.
class MapHulls {
 public:
  explicit MapHulls(const formats::Bsp& bsp);

  std::uint32_t model_count() const { return static_cast<std::uint32_t>(heads_.size()); }
  // `model` below model_count(), `which` 0..2.
  Hull hull(std::uint32_t model, int which) const;

 private:
  std::vector<HullNode> nodes_, clip_nodes_;
  std::vector<std::array<std::int32_t, kHullCount>> heads_;
};

// Which of a map's hulls is used for a moving box of this size: Quake only looks at the width along x.
int hull_for_size(const vec3& size);

// A box from mins to maxs as a hull: solid inside.
class BoxHull {
 public:
  BoxHull(const vec3& mins, const vec3& maxs);
  Hull hull() const { return {nodes_, 0, vec3(0.0f), vec3(0.0f)}; }

 private:
  std::array<HullNode, 6> nodes_;
};

// Distance of a point in front of a node's plane. For planes along an axis one subtraction of floats; for others
// products, sums and the subtraction of the plane's distance in double, rounded to float at the end.
inline float hull_plane_distance(const HullNode& node, const vec3& p) {
  if (node.type < 3) return p[node.type] - node.distance;
  const double dot = static_cast<double>(node.normal.x) * p.x + static_cast<double>(node.normal.y) * p.y +
                     static_cast<double>(node.normal.z) * p.z;
  return static_cast<float>(dot - node.distance);
}

// CONTENTS_* at a point in the hull's space, starting at `node` (SV_HullPointContents): a point on a plane is in front.
inline std::int32_t hull_point_contents(const Hull& hull, std::int32_t node, const vec3& p) {
  while (node >= 0) {
    const HullNode& at = hull.nodes[static_cast<std::size_t>(node)];
    node = at.children[hull_plane_distance(at, p) < 0.0f ? 1 : 0];
  }
  return node;
}
inline std::int32_t hull_point_contents(const Hull& hull, const vec3& p) {
  return hull_point_contents(hull, hull.first, p);
}

// The world's contents at a point (SV_TruePointContents), and with currents reported as water, as QuakeC and the
// physics expect (SV_PointContents).
std::int32_t true_point_contents(const MapHulls& map, const vec3& p);
std::int32_t sv_point_contents(const MapHulls& map, const vec3& p);

}  // namespace fb::world
