// A .mat text beside an image: what a texture or a skin is made of beyond its picture. One property a line, a name and
// its numbers apart by blanks; `//` begins a comment.
//
//   index 1.5             index of refraction, 1 to 4: the surface is a smooth interface of glass, the glass behind it
//   color 0.8 0.95 0.9    the share of red, green and blue light that `distance` of it leaves, 0.0001 to 1
//   distance 32           units, 0.001 to 1e6
//   scatter 200           units after which half of the light has been scattered, 0.001 to 1e6
//
// `index` must be there; without `color` nothing is absorbed, without `distance` it is 64, without `scatter` nothing is
// scattered. The format is our own.
#pragma once

#include <string_view>

#include "base/maths.h"
#include "base/result.h"

namespace fb::scene {

struct MaterialText {
  float index = 1.0f;
  vec3 absorption{0.0f};    // 1/unit
  float scattering = 0.0f;  // 1/unit
};

// An error names the file, the line and what is wanted there.
Result<MaterialText> parse_material_text(std::string_view text, std::string_view path);

}  // namespace fb::scene
