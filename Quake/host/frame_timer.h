// How much game time a frame is, and which of the server's ticks fall into it. Pure arithmetic: who runs the loop says
// how long the last frame took.
//
// Up to 72 frames a second each frame is a tick of its own, as in Quake. Above that (host_maxfps) the picture goes
// apart from the physics, which would change with the frame rate: ticks are 1/72 s each, as many as have come due, and
// the client shows what is between the latest two. Where host_framerate says how long a frame is, frames are ticks
// again: the same script then gives the same game on any machine. It may not be shorter than the shortest frame that
// real time gives: a game that seems to stand still helps nobody, and sv_run would run for ever.
#pragma once

namespace fb::con {
class Console;
}

namespace fb::host {

// cvars host_framerate, host_timescale and host_maxfps; QuakeSpasm's.
struct TimeSettings {
  double frame_rate = 0.0;  // seconds that each frame lasts; 0: real time
  double time_scale = 0.0;  // how fast real time goes; 0: as it is, and only then frame_rate counts
  double max_fps = 72.0;
};
void register_time_cvars(con::Console& console);
TimeSettings read_time_settings(const con::Console& console);

struct FramePlan {
  double seconds = 0.0;  // of the client's time
  int ticks = 0;
  double tick_seconds = 0.0;  // each; above 0
  bool in_step = true;        // one tick a frame
};

class FrameTimer {
 public:
  static constexpr double kTick = 1.0 / 72.0;                  // seconds
  static constexpr double kShortest = 0.0001, kLongest = 0.1;  // seconds: of a frame, in real time
  static constexpr double kFastestInStep = 72.0;               // frames a second

  // `passed`: seconds of real time since the frame before.
  FramePlan plan(double passed, const TimeSettings& settings);

 private:
  double due_ = 0.0;  // seconds that no tick has had yet
};

}  // namespace fb::host
