// Draws the console: its lines over a background that comes down from the top, and the line being typed.
#pragma once

#include <cstddef>

#include "console/console.h"
#include "console/input_line.h"
#include "ui/painter.h"

namespace fb::ui {

struct ConsoleView {
  float fraction = 0.5f;        // of the height; 0 draws nothing, 1 covers the picture, opaque (without a game)
  float opacity = 0.85f;        // of the background if fraction < 1
  std::size_t scrolled_up = 0;  // lines scrolled back (pgup); a row of ^ marks it
  double time = 0.0;            // seconds, for the blinking cursor
};

// How many lines it shows below the row of ^, of those that need one row each, in a picture of this height.
std::size_t console_rows(int height, float fraction);

void draw_console(Painter& painter, const con::Scrollback& lines, const con::InputLine& input, const ConsoleView& view);

}  // namespace fb::ui
