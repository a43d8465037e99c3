// Draws text, pictures and fills into a DrawList in virtual pixels, each a whole number of output pixels, so that
// Quake's 8-pixel letters stay sharp at any size.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/maths.h"
#include "scene/draw_list.h"
#include "ui/atlas.h"

namespace fb::ui {

// Output pixels per virtual pixel, so that about 640x400 virtual ones fit: 1 at 1280x720, 2 at 1920x1080.
int automatic_scale(int output_width, int output_height);

class Painter {
 public:
  // Draws on `list` without clearing it; list and atlas must outlive the painter. `scale` is at least 1.
  Painter(scene::DrawList& list, Atlas& atlas, int output_width, int output_height, int scale);
  // Passes the atlas to the list when drawing ends.
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  // The output's size in virtual pixels, without the incomplete ones at the border.
  int width() const { return width_; }
  int height() const { return height_; }
  Atlas& atlas() { return atlas_; }

  // Colours are sRGB-encoded with straight alpha.
  void fill(float x, float y, float width, float height, const vec4& color);
  void picture(float x, float y, const Picture& picture, const vec4& color = vec4(1.0f));
  // Stretches the picture over this rectangle.
  void picture(float x, float y, float width, float height, const Picture& picture, const vec4& color = vec4(1.0f));
  void character(float x, float y, unsigned char code, const vec4& color = vec4(1.0f));
  // One line in Quake's character set, 8 virtual pixels per character. `gold` uses the set's second colour.
  void text(float x, float y, std::string_view line, bool gold = false, const vec4& color = vec4(1.0f));

 private:
  scene::DrawList& list_;
  Atlas& atlas_;
  float scale_;
  int width_, height_;
};

}  // namespace fb::ui
