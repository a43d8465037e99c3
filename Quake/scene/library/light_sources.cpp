#include "scene/library/light_sources.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string_view>
#include <system_error>

#include "scene/library/asset_builder.h"
#include "scene/library/lights.h"

namespace fb::scene {
namespace {

bool is_black(const vec3& color) { return !(color.x > 0.0f || color.y > 0.0f || color.z > 0.0f); }

bool is_black(const Assets& assets, std::uint32_t image) {
  return image == kNone || is_black(mean_color(assets.palette, assets.images[image]));
}

constexpr std::string_view kSkyboxKeys[] = {"sky", "_sky", "skyname", "_skyname", "qlsky", "_qlsky"};

bool names_skybox(const std::vector<world::Entity>& entities) {
  if (entities.empty()) return false;
  const auto named = [&](std::string_view key) { return !entities.front().text(key).empty(); };
  return std::ranges::any_of(kSkyboxKeys, named);
}

bool sky_shines(const Assets& assets, const std::vector<world::Entity>& entities, const Sky& sky) {
  return !sky.suns.empty() || !is_black(assets, sky.solid) || !is_black(assets, sky.alpha) || names_skybox(entities);
}

bool frame_glows(const Assets& assets, const Material& material, const TextureSet& set) {
  if (material.emission_kind != EmissionKind::kFullbright) return !is_black(assets, set.base);
  if (set.luma != kNone) return !is_black(assets, set.luma);
  return !is_black(mean_glow(assets.palette, assets.images[set.base]));
}

bool glows(const Assets& assets, const Material& material, bool sky) {
  if (material.emission_kind == EmissionKind::kNone) return false;
  if (material.emission_kind == EmissionKind::kSky) return sky;
  const auto shines = [&](const TextureSet& set) { return frame_glows(assets, material, set); };
  return std::ranges::any_of(material.frames, shines) || std::ranges::any_of(material.alternate_frames, shines);
}

// 0 where it names none.
std::uint32_t submodel_of(const world::Entity& entity, std::size_t models) {
  const std::string_view model = entity.text("model");
  std::uint32_t index = 0;
  if (!model.starts_with('*')) return 0;
  const auto read = std::from_chars(model.data() + 1, model.data() + model.size(), index);
  return read.ec == std::errc() && index < models ? index : 0;
}

template <typename Which>
std::vector<std::uint32_t> submodels_where(const std::vector<world::Entity>& entities, std::size_t models,
                                           const Which& which) {
  std::set<std::uint32_t> found;
  for (const world::Entity& entity : entities)
    if (const std::uint32_t index = submodel_of(entity, models); index != 0 && which(entity)) found.insert(index);
  return {found.begin(), found.end()};
}

}  // namespace

bool shows_brush_model(const world::Entity& entity) {
  constexpr int kNotInNormal = 512;  // spawnflags: not in a game of skill 1
  if (entity.classname().starts_with("trigger_") || entity.classname() == "func_episodegate") return false;
  return (entity.integer("spawnflags", 0) & kNotInNormal) == 0;
}

vec3 rest_offset(const world::Entity& entity, const formats::BspModel& model) {
  if (entity.classname() != "func_plat" || entity.has("targetname")) return vec3(0.0f);
  constexpr float kLip = 8.0f;  // of its height, that stays up
  const float height = entity.number("height", 0.0f);
  return {0.0f, 0.0f, -(height != 0.0f ? height : model.maxs.z - model.mins.z - kLip)};
}

std::vector<Submodel> shown_submodels(const std::vector<world::Entity>& entities, const formats::Bsp& map) {
  std::map<std::uint32_t, vec3> found;
  for (const world::Entity& entity : entities)
    if (const std::uint32_t index = submodel_of(entity, map.models.size()); index != 0 && shows_brush_model(entity))
      found.try_emplace(index, rest_offset(entity, map.models[index]));
  std::vector<Submodel> all;
  for (const auto& [index, offset] : found) all.push_back({index, offset});
  return all;
}

std::vector<std::uint32_t> unshadowed_submodels(const std::vector<world::Entity>& entities, std::size_t models) {
  return submodels_where(entities, models, [](const world::Entity& entity) {
    const bool still = entity.classname() == "func_wall" || entity.classname() == "func_illusionary";
    return still && !(entity.number("_shadow", entity.number("shadow", 0.0f)) > 0.0f);
  });
}

std::map<std::uint32_t, vec3> even_light_of_submodels(const std::vector<world::Entity>& entities, std::size_t models) {
  std::map<std::uint32_t, vec3> found;
  for (const world::Entity& entity : entities)
    if (const std::uint32_t index = submodel_of(entity, models); index != 0)
      if (const vec3 light = minimum_light(entity); light != vec3(0.0f)) found.try_emplace(index, light);
  return found;
}

bool has_light_source(const Assets& assets, const std::vector<std::uint32_t>& meshes,
                      const std::vector<world::Entity>& entities, const std::vector<EntityLight>& lamps,
                      const Sky& sky) {
  if (!lamps.empty()) return true;
  std::set<std::uint32_t> materials;
  std::vector<std::uint32_t> models = submodels_where(entities, meshes.size(), shows_brush_model);
  models.push_back(0);
  for (const std::uint32_t model : models) {
    if (model >= meshes.size() || meshes[model] == kNone) continue;
    for (const MeshTriangle& triangle : assets.meshes[meshes[model]].triangles) materials.insert(triangle.material);
  }
  const bool shining_sky = sky_shines(assets, entities, sky);
  return std::ranges::any_of(materials,
                             [&](std::uint32_t i) { return glows(assets, assets.materials[i], shining_sky); });
}

}  // namespace fb::scene
