#include "scene/library/sky_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "base/log.h"
#include "scene/library/surface_names.h"

namespace fb::scene {
namespace {

constexpr std::uint8_t kQuake64Cover = 128;  // of a near layer without holes: QuakeSpasm's choice

const formats::BspTexture* find_sky(const formats::Bsp& bsp) {
  for (const formats::BspTexture& texture : bsp.textures)
    if (is_sky_texture(texture.name) && !texture.missing() && texture.width >= 2 && texture.height >= 2)
      return &texture;
  return nullptr;
}

}  // namespace

Sky make_layered_sky(AssetBuilder& builder, const formats::Bsp& bsp, const vec3& dome_radiance) {
  Sky sky;
  const formats::BspTexture* texture = find_sky(bsp);
  if (texture == nullptr) return sky;
  // Quake's are twice as wide as high. Quake 64's, and taller ones, have the near layer above the far one.
  const bool quake64 = bsp.version == formats::BspVersion::kQuake64;
  const bool beside = !quake64 && texture->width >= texture->height;
  const int width = beside ? texture->width / 2 : texture->width;
  const int height = beside ? texture->height : texture->height / 2;
  Image solid{texture->name + " far layer", ImageEncoding::kPalette, width, height, {}};
  Image alpha{texture->name + " near layer", ImageEncoding::kSrgba, width, height, {}};
  const auto index_at = [&](int x, int y) {
    return texture
        ->indices[static_cast<std::size_t>(y) * static_cast<std::size_t>(texture->width) + static_cast<std::size_t>(x)];
  };
  std::size_t covered = 0;  // of 255 for each texel
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      solid.texels.push_back(beside ? index_at(width + x, y) : index_at(x, height + y));
      const std::uint8_t near_index = index_at(x, y);
      const auto& rgb = builder.palette().rgb[near_index];
      const std::uint8_t opaque = quake64 ? kQuake64Cover : near_index == 0 ? 0 : 255;
      covered += opaque;
      alpha.texels.insert(alpha.texels.end(), {rgb[0], rgb[1], rgb[2], opaque});
    }
  const float cover = static_cast<float>(covered) / (255.0f * static_cast<float>(width * height));
  const vec3 mean = glm::mix(mean_color(builder.palette(), solid), mean_color(builder.palette(), alpha), cover);
  const vec3 factor = glm::clamp(dome_radiance / std::max(luminance(mean), 1e-3f), vec3(1.0f), vec3(kMaxSkyFactor));
  sky.mode = SkyMode::kLayers;
  sky.color = factor;
  sky.solid = builder.add_image(std::move(solid));
  sky.alpha = builder.add_image(std::move(alpha));
  return sky;
}

Sky make_box_sky(AssetBuilder& builder, std::string_view name, const Sky& fallback) {
  static constexpr std::array<const char*, 6> kSides{"rt", "bk", "lf", "ft", "up", "dn"};
  Sky sky = fallback;
  bool any = false;
  for (std::size_t i = 0; i < 6; ++i) {
    sky.box[i] = builder.image_file(fmt::format("gfx/env/{}{}", name, kSides[i]), ImageEncoding::kSrgba);
    if (sky.box[i] == kNone)
      sky.box[i] = builder.image_file(fmt::format("gfx/env/{}_{}", name, kSides[i]), ImageEncoding::kSrgba);
    any |= sky.box[i] != kNone;
  }
  if (!any) {
    log_warning("gfx/env/{}: no image of a skybox by this name", name);
    return fallback;
  }
  sky.mode = SkyMode::kBox;
  if (fallback.mode != SkyMode::kLayers) sky.color = vec3(1.0f);
  return sky;
}

}  // namespace fb::scene
