#include "host/game/governor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/log.h"
#include "console/console.h"

namespace fb::host {
namespace {

constexpr double kPixelsOfStep = 0.85;
constexpr double kFixed = 0.1;  // share of the device's work on a picture that pixels have no part in
constexpr std::size_t kRemembered = 12;
constexpr double kOnCpu = 100.0;  // milliseconds

}  // namespace

float Governor::scale_of(int step) { return static_cast<float>(std::pow(kPixelsOfStep, 0.5 * step)); }

double Governor::Seen::at(int other) const {
  const double pixels = kFixed + (1.0 - kFixed) * std::pow(kPixelsOfStep, other - step);
  return fixed + (milliseconds - fixed) * pixels;
}

void Governor::follow(double target, float most) {
  if (target != target_) {
    target_ = target;
    seen_.clear();
    changed_ = false;
    frames_ = held_ = downs_ = ups_ = 0;
    scales_ = 0.0;
  }
  least_ = 0;
  while (least_ < kSteps && scale_of(least_ + 1) >= most) ++least_;
  step_ = std::max(step_, least_);
}

double Governor::foreseen(int step, double share) const {
  std::vector<double> times;
  for (const Seen& frame : seen_) times.push_back(frame.at(step));
  const auto at = times.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(times.size() - 1));
  std::nth_element(times.begin(), at, times.end());
  return *at;
}

void Governor::move_to(int step, double now) {
  step = std::clamp(step, least_, kSteps);
  if (step == step_) return;
  ++(step > step_ ? downs_ : ups_);
  step_ = step;
  changed_ = true;
  last_change_ = now;
}

void Governor::add(int step, double milliseconds, double fixed, double whole, double now) {
  if (target_ <= 0.0) return;
  changed_ = false;
  ++frames_;
  const double over = whole - target_;
  held_ += over <= kWithin * target_ && (over >= -kWithin * target_ || step <= least_) ? 1 : 0;
  scales_ += static_cast<double>(scale_of(step));
  seen_.push_back({milliseconds, std::clamp(fixed, 0.0, milliseconds), step});
  if (seen_.size() > kRemembered) seen_.pop_front();
  if (seen_.size() < 2) return;

  // What comes into view may double a frame's work. More than that is an accident, unless it happens twice.
  const Seen &last = seen_.back(), &former = seen_[seen_.size() - 2];
  const Seen& taken = last.at(step_) > kAccident * target_ && former.at(step_) < last.at(step_) ? former : last;
  if (taken.at(step_) > kTooLong * target_) {
    int down = step_;
    while (down < kSteps && taken.at(down) > kFull * target_ && taken.at(down) - taken.fixed > kLeast * target_) ++down;
    return move_to(down, now);
  }
  // Nine frames of ten of those seen lately would leave room a step further up.
  if (seen_.size() < kRemembered || now - last_change_ < kPatience) return;
  int up = step_;
  while (up > least_ && foreseen(up - 1, 0.9) < kFull * target_) --up;
  move_to(up, now);
}

std::string Governor::report() const {
  if (target_ <= 0.0) return "the governor rests: r_target_ms asks for no frame time";
  if (frames_ == 0) return fmt::format("{:g} ms a frame are asked for; none was drawn yet", target_);
  const double frames = static_cast<double>(frames_);
  return fmt::format(
      "{:g} ms a frame: {:.1f}% of {} frames within 15%, or faster with the whole picture; it is scaled to {:.2f} of "
      "its width and height, {:.2f} on "
      "average; {} times down, {} up",
      target_, 100.0 * static_cast<double>(held_) / frames, frames_, scale_of(step_), scales_ / frames, downs_, ups_);
}

void register_governor(con::Console& console, const Governor& governor) {
  console.add_cvar(
      {"r_target_ms", "-1",
       "time that a frame is to take, milliseconds: as much of the picture is rendered as it allows, and it is scaled "
       "up; 0: all of it (r_scale), however long that takes; -1: 100 in a window on a CPU, else 0, and 0 with -capture",
       con::kCvarArchive, -1.0f, 10000.0f});
  console.add_command("governor", "says how well r_target_ms was held, and by what",
                      [&governor](const con::Args&) { log_info("{}", governor.report()); });
}

double target_milliseconds(const con::Console& console, bool window, bool on_cpu) {
  const float asked = console.cvar("r_target_ms").value();
  if (asked < 0) return window && on_cpu ? kOnCpu : 0.0;
  return static_cast<double>(asked);
}

}  // namespace fb::host
