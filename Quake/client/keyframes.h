// Keyframes of a demo: copies of all that the client knows at a moment, so that a seek need not begin at the level's
// start. They lie some seconds apart. Where they become too many or too large, every second one goes, and new ones are
// taken half as often, so that a long demo costs no more memory. The first of a level stays.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "client/session/session.h"
#include "client/session/view.h"
#include "client/sources/demo_index.h"

namespace fb::cl {

struct Keyframe {
  DemoMoment moment;
  DemoPlace place;  // of the next message
  SessionMoment session;
  View view;
  ViewMemory view_memory;
  std::size_t bytes() const;  // about
};

class Keyframes {
 public:
  static constexpr double kSeconds = 4.0;
  static constexpr std::size_t kMostBytes = 64u << 20u;

  explicit Keyframes(std::size_t most = 256) : most_(most) {}

  // Is this moment far enough from all others?
  bool wants(const DemoMoment& moment) const;
  void add(std::unique_ptr<const Keyframe> keyframe);
  // The last of the level that is not after the moment; null: none.
  const Keyframe* before(const DemoMoment& moment) const;
  std::size_t count() const { return frames_.size(); }
  double spacing() const { return spacing_; }  // seconds

 private:
  std::size_t most_;
  std::vector<std::unique_ptr<const Keyframe>> frames_;  // in order
  double spacing_ = kSeconds;
  std::size_t bytes_ = 0;
};

}  // namespace fb::cl
