// Changes the rate of sounds: by a windowed sinc (polyphase, Blackman window), or by holding samples, as Quake did.
//
// The filter's qualities are QuakeSpasm's snd_filterquality 1 to 5: its kernel spans 126 to 222 samples at four times
// the rate of the sound (32 to 56 of the sound's own), and passes 0.90 to 0.96 of the band that both rates have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace fb::audio {

constexpr int kLowestQuality = 1, kHighestQuality = 5;

class Resampler {
 public:
  // Rates in Hz, above 0.
  Resampler(std::uint32_t from, std::uint32_t to, int quality);

  bool same_rate() const { return from_ == to_; }
  // Input samples that each output sample looks at, on either side.
  std::size_t reach() const { return reach_; }
  // The last input sample at or before the output sample `number`.
  std::uint64_t position(std::uint64_t number) const { return number * from_ / to_; }
  // The length of `count` samples at the new rate.
  std::size_t length(std::size_t count) const;

  // The output sample `number` of an input of which `at(i)` gives sample i, also beyond either end.
  template <typename At>
  float sample(std::uint64_t number, At&& at) const {
    const std::uint64_t position = number * from_;
    const auto first = static_cast<std::int64_t>(position / to_) - static_cast<std::int64_t>(reach_) + 1;
    const float* weights = &weights_[static_cast<std::size_t>(position % to_ * phases_ / to_) * 2 * reach_];
    float sum = 0.0f;
    for (std::size_t k = 0; k < 2 * reach_; ++k) sum += weights[k] * at(first + static_cast<std::int64_t>(k));
    return sum;
  }

 private:
  std::uint64_t from_, to_;
  std::size_t reach_ = 0, phases_ = 0;
  std::vector<float> weights_;  // 2 * reach_ for each phase
};

// A whole sound at a new rate. What lies behind its end is its loop again, if it has one (`loop_start`, below its
// length; or its length: none), else silence, so that a loop has no seam. `held`: samples are held instead of filtered.
std::vector<float> resample(std::span<const float> samples, std::uint32_t from, std::uint32_t to, int quality,
                            std::size_t loop_start, bool held);

}  // namespace fb::audio
