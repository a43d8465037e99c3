#include "ui/console_view.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "ui/wrap.h"

namespace fb::ui {
namespace {

constexpr float kLine = 8.0f;  // a line's height and a character's width
constexpr unsigned char kCursor = 11, kOverwritingCursor = '_';

void draw_background(Painter& painter, float bottom, float alpha) {
  const float width = static_cast<float>(painter.width() + 1), height = static_cast<float>(painter.height());
  if (const Picture* back = painter.atlas().has_game_font() ? painter.atlas().picture("gfx/conback.lmp") : nullptr)
    painter.picture(0.0f, bottom - height, width, height, *back, vec4(1.0f, 1.0f, 1.0f, alpha));
  else
    painter.fill(0.0f, 0.0f, width, bottom, vec4(0.06f, 0.05f, 0.04f, alpha));
}

// The part of the line around the cursor that fits on the screen.
void draw_input(Painter& painter, const con::InputLine& input, float y, std::size_t columns, double time) {
  const std::string text = "]" + input.text();
  const std::size_t cursor = input.cursor() + 1;
  const std::size_t first = cursor + 1 > columns ? cursor + 1 - columns : 0;
  painter.text(kLine, y, std::string_view(text).substr(first, columns));
  const unsigned char shape = input.overwriting() ? kOverwritingCursor : kCursor;
  if (std::fmod(time, 0.5) < 0.25) painter.character(kLine * static_cast<float>(1 + cursor - first), y, shape);
}

vec4 color_of(LogLevel level) {
  if (level == LogLevel::kError) return vec4(1.0f, 0.45f, 0.35f, 1.0f);
  if (level == LogLevel::kWarning) return vec4(1.0f, 0.85f, 0.45f, 1.0f);
  return vec4(1.0f);
}

float bottom_of(int height, float fraction) {
  return std::round(std::clamp(fraction, 0.0f, 1.0f) * static_cast<float>(height));
}

}  // namespace

// Above the line that is typed, an empty one and the row of ^.
std::size_t console_rows(int height, float fraction) {
  constexpr float kOthers = 3.0f;
  return static_cast<std::size_t>(std::max(0.0f, std::floor(bottom_of(height, fraction) / kLine) - kOthers));
}

void draw_console(Painter& painter, const con::Scrollback& lines, const con::InputLine& input,
                  const ConsoleView& view) {
  const float bottom = bottom_of(painter.height(), view.fraction);
  if (bottom <= 0.0f) return;
  draw_background(painter, bottom, view.fraction < 1.0f ? view.opacity : 1.0f);
  const auto columns = static_cast<std::size_t>(std::max(painter.width() / 8 - 2, 1));
  draw_input(painter, input, bottom - 2.0f * kLine, columns, view.time);

  float y = bottom - 3.0f * kLine;
  if (view.scrolled_up > 0) {
    for (std::size_t column = 0; column < columns; column += 4)
      painter.character(kLine * static_cast<float>(column + 1), y, '^');
    y -= kLine;
  }
  // Draws upwards from the newest visible line, at most as many lines as there are rows.
  const auto rows = static_cast<std::size_t>(std::max(0.0f, bottom / kLine));
  const auto shown = lines.latest(rows, view.scrolled_up);
  for (auto line = shown.rbegin(); line != shown.rend() && y > -kLine; ++line) {
    const auto pieces = wrap(line->text, columns);
    for (auto piece = pieces.rbegin(); piece != pieces.rend() && y > -kLine; ++piece, y -= kLine)
      painter.text(kLine, y, *piece, false, color_of(line->level));
  }
}

}  // namespace fb::ui
