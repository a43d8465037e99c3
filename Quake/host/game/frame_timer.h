// Computes a frame's game time and the server's ticks in it. Pure arithmetic: the caller says how long the last frame
// took.
//
// Up to 72 frames a second each frame is a tick, as in Quake. Above that (host_maxfps) the frame rate is separated from
// the physics, which would change with it: ticks are 1/72 s each, as many as are due, and the client interpolates
// between the latest two. If host_framerate sets the length of a frame, each frame is a tick again, so that the same
// script gives the same game on any machine. It must not be shorter than the shortest frame in real time, because a
// game would seem to stand still, and sv_run would run for ever.
#pragma once

namespace fb::con {
class Console;
}

namespace fb::host {

// cvars host_framerate, host_timescale and host_maxfps; QuakeSpasm's.
struct TimeSettings {
  double frame_rate = 0.0;  // seconds that each frame lasts; 0: real time
  double time_scale = 0.0;  // speed of game time; 0: real time, and only then frame_rate is used
  double max_fps = 72.0;
};
void register_time_cvars(con::Console& console);
TimeSettings read_time_settings(const con::Console& console);

// Whether the host prepares a frame while the device draws the one before, by r_frames_ahead: input then waits for one
// frame more. Who types or is in a menu wants to see it.
bool draws_ahead(float asked, bool demo, bool menu_or_console);

struct FramePlan {
  double seconds = 0.0;  // client time
  int ticks = 0;
  double tick_seconds = 0.0;  // length of each tick; above 0
  bool in_step = true;        // one tick a frame
};

class FrameTimer {
 public:
  static constexpr double kTick = 1.0 / 72.0;                  // seconds
  static constexpr double kShortest = 0.0001, kLongest = 0.1;  // seconds: of a frame, in real time
  static constexpr double kFastestInStep = 72.0;               // frames a second

  // `passed`: seconds of real time since the previous frame.
  FramePlan plan(double passed, const TimeSettings& settings);

 private:
  double due_ = 0.0;  // seconds not yet covered by ticks
};

}  // namespace fb::host
