// DrawList: what is drawn over the picture this frame, in order: rectangles of images, glyphs, fills. Coordinates are
// output pixels, origin top left.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "base/maths.h"

namespace fb::scene {

// RGBA8 (sRGB, straight alpha) atlas of everything that 2D drawing uses. Changes rarely; `revision` tells.
struct DrawAtlas {
  int width = 0, height = 0;
  std::vector<std::uint32_t> texels;  // r in the lowest byte
  std::uint64_t revision = 1;
};
struct DrawQuad {
  vec2 min, max;        // output pixels
  vec2 uv_min, uv_max;  // atlas texels; equal: a plain fill
  vec4 color{1.0f};     // sRGB-encoded colour and alpha, multiplies the texel
};
// Part of the output, pixels from its top left.
struct Area {
  uvec2 min{0, 0}, size{0, 0};
  bool operator==(const Area&) const = default;
};
struct DrawList {
  std::shared_ptr<const DrawAtlas> atlas;
  std::vector<DrawQuad> quads;
  Area picture;  // where the picture is shown, which is rendered for this size; black around it. Empty: everywhere
  void clear() {
    quads.clear();
    picture = {};
  }
};

}  // namespace fb::scene
