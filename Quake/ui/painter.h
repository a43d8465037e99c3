// Draws text, pictures and fills into a DrawList in the virtual pixels of a canvas. Where its scale is a whole number
// Quake's 8-pixel letters stay sharp.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/maths.h"
#include "scene/draw_list.h"
#include "ui/atlas.h"
#include "ui/canvas.h"

namespace fb::ui {

constexpr float kGlyph = static_cast<float>(Atlas::kGlyphSize);  // virtual pixels a side of a letter

class Painter {
 public:
  // Draws on `list` without clearing it; list and atlas must outlive the painter.
  Painter(scene::DrawList& list, Atlas& atlas, const Canvas& canvas);
  // On all of the output.
  Painter(scene::DrawList& list, Atlas& atlas, int output_width, int output_height, int scale);
  // Passes the atlas to the list when drawing ends.
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  // The canvas's size in virtual pixels.
  int width() const { return canvas_.width; }
  int height() const { return canvas_.height; }
  Atlas& atlas() { return atlas_; }

  // From now on only what lies in this rectangle is drawn.
  void clip(const vec2& min, const vec2& max);
  void clip_nothing();

  // Colours are sRGB-encoded with straight alpha.
  void fill(float x, float y, float width, float height, const vec4& color);
  void picture(float x, float y, const Picture& picture, const vec4& color = vec4(1.0f));
  // Stretches the picture over this rectangle.
  void picture(float x, float y, float width, float height, const Picture& picture, const vec4& color = vec4(1.0f));
  // A part of it, unscaled; texels of the picture.
  void part(float x, float y, const Picture& picture, int left, int top, int width, int height,
            const vec4& color = vec4(1.0f));
  // Stretches a part of it, texels of the picture from `from` to `to`, over this rectangle.
  void stretched_part(const vec2& min, const vec2& size, const Picture& picture, const vec2& from, const vec2& to,
                      const vec4& color = vec4(1.0f));
  void character(float x, float y, unsigned char code, const vec4& color = vec4(1.0f));
  // One line in Quake's character set, 8 virtual pixels per character. `gold` uses the set's second colour.
  void text(float x, float y, std::string_view line, bool gold = false, const vec4& color = vec4(1.0f));

 private:
  static constexpr float kUnclipped = 1e9f;  // virtual pixels
  void add(const vec2& min, const vec2& max, const vec2& uv_min, const vec2& uv_max, const vec4& color);

  scene::DrawList& list_;
  Atlas& atlas_;
  Canvas canvas_;
  vec2 clip_min_{-kUnclipped}, clip_max_{kUnclipped};
};

}  // namespace fb::ui
