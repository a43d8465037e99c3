// GPU time per pass, averaged over a timedemo.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/pass.h"

namespace fb::host {

class PassReport {
 public:
  void clear() { *this = PassReport(); }
  void add(const std::vector<render::PassTime>& passes);
  std::uint64_t frames() const { return frames_; }
  // "gpu ms a frame: gbuffer 8.1, paths 31.0, ...; 41.2 in all"; empty without frames or timestamps.
  std::string line() const;

 private:
  std::vector<render::PassTime> sums_;
  std::uint64_t frames_ = 0;
};

}  // namespace fb::host
