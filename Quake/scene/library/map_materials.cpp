#include "scene/library/map_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace fb::scene {

LiquidMedium liquid_medium(const vec3& color, float alpha, float scatters) {
  const float brightest = std::max({color.x, color.y, color.z, 1e-4f});
  const vec3 weights = vec3(1.0f) - kLiquidTint * color / brightest;
  const float mean = glm::dot(weights, vec3(0.2126f, 0.7152f, 0.0722f));
  const vec3 lost = weights * (std::log(2.0f) * alpha / (mean * kLiquidHalfDepth));
  const float scattering = scatters * std::min({lost.x, lost.y, lost.z});
  return {lost - vec3(scattering), scattering};
}

MapMaterials::MapMaterials(AssetBuilder& builder, const formats::Bsp& bsp, std::string map_path, LiquidAlphas alphas,
                           SurfaceLights surface_lights)
    : builder_(builder),
      bsp_(bsp),
      map_path_(std::move(map_path)),
      alphas_(alphas),
      surface_lights_(std::move(surface_lights)),
      sets_(bsp.textures.size()),
      materials_(bsp.textures.size(), kNone) {}

std::uint32_t MapMaterials::material(std::uint32_t texture) {
  if (texture >= materials_.size()) {
    if (missing_material_ == kNone) {
      Material material;
      material.name = "missing";
      material.emission_kind = EmissionKind::kNone;
      material.frames = {TextureSet{missing_image()}};
      missing_material_ = builder_.add_material(std::move(material));
    }
    return missing_material_;
  }
  if (materials_[texture] != kNone) return materials_[texture];
  const auto animated = animated_in_map(texture);
  if (!animated) return materials_[texture] = make_material(texture);
  const std::string key = fmt::format("{}{}", animated->alternate ? 'a' : '0', animated->base);
  const auto [at, added] = sequences_.try_emplace(key, kNone);
  if (added) at->second = make_material(texture);
  return materials_[texture] = at->second;
}

// Quake 64's maps have textures that are called so without being animated: those that lack a frame (QuakeSpasm).
std::optional<AnimatedName> MapMaterials::animated_in_map(std::uint32_t texture) {
  const auto name = animated_name(bsp_.textures[texture].name);
  if (!name || bsp_.version != formats::BspVersion::kQuake64) return name;
  const auto [complete, added] = complete_.try_emplace(std::string(name->base), true);
  if (added) {
    std::set<int> frames;
    for (const formats::BspTexture& other : bsp_.textures) {
      const auto found = animated_name(other.name);
      if (found && found->base == name->base && !found->alternate) frames.insert(found->frame);
    }
    complete->second = frames.empty() || *frames.rbegin() == static_cast<int>(frames.size()) - 1;
  }
  return complete->second ? name : std::nullopt;
}

std::uint32_t MapMaterials::missing_image() {
  if (missing_image_ == kNone) {
    constexpr int kSize = 16;
    Image image{"missing texture", ImageEncoding::kSrgba, kSize, kSize, {}};
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const bool bright = (x / 8 + y / 8) % 2 == 0;
        const std::array<std::uint8_t, 4> texel =
            bright ? std::array<std::uint8_t, 4>{200, 60, 200, 255} : std::array<std::uint8_t, 4>{30, 30, 30, 255};
        image.texels.insert(image.texels.end(), texel.begin(), texel.end());
      }
    missing_image_ = builder_.add_image(std::move(image));
  }
  return missing_image_;
}

std::vector<std::string> MapMaterials::stems(std::string_view name) const {
  if (name.empty()) return {};
  return {fmt::format("textures/{}/{}", stem_of(map_path_), name), fmt::format("textures/{}", name)};
}

const TextureSet& MapMaterials::texture_set(std::uint32_t index) {
  TextureSet& set = sets_[index];
  if (set.base != kNone) return set;
  const formats::BspTexture& texture = bsp_.textures[index];
  set = builder_.replacement(stems(texture.name), map_path_);
  if (set.base != kNone) {
    // QuakeSpasm forgets the original's glowing texels here; a map would lose its lamps.
    const bool holes = is_alpha_texture(texture.name);
    if (set.luma == kNone && has_fullbright(texture.indices, holes))
      set.luma = builder_.add_image(
          luma_from_indices(builder_.palette(), texture.name, texture.width, texture.height, texture.indices, holes));
  } else if (texture.missing()) {
    set.base = missing_image();
  } else {
    set.base =
        builder_.add_image({texture.name, ImageEncoding::kPalette, texture.width, texture.height, texture.indices});
  }
  return set;
}

std::vector<TextureSet> MapMaterials::sequence(std::string_view base, bool alternate) {
  std::array<std::uint32_t, 10> frames;
  frames.fill(kNone);
  for (std::uint32_t i = 0; i < bsp_.textures.size(); ++i) {
    const auto name = animated_name(bsp_.textures[i].name);
    if (name && name->base == base && name->alternate == alternate) frames[static_cast<std::size_t>(name->frame)] = i;
  }
  std::vector<TextureSet> sets;  // a frame that the map lacks is passed over
  for (const std::uint32_t frame : frames)
    if (frame != kNone) sets.push_back(texture_set(frame));
  return sets;
}

void MapMaterials::fill_liquid(Material& material, LiquidKind kind) const {
  struct Filling {
    bool said;  // by the map
    OpacityFrom from;
    float scatters, index;
  };
  const auto filling = [&]() -> Filling {
    switch (kind) {
      case LiquidKind::kSlime:
        return {alphas_.slime.has_value(), OpacityFrom::kSlime, kSlimeScatters, material.index};
      case LiquidKind::kLava:
        return {alphas_.lava.has_value(), OpacityFrom::kLava, kLavaScatters, kLavaIndex};
      case LiquidKind::kTeleport:
        return {alphas_.teleport.has_value(), OpacityFrom::kTeleport, kTeleportScatters, kTeleportIndex};
      default:
        return {alphas_.water.has_value(), OpacityFrom::kWater, kWaterScatters, material.index};
    }
  }();
  material.flags |= kMaterialWarp | kMaterialLiquid;
  const bool glows = kind == LiquidKind::kLava || kind == LiquidKind::kTeleport;
  if (!glows || material.alpha < 1.0f) material.flags |= kMaterialDielectric;
  const LiquidMedium medium =
      liquid_medium(mean_color(builder_.palette(), builder_.assets().images[material.frames.front().base]),
                    material.alpha, filling.scatters);
  material.absorption = medium.absorption;
  material.scattering = medium.scattering;
  material.index = filling.index;
  if (!filling.said) material.opacity_from = filling.from;
}

std::uint32_t MapMaterials::make_material(std::uint32_t index) {
  const formats::BspTexture& texture = bsp_.textures[index];
  Material material;
  material.name = texture.name;
  if (is_sky_texture(texture.name)) {
    material.emission_kind = EmissionKind::kSky;
    material.emission = vec3(1.0f);
    material.base_color = vec3(0.0f);
    return builder_.add_material(std::move(material));
  }
  if (const auto animated = animated_in_map(index)) {
    material.frames = sequence(animated->base, animated->alternate);
    material.alternate_frames = sequence(animated->base, !animated->alternate);
  } else {
    material.frames = {texture_set(index)};
  }
  const SurfaceLook look = surface_look(texture.name);
  material.roughness = look.roughness;
  material.specular = look.specular;
  material.gloss_by_name = look.specular > 0.0f;
  if (is_alpha_texture(texture.name)) material.flags |= kMaterialAlphaTest;

  bool glows = false, glossy = false;
  for (const auto* sets : {&material.frames, &material.alternate_frames})
    for (const TextureSet& set : *sets) {
      const Image& base = builder_.assets().images[set.base];
      glossy |= set.gloss != kNone;
      glows |= set.luma != kNone || (base.encoding == ImageEncoding::kPalette &&
                                     has_fullbright(base.texels, is_alpha_texture(texture.name)));
    }
  material.emission_kind = glows ? EmissionKind::kFullbright : EmissionKind::kNone;
  material.emission = vec3(1.0f);
  if (glossy && material.specular == 0.0f) material.specular = 0.04f;

  switch (liquid_kind(texture.name)) {
    case LiquidKind::kNone:
      break;
    case LiquidKind::kWater:
      material.alpha = alphas_.water.value_or(1.0f);
      break;
    case LiquidKind::kLava:
      material.alpha = alphas_.lava.value_or(1.0f);
      material.emission_kind = EmissionKind::kLava;
      break;
    case LiquidKind::kSlime:
      material.alpha = alphas_.slime.value_or(1.0f);
      material.emission_kind = EmissionKind::kSlime;
      break;
    case LiquidKind::kTeleport:
      material.alpha = alphas_.teleport.value_or(1.0f);
      material.emission_kind = EmissionKind::kTeleport;
      break;
  }
  const LiquidKind kind = liquid_kind(texture.name);
  if (kind != LiquidKind::kNone) fill_liquid(material, kind);
  // What a text says of water and slime counts as well; how opaque lava and teleporters are it does not say.
  if (kind != LiquidKind::kLava && kind != LiquidKind::kTeleport &&
      builder_.refract(material, stems(texture.name), map_path_))
    material.opacity_from = OpacityFrom::kItself;

  const auto lit = surface_lights_.find(lower_case(texture.name));
  if (lit != surface_lights_.end() &&
      (material.emission_kind == EmissionKind::kNone || material.emission_kind == EmissionKind::kFullbright)) {
    // Every texel glows in its colour, times a factor: a dark texture has a larger one, within bounds.
    const vec3 mean = mean_color(builder_.palette(), builder_.assets().images[material.frames.front().base]);
    material.emission_kind = EmissionKind::kFullbright;
    material.emission = lit->second.radiance / std::max({mean.x, mean.y, mean.z, 0.05f});
    material.switched = lit->second.switched;
    if (material.switched) material.cast_style = lit->second.style;
    for (auto* sets : {&material.frames, &material.alternate_frames})
      for (TextureSet& set : *sets) set.luma = set.base;
  }
  return builder_.add_material(std::move(material));
}

void drop_gloss_by_name(Assets& assets) {
  for (Material& material : assets.materials) {
    const auto has_image = [](const TextureSet& set) { return set.gloss != kNone; };
    if (!material.gloss_by_name || std::ranges::any_of(material.frames, has_image) ||
        std::ranges::any_of(material.alternate_frames, has_image))
      continue;
    material.roughness = 1.0f;
    material.specular = 0.0f;
    material.gloss_by_name = false;
  }
}

}  // namespace fb::scene
