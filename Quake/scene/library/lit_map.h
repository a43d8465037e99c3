// A map as light has to do with it: what its faces reflect and give, its lamps, suns and sky.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "base/maths.h"
#include "formats/bsp.h"
#include "scene/assets.h"
#include "scene/library/library.h"
#include "scene/library/light_sources.h"
#include "scene/snapshot.h"

namespace fb::scene {

// What light does at faces of a texture.
struct LitSurface {
  std::uint32_t material = kNone;  // kNone: no face has it
  std::string name;
  vec3 reflectance{0.0f}, radiance{0.0f};  // means; radiance at the usual factors of emission
  int style = 0;                           // of the light that it gives
  float fall_scale = 0.0f;                 // Material::cast_fall
};

// A map as it was loaded, with all that is asked of its images: it may be read while others are added.
struct LitMap {
  const formats::Bsp& bsp;
  std::vector<LitSurface> surfaces;  // of Bsp::textures
  std::vector<EntityLight> lamps;
  std::vector<Sun> suns;
  vec3 sky{0.0f}, ambient{0.0f};            // mean radiance of the sky; the even light
  std::vector<EntityLight> darkening;       // lights of negative value, as if they gave light
  std::vector<Submodel> submodels;          // that entities show when the map begins
  const std::atomic<bool>* stop = nullptr;  // work on it ends early, with no result, once this is true

  bool stopped() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }
  const LitSurface* surface_of(const formats::BspFace& face) const;  // null where nothing is drawn
};
// `materials`: of the map's textures.
std::vector<LitSurface> lit_surfaces(const Assets& assets, const std::vector<std::uint32_t>& materials);
// Over its texels, the near layer's where it covers the far one, times its factor.
vec3 mean_of_sky(const Assets& assets, const Sky& sky);

}  // namespace fb::scene
