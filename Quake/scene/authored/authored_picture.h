// What QuakeSpasm shows of a map's faces: textures times baked light, glowing texels, liquids and skies whole, fog;
// without models. Made on the host, for comparisons.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/authored/emitters.h"
#include "scene/library/lightmaps.h"
#include "scene/snapshot.h"

namespace fb::scene {

struct AuthoredFog {
  float density = 0.0f;  // QuakeSpasm's
  vec3 color{0.0f};      // as displayed
  float covers = 0.5f;   // of the sky
};

// width x height colours, row-major, top row first: what the display shows as linear Rec.709, a texture as painted is
// its own colour. `style`: how bright each light style is, by number; those beyond are 1. `fov_y` follows from fov_x
// and the size.
std::vector<vec3> authored_picture(const LitMap& map, const Assets& assets, const Sky& sky, const Lightmaps& lightmaps,
                                   const Camera& camera, std::uint32_t width, std::uint32_t height,
                                   const AuthoredFog& fog, const std::vector<float>& styles);

}  // namespace fb::scene
