// The sounds that may still be heard at a moment of the game, so that they can be begun where they would be by then: of
// a demo that was sought through without being heard. Which have ended already only the mixer knows (SoundStart::age).
#pragma once

#include <cstddef>
#include <vector>

#include "scene/sounds.h"

namespace fb::cl {

class SoundMemory {
 public:
  // `time`: of the game, seconds.
  void remember(const scene::SoundEvent& event, double time);

  const std::vector<scene::SoundLoop>& loops() const { return loops_; }
  int track() const { return track_; }  // the last that was asked for; 0: silence
  // Those that began at most `time` ago in this level, with their ages, in the order in which they began.
  std::vector<scene::SoundStart> sounding(double time) const;

 private:
  static constexpr std::size_t kMostStarts = 128;  // the mixer has no more channels
  static constexpr std::size_t kMostLoops = 4096;
  static constexpr double kLongest = 10.0;  // seconds: of a sound that no other ends
  struct Started {
    scene::SoundStart start;
    double time = 0.0;
  };
  void on(const scene::SoundStart& start, double time);
  void on(const scene::SoundStop& stop, double time);
  void on(const scene::SoundLoop& loop, double time);
  void on(const scene::SoundLevel& level, double time);
  void on(const scene::SoundTrack& track, double time);

  std::vector<Started> starts_;
  std::vector<scene::SoundLoop> loops_;
  int track_ = 0;
};

}  // namespace fb::cl
