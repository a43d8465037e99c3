// Draws text, pictures and fills into a DrawList in virtual pixels: whole multiples of the output's, so that Quake's
// 8-pixel letters stay sharp at any size.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/maths.h"
#include "scene/draw_list.h"
#include "ui/atlas.h"

namespace fb::ui {

// How many output pixels a virtual one is, so that about 640x400 of them fit: 1 at 1280x720, 2 at 1920x1080.
int automatic_scale(int output_width, int output_height);

class Painter {
 public:
  // `list` is drawn on, not cleared; both outlive the painter. `scale` of at least 1.
  Painter(scene::DrawList& list, Atlas& atlas, int output_width, int output_height, int scale);
  // The list gets the atlas as it is when drawing ends.
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  // The output's size in virtual pixels, what does not fill one left out.
  int width() const { return width_; }
  int height() const { return height_; }
  Atlas& atlas() { return atlas_; }

  // Colours are sRGB-encoded with straight alpha.
  void fill(float x, float y, float width, float height, const vec4& color);
  void picture(float x, float y, const Picture& picture, const vec4& color = vec4(1.0f));
  // The picture from edge to edge of this rectangle.
  void picture(float x, float y, float width, float height, const Picture& picture, const vec4& color = vec4(1.0f));
  void character(float x, float y, unsigned char code, const vec4& color = vec4(1.0f));
  // One line in Quake's character set; 8 virtual pixels a character. `gold` shows it in the set's other colour.
  void text(float x, float y, std::string_view line, bool gold = false, const vec4& color = vec4(1.0f));

 private:
  scene::DrawList& list_;
  Atlas& atlas_;
  float scale_;
  int width_, height_;
};

}  // namespace fb::ui
