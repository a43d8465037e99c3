// The openings between a map's leafs: what lies on the plane of a node between a leaf in front of it and one behind.
// Map files do not have them; they are cut from the nodes' planes as light tools cut theirs. Everything here is about
// the world (model 0).
#pragma once

#include <cstdint>
#include <vector>

#include "base/maths.h"
#include "formats/bsp.h"

namespace fb::world {

struct Portal {
  std::uint32_t front = 0, back = 0;  // leafs
  Bounds bounds;                      // of its polygon, units
};

// Whether there is room in a leaf for what moves or shines: neither solid nor sky.
bool is_open(const formats::BspLeaf& leaf);

// All portals between open leafs, in the order of nodes; pieces of less than a tenth of a square unit are left out.
std::vector<Portal> leaf_portals(const formats::Bsp& bsp);

}  // namespace fb::world
