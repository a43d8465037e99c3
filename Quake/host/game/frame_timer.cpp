#include "host/game/frame_timer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "console/console.h"

namespace fb::host {

void register_time_cvars(con::Console& console) {
  con::CvarSpec frame_rate{"host_framerate", "0",  "fixed length of a frame in game time, seconds; 0: real time",
                           con::kCvarPlain,  0.0f, 1.0f};
  frame_rate.least_above_zero = static_cast<float>(FrameTimer::kShortest);
  console.add_cvar(std::move(frame_rate));
  console.add_cvar({"host_timescale", "0", "speed of game time: 0.5 is half speed; 0 and 1 are real time",
                    con::kCvarPlain, 0.0f, 100.0f});
  console.add_cvar({"host_maxfps", "250",
                    "upper limit of the frame rate, frames a second; above 72 the game still ticks 72 times a second",
                    con::kCvarArchive, 10.0f, 1000.0f});
}

TimeSettings read_time_settings(const con::Console& console) {
  const auto value = [&](const char* name) { return static_cast<double>(console.cvar(name).value()); };
  return {value("host_framerate"), value("host_timescale"), value("host_maxfps")};
}

bool draws_ahead(float asked, bool demo, bool menu_or_console) {
  return !menu_or_console && (asked < 0 ? demo : asked > 0);
}

FramePlan FrameTimer::plan(double passed, const TimeSettings& settings) {
  const double real = std::clamp(passed, kShortest, kLongest);
  const bool scaled = settings.time_scale > 0.0, fixed = !scaled && settings.frame_rate > 0.0;
  const double scale = scaled ? settings.time_scale : 1.0;
  FramePlan plan;
  plan.seconds = fixed ? settings.frame_rate : real * scale;
  if (fixed || settings.max_fps <= kFastestInStep) {
    due_ = 0.0;
    plan.ticks = 1;
    plan.tick_seconds = plan.seconds;
    return plan;
  }
  plan.in_step = false;
  due_ += real;
  // Tolerates a thousandth of a tick, because sums of floats are inexact.
  plan.ticks = static_cast<int>(std::floor(due_ / kTick + 1e-3));
  due_ = std::max(0.0, due_ - plan.ticks * kTick);
  plan.tick_seconds = kTick * scale;
  return plan;
}

}  // namespace fb::host
