// Governor: how much of the picture is rendered, so that frames take a given time. It sees what frames took, foresees
// what more or fewer pixels would take, and goes down at once, up only where that will last: each change costs the
// denoiser its past.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <string>

namespace fb::con {
class Console;
}

namespace fb::host {

class Governor {
 public:
  // Scales (of width and height) that it chooses from: each has 0.85 of the pixels of the one before.
  static constexpr int kSteps = 22;
  static float scale_of(int step);

  // Before a frame. `target`: milliseconds; 0: it rests. Another one begins its count anew. `most`: the largest scale
  // that is allowed.
  void follow(double target, float most);
  float scale(float most) const { return target_ > 0.0 ? std::min(most, scale_of(step_)) : most; }
  int step() const { return step_; }
  // A frame that was drawn at `step` took `milliseconds` of work, `fixed` of them whatever is rendered (the window's
  // pixels, the host), and `whole` with the waiting; `now` in seconds.
  void add(int step, double milliseconds, double fixed, double whole, double now);
  // The next frame is the first of its size.
  bool changed() const { return changed_; }
  // Frames are not to be shorter than this, milliseconds: an even pace is worth more than a frame now and then that
  // came early. Where the whole picture is rendered and frames are short, there is nothing to wait for.
  double shortest() const { return target_ >= kSlow || (target_ > 0 && step_ > least_) ? kPace * target_ : 0.0; }
  // What it did since the target was set, in a sentence.
  std::string report() const;

 private:
  static constexpr double kPace = 0.97;     // of the target
  static constexpr double kSlow = 50.0;     // milliseconds: a frame's end is seen
  static constexpr double kFull = 0.92;     // of the target: work that leaves room for a frame that takes longer
  static constexpr double kTooLong = 1.04;  // of the target: above it fewer pixels are rendered
  static constexpr double kAccident = 2.0;  // of the target
  static constexpr double kLeast = 0.2;  // of the target: fewer pixels than these take save nothing that is worth them
  static constexpr double kPatience = 1.5;  // seconds between the last change and the next one up
  static constexpr double kWithin = 0.15;   // of the target: a frame that is held

  // Milliseconds that the frames seen lately would take at `step`, of each `share` not exceeded.
  double foreseen(int step, double share) const;
  void move_to(int step, double now);

  struct Seen {
    double milliseconds, fixed;
    int step;
    double at(int step) const;  // what it would take at another step
  };
  double target_ = 0.0;
  int step_ = 8, least_ = 0;
  bool changed_ = false;
  double last_change_ = 0.0;
  std::deque<Seen> seen_;
  std::uint64_t frames_ = 0, held_ = 0, downs_ = 0, ups_ = 0;
  double scales_ = 0.0;  // their sum
};

// The cvar r_target_ms and the command `governor`.
void register_governor(con::Console& console, const Governor& governor);
// What r_target_ms means. -1 is 100 in a window on a CPU, else none.
double target_milliseconds(const con::Console& console, bool window, bool on_cpu);

}  // namespace fb::host
