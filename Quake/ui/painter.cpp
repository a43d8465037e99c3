#include "ui/painter.h"

#include <algorithm>

#include "base/check.h"

namespace fb::ui {
Painter::Painter(scene::DrawList& list, Atlas& atlas, const Canvas& canvas)
    : list_(list), atlas_(atlas), canvas_(canvas) {}

Painter::Painter(scene::DrawList& list, Atlas& atlas, int output_width, int output_height, int scale)
    : Painter(list, atlas, screen_canvas({output_width, output_height}, static_cast<float>(scale))) {
  FB_CHECK_LE(1, scale);
}

Painter::~Painter() { list_.atlas = atlas_.image(); }

void Painter::clip(const vec2& min, const vec2& max) {
  clip_min_ = min;
  clip_max_ = max;
}
void Painter::clip_nothing() { clip(vec2(-kUnclipped), vec2(kUnclipped)); }

void Painter::add(const vec2& min, const vec2& max, const vec2& uv_min, const vec2& uv_max, const vec4& color) {
  const vec2 from = glm::max(min, clip_min_), to = glm::min(max, clip_max_);
  if (!(from.x < to.x && from.y < to.y)) return;
  // Shares of the whole, which stay finite however small that is.
  const vec2 first = (from - min) / (max - min), last = (max - to) / (max - min);
  scene::DrawQuad quad;
  quad.min = canvas_.origin + canvas_.scale * from;
  quad.max = canvas_.origin + canvas_.scale * to;
  quad.uv_min = uv_min + (uv_max - uv_min) * first;
  quad.uv_max = uv_max - (uv_max - uv_min) * last;
  quad.color = color;
  list_.quads.push_back(quad);
}

void Painter::fill(float x, float y, float width, float height, const vec4& color) {
  add({x, y}, {x + width, y + height}, vec2(0.0f), vec2(0.0f), color);
}

void Painter::picture(float x, float y, const Picture& picture, const vec4& color) {
  this->picture(x, y, static_cast<float>(picture.width), static_cast<float>(picture.height), picture, color);
}

void Painter::picture(float x, float y, float width, float height, const Picture& picture, const vec4& color) {
  const vec2 uv(picture.x, picture.y);
  add({x, y}, {x + width, y + height}, uv, uv + vec2(picture.width, picture.height), color);
}

void Painter::part(float x, float y, const Picture& picture, int left, int top, int width, int height,
                   const vec4& color) {
  const Picture part{picture.x + std::clamp(left, 0, picture.width), picture.y + std::clamp(top, 0, picture.height),
                     std::clamp(width, 0, std::max(0, picture.width - left)),
                     std::clamp(height, 0, std::max(0, picture.height - top))};
  if (part.width > 0 && part.height > 0) this->picture(x, y, part, color);
}

void Painter::stretched_part(const vec2& min, const vec2& size, const Picture& picture, const vec2& from,
                             const vec2& to, const vec4& color) {
  const vec2 corner(picture.x, picture.y), most(picture.width, picture.height);
  add(min, min + size, corner + glm::clamp(from, vec2(0.0f), most), corner + glm::clamp(to, vec2(0.0f), most), color);
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
