#include "scene/library/lit_map.h"

#include <algorithm>
#include <utility>

#include "scene/library/asset_builder.h"

namespace fb::scene {
namespace {

vec3 mean_of(const Assets& assets, std::uint32_t image) {
  return image < assets.images.size() ? mean_color(assets.palette, assets.images[image]) : vec3(0.0f);
}

vec3 mean_reflectance(const Assets& assets, const Material& material) {
  if (material.frames.empty()) return material.base_color;
  return material.base_color * mean_of(assets, material.frames.front().base);
}

// The cases are shade_point's (Shaders/lib/material.glsl).
vec3 mean_radiance(const Assets& assets, const Material& material) {
  if (material.frames.empty()) return vec3(0.0f);
  const TextureSet& set = material.frames.front();
  const float factor = usual_emission(material.emission_kind);
  switch (material.emission_kind) {
    case EmissionKind::kFullbright:
      if (set.luma != kNone) return mean_of(assets, set.luma) * material.emission * factor;
      if ((material.flags & kMaterialNoFullbright) != 0 || set.base >= assets.images.size()) return vec3(0.0f);
      return mean_glow(assets.palette, assets.images[set.base]) * material.emission * factor;
    case EmissionKind::kLava:
    case EmissionKind::kSlime:
    case EmissionKind::kTeleport:
      return mean_of(assets, set.base) * material.emission * factor;
    default:
      return vec3(0.0f);
  }
}

}  // namespace

const LitSurface* LitMap::surface_of(const formats::BspFace& face) const {
  const std::uint32_t texture = bsp.texinfos[face.texinfo].texture;
  return texture < surfaces.size() && surfaces[texture].material != kNone ? &surfaces[texture] : nullptr;
}

std::vector<LitSurface> lit_surfaces(const Assets& assets, const std::vector<std::uint32_t>& materials) {
  std::vector<LitSurface> all;
  for (const std::uint32_t index : materials) {
    LitSurface surface;
    if (index < assets.materials.size()) {
      const Material& material = assets.materials[index];
      surface = {index, material.name, mean_reflectance(assets, material), mean_radiance(assets, material)};
    }
    all.push_back(std::move(surface));
  }
  return all;
}

vec3 mean_of_sky(const Assets& assets, const Sky& sky) {
  if (sky.mode == SkyMode::kBlack) return vec3(0.0f);
  const vec3 far_layer = mean_of(assets, sky.solid);
  if (sky.alpha >= assets.images.size()) return far_layer * sky.color;
  const Image& near_layer = assets.images[sky.alpha];
  double cover = 0;
  for (std::size_t i = 3; i < near_layer.texels.size(); i += 4) cover += near_layer.texels[i];
  cover /= 255.0 * static_cast<double>(std::max<std::size_t>(near_layer.texels.size() / 4, 1));
  return glm::mix(far_layer, mean_of(assets, sky.alpha), static_cast<float>(cover)) * sky.color;
}

}  // namespace fb::scene
