// Times of frames: GPU time per pass, the host's, and from input to picture; averaged over a timedemo.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/passes/pass.h"

namespace fb::host {

// Of one frame, milliseconds.
struct FrameTimes {
  double whole = 0;    // since the former frame was shown
  double waited = 0;   // of these the host waited for the device
  double latency = 0;  // from reading the input until the picture was handed to the window
};

class PassReport {
 public:
  void clear() { *this = PassReport(); }
  void add(const std::vector<render::PassTime>& passes, const FrameTimes& times);
  std::uint64_t frames() const { return frames_; }
  // "gpu ms a frame: gbuffer 8.1, paths 31.0, ...; 41.2 in all"; empty without frames or timestamps.
  std::string line() const;
  // "ms a frame: 43.0, of these 1.8 the host's alone; input to picture 42.5"; empty without frames.
  std::string times_line() const;

 private:
  std::vector<render::PassTime> sums_;
  FrameTimes times_;
  std::uint64_t frames_ = 0;
};

}  // namespace fb::host
