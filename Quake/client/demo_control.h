// How a demo plays: its speed, the pause, the keys that are held, its keyframes. Of one demo; the next begins anew.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "client/keyframes.h"

namespace fb::cl {

struct DemoControl {
  // The range of speeds and the speed of the keys that are held are Ironwail's.
  static constexpr double kSlowest = 1.0 / 32.0, kFastest = 32.0;
  static constexpr double kHeldFactor = 5.0;
  static constexpr double kStep = 1.0 / 72.0;  // seconds: a frame of a game; what a seek and a nudge advance by

  bool paused = false;
  double speed = 1.0;  // negative: backwards
  bool forward = false, rewind = false;
  std::optional<double> back_to;   // while it plays backwards: where it is, seconds of the demo
  std::optional<int> heard_track;  // while nothing is heard of it: the music that plays on
  int levels_before = 0;           // of Session::levels
  Keyframes keyframes;

  // Seconds of the demo that pass in one of the clock.
  double rate() const {
    const double faster = std::max(std::abs(speed), kSlowest) * kHeldFactor;
    if (forward != rewind) return forward ? faster : -faster;
    return paused ? 0.0 : speed;
  }
  void faster();
  void slower();
};

}  // namespace fb::cl
