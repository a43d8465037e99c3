// Visibility queries of a server: rows of the map's visibility as sets of leafs, the set around a point that may be on
// either side of a wall's edge, and the leafs that contain an entity's box. Leafs are numbered as in Bsp::leafs; leaf 0
// is the solid one and in no set. Everything here is about the world (model 0).
#pragma once

#include <array>
#include <cstdint>

#include "base/bytes.h"
#include "base/maths.h"
#include "formats/bsp.h"

namespace fb::world {

class LeafSet {
 public:
  // A set of leafs 1 to `leaf_count`: those for which the map has visibility (BspModel::visible_leafs of the world).
  explicit LeafSet(std::uint32_t leaf_count, bool all = false)
      : leaf_count_(leaf_count), rows_((std::size_t{leaf_count} + 7) / 8, all ? 0xff : 0) {}

  // A leaf beyond leaf_count, for which there is no visibility, is always in the set.
  bool contains(std::uint32_t leaf) const {
    if (leaf == 0 || leaf > leaf_count_) return leaf != 0;
    return (rows_[(leaf - 1) / 8] >> ((leaf - 1) % 8) & 1u) != 0;
  }
  std::uint32_t leaf_count() const { return leaf_count_; }
  // Both must be of the same map.
  void add(const LeafSet& other);
  // The map's row of `leaf`. The solid leaf, and one without a row, sees everything; a truncated row sees nothing
  // beyond its end.
  void add_pvs(const formats::Bsp& bsp, std::uint32_t leaf);

 private:
  std::uint32_t leaf_count_;
  Bytes rows_;  // bit i is leaf i + 1, as in the map
};

// The leaf that contains a point, for visibility (Mod_PointInLeaf): here a point on a plane is behind it, while in
// point_in_leaf and in all queries of contents it is in front.
std::uint32_t pvs_leaf(const formats::Bsp& bsp, const vec3& point);

// Mod_LeafPVS.
LeafSet leaf_pvs(const formats::Bsp& bsp, std::uint32_t leaf);
// The leafs that any point within about 8 units may see (SV_FatPVS): the union of the rows of all leafs except solid
// ones that are reached by following both sides of planes that near. A point deep inside solid sees nothing.
LeafSet fat_pvs(const formats::Bsp& bsp, const vec3& point);
// Adds another view point, as engines do for a player and its camera.
void add_fat_pvs(const formats::Bsp& bsp, const vec3& point, LeafSet& set);

// The leafs, except solid ones, that a box touches (SV_FindTouchedLeafs), in the order of the tree, as many as fit.
struct TouchedLeafs {
  static constexpr std::uint32_t kMost = 32;
  std::array<std::uint32_t, kMost> leafs{};
  std::uint32_t count = 0;

  // A box in kMost leafs may be in more, so it counts as visible from everywhere: rotators and tall lifts would
  // disappear otherwise (QuakeSpasm; in Quake they did). A box entirely in solid is visible from nowhere.
  bool visible_in(const LeafSet& set) const;
};
TouchedLeafs touched_leafs(const formats::Bsp& bsp, const Bounds& box);

}  // namespace fb::world
