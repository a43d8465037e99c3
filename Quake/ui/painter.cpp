#include "ui/painter.h"

#include <algorithm>

#include "base/check.h"

namespace fb::ui {

int automatic_scale(int output_width, int output_height) {
  return std::max(1, std::min(output_width / 640, output_height / 400));
}

Painter::Painter(scene::DrawList& list, Atlas& atlas, int output_width, int output_height, int scale)
    : list_(list),
      atlas_(atlas),
      scale_(static_cast<float>(scale)),
      width_(output_width / scale),
      height_(output_height / scale) {
  FB_CHECK_LE(1, scale);
}

Painter::~Painter() { list_.atlas = atlas_.image(); }

void Painter::fill(float x, float y, float width, float height, const vec4& color) {
  scene::DrawQuad quad;
  quad.min = scale_ * vec2(x, y);
  quad.max = scale_ * vec2(x + width, y + height);
  quad.uv_min = quad.uv_max = vec2(0.0f);
  quad.color = color;
  list_.quads.push_back(quad);
}

void Painter::picture(float x, float y, const Picture& picture, const vec4& color) {
  this->picture(x, y, static_cast<float>(picture.width), static_cast<float>(picture.height), picture, color);
}

void Painter::picture(float x, float y, float width, float height, const Picture& picture, const vec4& color) {
  scene::DrawQuad quad;
  quad.min = scale_ * vec2(x, y);
  quad.max = scale_ * vec2(x + width, y + height);
  quad.uv_min = vec2(picture.x, picture.y);
  quad.uv_max = quad.uv_min + vec2(picture.width, picture.height);
  quad.color = color;
  list_.quads.push_back(quad);
}

void Painter::character(float x, float y, unsigned char code, const vec4& color) {
  if ((code & 127) == ' ' || code == 0) return;
  picture(x, y, atlas_.glyph(code), color);
}

void Painter::text(float x, float y, std::string_view line, bool gold, const vec4& color) {
  for (const char c : line) {
    const auto code = static_cast<unsigned char>(c);
    character(x, y, gold ? static_cast<unsigned char>(code ^ 128u) : code, color);
    x += static_cast<float>(Atlas::kGlyphSize);
  }
}

}  // namespace fb::ui
