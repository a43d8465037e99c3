// Whether a map gives light by itself: by lamps, by sky, by texels that glow. What games add (models, moving lights,
// muzzle flashes) does not count. How much it is does not either: a dark map is meant to be dark.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/assets.h"
#include "scene/library/library.h"
#include "scene/snapshot.h"
#include "world/entity_lump.h"

namespace fb::scene {

// `meshes`: of the map's models, the world's first; kNone where there is nothing to draw. Of submodels those count that
// an entity shows: triggers are not to be seen.
bool has_light_source(const Assets& assets, const std::vector<std::uint32_t>& meshes,
                      const std::vector<world::Entity>& entities, const std::vector<EntityLight>& lamps,
                      const Sky& sky);

}  // namespace fb::scene
