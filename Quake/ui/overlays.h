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
constexpr double kNotifySeconds = 3.0;  // con_notifytime's default

// At the top left. Pass, for example, Scrollback::recent(kNotifyLines, now, kNotifySeconds).
void draw_notify(Painter& painter, const std::vector<con::ScrollLine>& lines);

// At the bottom right: "72 fps". Draws nothing if nothing has been measured yet.
void draw_fps(Painter& painter, double frames_per_second);

// In the middle, each line centred; texts of more than four lines start higher, as in Quake. Only the first
// `characters` are shown (a finale's text appears letter by letter).
void draw_center_print(Painter& painter, std::string_view text,
                       std::size_t characters = std::numeric_limits<std::size_t>::max());

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
