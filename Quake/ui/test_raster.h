// For the tests of this module: draws a DrawList on the CPU, by the rules in Quake/scene/draw_list.h (in order, pixel
// centres, nearest texel, straight alpha), and reads text back.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "base/maths.h"
#include "scene/draw_list.h"
#include "ui/atlas.h"

namespace fb::ui {

class Raster {
 public:
  Raster(int width, int height) : width_(width), height_(height), pixels_(static_cast<std::size_t>(width * height)) {}

  void draw(const scene::DrawList& list) {
    for (const scene::DrawQuad& quad : list.quads) {
      const int right = std::min(width_, static_cast<int>(quad.max.x) + 1);
      const int bottom = std::min(height_, static_cast<int>(quad.max.y) + 1);
      for (int y = std::max(0, static_cast<int>(quad.min.y)); y < bottom; ++y) {
        for (int x = std::max(0, static_cast<int>(quad.min.x)); x < right; ++x) draw_pixel(list, quad, x, y);
      }
    }
  }
  vec3 at(int x, int y) const { return pixels_[static_cast<std::size_t>(y * width_ + x)]; }
  bool lit(int x, int y) const { return at(x, y) != vec3(0.0f); }

  // Reads text back: the character whose glyph is in this cell of `scale` times 8x8 pixels; 0 if there is none. Only
  // shapes are compared, not colours; of characters of equal shape the first is returned, and only codes up to 127 are
  // tried.
  unsigned char character(const Atlas& atlas, int left, int top, int scale = 1) const {
    for (int code = 32; code < 127; ++code) {
      if (matches(atlas, static_cast<unsigned char>(code), left, top, scale)) return static_cast<unsigned char>(code);
    }
    return 0;
  }
  std::string text(const Atlas& atlas, int left, int top, int count, int scale = 1) const {
    std::string line;
    for (int i = 0; i < count; ++i) {
      const unsigned char code = character(atlas, left + 8 * i * scale, top, scale);
      line += code == 0 ? '?' : static_cast<char>(code);
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return line;
  }

 private:
  bool matches(const Atlas& atlas, unsigned char code, int left, int top, int scale) const {
    const auto image = atlas.image();
    const Picture glyph = atlas.glyph(code);
    for (int y = 0; y < 8 * scale; ++y) {
      for (int x = 0; x < 8 * scale; ++x) {
        const bool outside = left + x < 0 || left + x >= width_ || top + y < 0 || top + y >= height_;
        const int texel = (glyph.y + y / scale) * image->width + glyph.x + x / scale;
        const bool ink = code != ' ' && (image->texels[static_cast<std::size_t>(texel)] >> 24u) != 0;
        if (ink != (!outside && lit(left + x, top + y))) return false;
      }
    }
    return true;
  }

  void draw_pixel(const scene::DrawList& list, const scene::DrawQuad& quad, int x, int y) {
    const vec2 point(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    if (point.x < quad.min.x || point.y < quad.min.y || point.x >= quad.max.x || point.y >= quad.max.y) return;
    vec4 color = quad.color;
    if (quad.uv_min != quad.uv_max) {
      const vec2 s = (point - quad.min) / (quad.max - quad.min);
      const vec2 uv = quad.uv_min + s * (quad.uv_max - quad.uv_min);
      const auto column = static_cast<int>(uv.x), row = static_cast<int>(uv.y);
      ASSERT_TRUE(column >= 0 && row >= 0 && column < list.atlas->width && row < list.atlas->height);
      const std::uint32_t texel = list.atlas->texels[static_cast<std::size_t>(row * list.atlas->width + column)];
      color *= vec4(texel & 255u, texel >> 8u & 255u, texel >> 16u & 255u, texel >> 24u) / 255.0f;
    }
    vec3& pixel = pixels_[static_cast<std::size_t>(y * width_ + x)];
    pixel = glm::mix(pixel, vec3(color), color.w);
  }

  int width_, height_;
  std::vector<vec3> pixels_;
};

}  // namespace fb::ui
