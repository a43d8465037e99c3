// Lamps that do not hide each other's light. To light tools a lamp is a point that nothing hides but walls; here it is
// a sphere, and mappers put two in one place, of different styles or colours.
#pragma once

#include <vector>

#include "formats/bsp.h"
#include "scene/library/library.h"

namespace fb::scene {

// The same lamps of the same powers. Of two within 4 units of each other one is moved 8 units where there is room; then
// those whose spheres meet are made smaller, so that they hide little of each other. Those alone stay as they are.
std::vector<EntityLight> lamps_apart(const formats::Bsp& bsp, std::vector<EntityLight> lamps);

}  // namespace fb::scene
