// Which liquid the camera is in, for the light that it sees (FrameSnapshot::camera_liquid): what a map's leafs say of
// the world, and of brush models that hold a liquid, wherever they have moved.
#pragma once

#include <cstdint>

#include "base/maths.h"
#include "formats/bsp.h"
#include "scene/assets.h"
#include "scene/snapshot.h"

namespace fb::cl {

// The world holds water, slime or lava there.
bool liquid_is_at(const formats::Bsp& map, const vec3& point);

// The material of the world's liquid about a point: the first of its kind, since leafs do not say which texture is
// theirs. kNone: there is none, or it has no material that light goes through.
std::uint32_t liquid_of_world(const formats::Bsp& map, const scene::Assets& assets, const scene::LiquidOpacity& opacity,
                              const vec3& point);

// The same of a submodel ("*3" is 3) that is drawn by this mesh and transform: a material of its own. kNone as well
// where the map has no such submodel.
std::uint32_t liquid_of_submodel(const formats::Bsp& map, const scene::Assets& assets,
                                 const scene::LiquidOpacity& opacity, std::uint64_t submodel, std::uint32_t mesh,
                                 const mat4x3& transform, const vec3& point);

}  // namespace fb::cl
