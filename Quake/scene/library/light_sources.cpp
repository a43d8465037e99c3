#include "scene/library/light_sources.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>
#include <system_error>

#include "scene/library/asset_builder.h"

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

// Indices into the map's models.
std::set<std::size_t> shown_models(const std::vector<world::Entity>& entities) {
  std::set<std::size_t> shown{0};
  for (const world::Entity& entity : entities) {
    const std::string_view model = entity.text("model");
    std::size_t index = 0;
    if (!model.starts_with('*') || entity.classname().starts_with("trigger_")) continue;
    if (std::from_chars(model.data() + 1, model.data() + model.size(), index).ec == std::errc()) shown.insert(index);
  }
  return shown;
}

}  // namespace

bool has_light_source(const Assets& assets, const std::vector<std::uint32_t>& meshes,
                      const std::vector<world::Entity>& entities, const std::vector<EntityLight>& lamps,
                      const Sky& sky) {
  if (!lamps.empty()) return true;
  std::set<std::uint32_t> materials;
  for (const std::size_t model : shown_models(entities)) {
    if (model >= meshes.size() || meshes[model] == kNone) continue;
    for (const MeshTriangle& triangle : assets.meshes[meshes[model]].triangles) materials.insert(triangle.material);
  }
  const bool shining_sky = sky_shines(assets, entities, sky);
  return std::ranges::any_of(materials,
                             [&](std::uint32_t i) { return glows(assets, assets.materials[i], shining_sky); });
}

}  // namespace fb::scene
