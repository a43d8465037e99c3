// What can be seen from where, as a server asks it: rows of the map's visibility as sets of leafs, the set around a
// point that may be on either side of a wall's edge, and the leafs that an entity's box lies in. Leafs are numbered as
// in Bsp::leafs; leaf 0 is the solid one and in no set. Everything here is of the world (model 0).
#pragma once

#include <array>
#include <cstdint>

#include "base/bytes.h"
#include "base/maths.h"
#include "formats/bsp.h"

namespace fb::world {

class LeafSet {
 public:
  // Of leafs 1 to `leaf_count`: those that the map's visibility tells of (BspModel::visible_leafs of the world).
  explicit LeafSet(std::uint32_t leaf_count, bool all = false)
      : leaf_count_(leaf_count), rows_((std::size_t{leaf_count} + 7) / 8, all ? 0xff : 0) {}

  // A leaf beyond leaf_count, of which visibility says nothing, is always in.
  bool contains(std::uint32_t leaf) const {
    if (leaf == 0 || leaf > leaf_count_) return leaf != 0;
    return (rows_[(leaf - 1) / 8] >> ((leaf - 1) % 8) & 1u) != 0;
  }
  std::uint32_t leaf_count() const { return leaf_count_; }
  // Both must be of the same map.
  void add(const LeafSet& other);
  // The row of `leaf` from the map; the solid leaf, and one without a row, sees everything. A row that is cut short
  // sees nothing beyond its end.
  void add_pvs(const formats::Bsp& bsp, std::uint32_t leaf);

 private:
  std::uint32_t leaf_count_;
  Bytes rows_;  // bit i is leaf i + 1, as in the map
};

// The leaf that holds a point, for visibility (Mod_PointInLeaf): here a point on a plane is behind it, while
// point_in_leaf and all questions of contents have it in front.
std::uint32_t pvs_leaf(const formats::Bsp& bsp, const vec3& point);

// Mod_LeafPVS.
LeafSet leaf_pvs(const formats::Bsp& bsp, std::uint32_t leaf);
// What any point within 8 units, roughly, may see (SV_FatPVS): the rows of all leafs but solid ones that are reached by
// going down both sides of planes that near. A point deep in solid sees nothing.
LeafSet fat_pvs(const formats::Bsp& bsp, const vec3& point);
// Adds another eye, as engines do for a player and its camera.
void add_fat_pvs(const formats::Bsp& bsp, const vec3& point, LeafSet& set);

// The leafs, without solid ones, that a box lies in (SV_FindTouchedLeafs), in the order of the tree, as many as fit.
struct TouchedLeafs {
  static constexpr std::uint32_t kMost = 32;
  std::array<std::uint32_t, kMost> leafs{};
  std::uint32_t count = 0;

  // A box in kMost leafs may be in more, so it counts as visible from everywhere: rotators and tall lifts would vanish
  // otherwise (QuakeSpasm; Quake hid them). A box in solid alone is seen from nowhere.
  bool visible_in(const LeafSet& set) const;
};
TouchedLeafs touched_leafs(const formats::Bsp& bsp, const Bounds& box);

}  // namespace fb::world
