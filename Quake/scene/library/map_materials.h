// Materials of a map's textures, each made once however many submodels use it: animation sequences, liquids, sky,
// holes, images from files in place of the map's own, and a chequer where there is nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/bsp.h"
#include "scene/library/asset_builder.h"
#include "scene/library/lights.h"
#include "scene/library/surface_names.h"

namespace fb::scene {

// Worldspawn's wateralpha, lavaalpha, slimealpha, telealpha (also with a leading underscore). Without them all are
// opaque, and what fills them is as the player wants it (LiquidOpacity).
struct LiquidAlphas {
  std::optional<float> water, lava, slime, teleport;
};

// What a liquid does to light within it, 1/unit, from its texture's mean colour (linear) and its alpha. The depth
// at which half of white light's luminance is left, neither absorbed nor scattered, is kLiquidHalfDepth / alpha:
// exactly for a grey texture; for a coloured one the mean of the channels' exponents is ln 2 there, which leaves 0.500
// to 0.514. What the texture shows less of is lost sooner. Of the channel that is lost least `scatters` is the share
// that is scattered, and of the others as much; the rest is absorbed.
constexpr float kLiquidHalfDepth = 256.0f, kLiquidTint = 0.5f;
constexpr float kWaterScatters = 0.3f, kSlimeScatters = 0.9f, kLavaScatters = 0.0f, kTeleportScatters = 0.5f;
// Molten basalt refracts about as glass does; a teleporter is no substance.
constexpr float kLavaIndex = 1.5f, kTeleportIndex = 1.0f;
struct LiquidMedium {
  vec3 absorption{0.0f};
  float scattering = 0.0f;
};
LiquidMedium liquid_medium(const vec3& color, float alpha, float scatters);

class MapMaterials {
 public:
  // For maps/start.bsp images are looked for in textures/start/ and then in textures/.
  // `surface_lights`: radiances that the map's _surface lights give to textures (lights.h).
  MapMaterials(AssetBuilder& builder, const formats::Bsp& bsp, std::string map_path, LiquidAlphas alphas,
               SurfaceLights surface_lights);

  // The material of a texture (index into Bsp::textures, or kNoTexture).
  std::uint32_t material(std::uint32_t texture);
  // The same of those that were asked for; kNone of others.
  std::uint32_t known(std::uint32_t texture) const { return materials_[texture]; }

 private:
  const TextureSet& texture_set(std::uint32_t texture);
  std::vector<TextureSet> sequence(std::string_view base, bool alternate);
  std::optional<AnimatedName> animated_in_map(std::uint32_t texture);
  std::vector<std::string> stems(std::string_view name) const;  // of images in place of a texture
  std::uint32_t make_material(std::uint32_t texture);
  void fill_liquid(Material& material, LiquidKind kind) const;
  std::uint32_t missing_image();

  AssetBuilder& builder_;
  const formats::Bsp& bsp_;
  std::string map_path_;
  LiquidAlphas alphas_;
  SurfaceLights surface_lights_;
  std::vector<TextureSet> sets_;                       // a texture; base kNone until made
  std::vector<std::uint32_t> materials_;               // a texture; kNone until made
  std::map<std::string, std::uint32_t> sequences_;     // material of an animation, by "0" or "a" + its base name
  std::map<std::string, bool, std::less<>> complete_;  // of Quake 64's animations, by base name: no frame is missing
  std::uint32_t missing_material_ = kNone, missing_image_ = kNone;
};

// Of materials whose gloss only a texture's name suggests, but for those with an image of it.
void drop_gloss_by_name(Assets& assets);

}  // namespace fb::scene
