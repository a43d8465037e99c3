// Pictures of the game data by their names, and the numbers that are made of them.
#pragma once

#include <string>

#include "ui/painter.h"

namespace fb::ui {

// A picture by its name (Atlas::picture); what is empty or missing is left out.
void draw_named(Painter& painter, float x, float y, const std::string& name, const vec4& color = vec4(1.0f));
// A number in the large digits of gfx.wad, right-aligned in `digits` places of 24 pixels; what has more loses its
// first.
void draw_number(Painter& painter, float x, float y, int number, int digits, bool red);
constexpr unsigned char kSmallZero = 18;  // code of the small digits' 0
// A count of ammunition, 0 to 999: three places of small digits, right-aligned.
void draw_small_number(Painter& painter, float x, float y, int number);

}  // namespace fb::ui
