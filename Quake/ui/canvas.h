// Where virtual pixels lie in the output. Each part of the screen has a canvas of its own, since each has a scale of
// its own (scr_conscale, scr_sbarscale, scr_menuscale, scr_crosshairscale). Sizes and places are QuakeSpasm's.
#pragma once

#include "base/maths.h"
#include "scene/draw_list.h"

namespace fb::ui {

struct Canvas {
  vec2 origin{0.0f};          // of virtual pixel (0, 0), output pixels
  float scale = 1.0f;         // output pixels to a virtual one
  int width = 0, height = 0;  // virtual pixels; what is drawn outside shows as far as the output reaches
};

// Output pixels per virtual pixel, so that 640x360 virtual ones fit: 2 at 1280x720, 3 at 1920x1080.
int automatic_scale(int output_width, int output_height);

// All of the output, without the incomplete virtual pixels at its border.
Canvas screen_canvas(ivec2 output, float scale);
// 320x48 at the bottom, in the middle or at the left; the scale is at least 1 and at most what fits.
Canvas status_bar_canvas(ivec2 output, float scale, bool left);
// 320x200 in the middle, for menus and plaques.
Canvas menu_canvas(ivec2 output, float scale);
// 320x200 in a corner of the output.
Canvas corner_canvas(ivec2 output, float scale, bool right, bool bottom);
// (0, 0) is the middle of the picture; the scale is 1 to 10.
Canvas crosshair_canvas(const scene::Area& picture, float scale);

// The scale of a console whose width is set in virtual pixels (scr_conwidth; 0: by scr_conscale).
float console_scale(ivec2 output, float scale, float width);

}  // namespace fb::ui
