#include "world/pvs.h"

#include <algorithm>

#include "base/check.h"

namespace fb::world {
namespace {

using formats::Bsp;
using formats::BspNode;
using formats::BspPlane;

// Floats throughout, summed from the left, as Quake does here (traces use doubles).
float dot(const vec3& a, const vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

float plane_distance(const BspPlane& plane, const vec3& p) { return dot(p, plane.normal) - plane.distance; }

// Bit 0: part of the box is in front, bit 1: behind (BOX_ON_PLANE_SIDE). A box that touches an axis' plane from one
// side is not on the other; one that touches a slanted plane counts in front.
unsigned box_on_plane_side(const Bounds& box, const BspPlane& plane) {
  if (plane.type < 3) {
    if (plane.distance <= box.min[plane.type]) return 1;
    return plane.distance >= box.max[plane.type] ? 2 : 3;
  }
  vec3 foremost, hindmost;
  for (int axis = 0; axis < 3; ++axis) {
    const bool negative = plane.normal[axis] < 0.0f;
    foremost[axis] = (negative ? box.min : box.max)[axis];
    hindmost[axis] = (negative ? box.max : box.min)[axis];
  }
  const unsigned front = dot(plane.normal, foremost) >= plane.distance ? 1 : 0;
  return front | (dot(plane.normal, hindmost) < plane.distance ? 2u : 0u);
}

// Recursion in both functions is at most as deep as the tree: formats::kMaxBspDepth.
void add_fat(const Bsp& bsp, std::int32_t at, const vec3& point, LeafSet& set) {
  constexpr float kFat = 8.0f;  // units
  while (at >= 0) {
    const BspNode& node = bsp.nodes[static_cast<std::size_t>(at)];
    const float d = plane_distance(bsp.planes[node.plane], point);
    if (d > kFat) {
      at = node.children[0];
    } else if (d < -kFat) {
      at = node.children[1];
    } else {
      add_fat(bsp, node.children[0], point, set);
      at = node.children[1];
    }
  }
  const auto leaf = static_cast<std::uint32_t>(~at);
  if (bsp.leafs[leaf].contents != formats::kContentsSolid) set.add_pvs(bsp, leaf);
}

void find_touched(const Bsp& bsp, std::int32_t at, const Bounds& box, TouchedLeafs& found) {
  while (at >= 0 && found.count < TouchedLeafs::kMost) {
    const BspNode& node = bsp.nodes[static_cast<std::size_t>(at)];
    const unsigned sides = box_on_plane_side(box, bsp.planes[node.plane]);
    if (sides == 3) find_touched(bsp, node.children[0], box, found);
    if (sides == 0) return;  // an invalid box or plane is on neither side
    at = node.children[sides == 1 ? 0 : 1];
  }
  if (at >= 0 || found.count == TouchedLeafs::kMost) return;
  const auto leaf = static_cast<std::uint32_t>(~at);
  if (bsp.leafs[leaf].contents != formats::kContentsSolid) found.leafs[found.count++] = leaf;
}

}  // namespace

void LeafSet::add(const LeafSet& other) {
  FB_CHECK_EQ(leaf_count_, other.leaf_count_);
  for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i] |= other.rows_[i];
}

void LeafSet::add_pvs(const Bsp& bsp, std::uint32_t leaf) {
  FB_CHECK_LT(leaf, bsp.leafs.size());
  const std::int32_t offset = bsp.leafs[leaf].vis_offset;
  if (leaf == 0 || offset < 0 || bsp.visibility.empty()) {
    std::ranges::fill(rows_, std::uint8_t{0xff});
    return;
  }
  // A zero byte is followed by the number of zero bytes that it represents.
  std::size_t row = 0;
  for (auto at = static_cast<std::size_t>(offset); row < rows_.size() && at < bsp.visibility.size(); ++at) {
    if (bsp.visibility[at] != 0) {
      rows_[row++] |= bsp.visibility[at];
      continue;
    }
    if (++at == bsp.visibility.size()) return;
    row += bsp.visibility[at];
  }
}

std::uint32_t pvs_leaf(const Bsp& bsp, const vec3& point) {
  std::int32_t at = bsp.models[0].head_nodes[0];
  while (at >= 0) {
    const BspNode& node = bsp.nodes[static_cast<std::size_t>(at)];
    at = node.children[plane_distance(bsp.planes[node.plane], point) > 0.0f ? 0 : 1];
  }
  return static_cast<std::uint32_t>(~at);
}

LeafSet leaf_pvs(const Bsp& bsp, std::uint32_t leaf) {
  LeafSet set(bsp.models[0].visible_leafs);
  set.add_pvs(bsp, leaf);
  return set;
}

void add_fat_pvs(const Bsp& bsp, const vec3& point, LeafSet& set) {
  add_fat(bsp, bsp.models[0].head_nodes[0], point, set);
}

LeafSet fat_pvs(const Bsp& bsp, const vec3& point) {
  LeafSet set(bsp.models[0].visible_leafs);
  add_fat_pvs(bsp, point, set);
  return set;
}

bool TouchedLeafs::visible_in(const LeafSet& set) const {
  if (count == kMost) return true;
  return std::any_of(leafs.begin(), leafs.begin() + count, [&](std::uint32_t leaf) { return set.contains(leaf); });
}

TouchedLeafs touched_leafs(const Bsp& bsp, const Bounds& box) {
  TouchedLeafs found;
  find_touched(bsp, bsp.models[0].head_nodes[0], box, found);
  return found;
}

}  // namespace fb::world
