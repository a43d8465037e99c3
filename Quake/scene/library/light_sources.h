// Whether a map gives light by itself: by lamps, by sky, by texels that glow. What games add (models, moving lights,
// muzzle flashes) does not count. How much it is does not either: a dark map is meant to be dark.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/assets.h"
#include "scene/library/library.h"
#include "scene/snapshot.h"
#include "formats/bsp.h"
#include "world/entity_lump.h"

namespace fb::scene {

// `meshes`: of the map's models, the world's first; kNone where there is nothing to draw. Of submodels those count that
// an entity shows: triggers are not to be seen.
bool has_light_source(const Assets& assets, const std::vector<std::uint32_t>& meshes,
                      const std::vector<world::Entity>& entities, const std::vector<EntityLight>& lamps,
                      const Sky& sky);

// Whether a game alone, of skill 1 and before any episode is won, shows an entity's brush model when it begins.
bool shows_brush_model(const world::Entity& entity);
// A map's submodel that an entity shows; the world, 0, is none.
struct Submodel {
  std::uint32_t index;
  vec3 offset;  // rest_offset
};
// Ascending, each once.
std::vector<Submodel> shown_submodels(const std::vector<world::Entity>& entities, const formats::Bsp& map);
// Where an entity's model stands when the game begins, beside where the map has it: platforms are drawn up and begin
// down.
vec3 rest_offset(const world::Entity& entity, const formats::BspModel& model);
// Of these, those that light tools let light through and that never move: func_wall and func_illusionary without
// `_shadow`.
// Radiance from everywhere at brush models whose entity has _minlight (_minlight_color, _mincolor), by model.
std::map<std::uint32_t, vec3> even_light_of_submodels(const std::vector<world::Entity>& entities, std::size_t models);
std::vector<std::uint32_t> unshadowed_submodels(const std::vector<world::Entity>& entities, std::size_t models);

}  // namespace fb::scene
