// Text over the game: the newest console lines, messages to the player, the frame rate.
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include "console/scrollback.h"
#include "ui/painter.h"

namespace fb::ui {

constexpr std::size_t kNotifyLines = 4;

// At the top left. Pass, for example, Scrollback::recent(kNotifyLines, now, seconds).
void draw_notify(Painter& painter, const std::vector<con::ScrollLine>& lines);

// "72 fps", ending at `right`. Draws nothing if nothing has been measured yet.
void draw_fps(Painter& painter, float right, float y, double frames_per_second);

// In the middle, each line centred; texts of more than four lines start higher, as in Quake. Only the first
// `characters` are shown (a finale's text appears letter by letter). `raised`: virtual pixels that it is moved up.
void draw_center_print(Painter& painter, std::string_view text,
                       std::size_t characters = std::numeric_limits<std::size_t>::max(), float raised = 0.0f);

// Measures the frame rate over the last half second.
class FrameRate {
 public:
  void frame(double now);  // seconds
  double value() const { return value_; }

 private:
  double start_ = -1.0, value_ = 0.0;
  int frames_ = 0;
};

}  // namespace fb::ui
