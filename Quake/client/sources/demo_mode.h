// The ways to play a demo, and the result of timedemo; part of the client's interface.
#pragma once

#include <string>

namespace fb::cl {

enum class DemoMode {
  kPlay,  // in its own time
  kTime,  // one message a frame, as fast as frames come: advance() ignores its argument
};

// Where a demo is that plays in its own time. The times of its levels are added up.
struct DemoStatus {
  double seconds = 0.0, length = 0.0;
  double rate = 1.0;  // seconds of the demo in one of the clock; negative: backwards
  bool paused = false;
};

// The line that timedemo ends with.
struct TimeDemoResult {
  std::string demo;
  bool whole = false;     // played to its end
  int index = 0, of = 1;  // in the list that one command asked for: demos times runs, from 0
  int frames = 0;
  double seconds = 0.0;
  double fps() const { return frames / seconds; }
  std::string line() const;  // "N frames T seconds F fps"
};

}  // namespace fb::cl
