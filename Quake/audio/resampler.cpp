#include "audio/resampler.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/check.h"

namespace fb::audio {
namespace {

constexpr std::size_t kMostPhases = 1024;  // for rates without a common measure; the error is then below -60 dB

struct Filter {
  double span;  // samples of the lower rate that the kernel covers
  double band;  // what it passes of the band
};
Filter filter_of(int quality) {
  const double step = std::clamp(quality, kLowestQuality, kHighestQuality) - kLowestQuality;
  return {(126.0 + 24.0 * step) / 4.0, 0.900 + 0.015 * step};
}

double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x); }

// x from -1 to 1.
double blackman(double x) {
  if (std::abs(x) >= 1.0) return 0.0;
  return 0.42 + 0.5 * std::cos(std::numbers::pi * x) + 0.08 * std::cos(2.0 * std::numbers::pi * x);
}

}  // namespace

Resampler::Resampler(std::uint32_t from, std::uint32_t to, int quality) : from_(from), to_(to) {
  FB_CHECK(from > 0 && to > 0);
  if (same_rate()) {
    reach_ = 1;
    phases_ = 1;
    weights_ = {1.0f, 0.0f};
    return;
  }
  const Filter filter = filter_of(quality);
  const double lower = std::min(1.0, static_cast<double>(to) / from);  // the lower rate, of the input's
  const double half = filter.span / 2.0 / lower;                       // input samples
  reach_ = static_cast<std::size_t>(std::ceil(half));
  phases_ = std::min<std::size_t>(to / std::gcd(from, to), kMostPhases);
  weights_.resize(phases_ * 2 * reach_);
  for (std::size_t phase = 0; phase < phases_; ++phase) {
    float* weights = &weights_[phase * 2 * reach_];
    const double fraction = static_cast<double>(phase) / static_cast<double>(phases_);
    double sum = 0.0;
    for (std::size_t k = 0; k < 2 * reach_; ++k) {
      const double x = static_cast<double>(k) - static_cast<double>(reach_ - 1) - fraction;
      const double weight = sinc(x * lower * filter.band) * blackman(x / half);
      weights[k] = static_cast<float>(weight);
      sum += weight;
    }
    for (std::size_t k = 0; k < 2 * reach_; ++k) weights[k] = static_cast<float>(weights[k] / sum);
  }
}

std::size_t Resampler::length(std::size_t count) const {
  return static_cast<std::size_t>(std::uint64_t{count} * to_ / from_);
}

std::vector<float> resample(std::span<const float> samples, std::uint32_t from, std::uint32_t to, int quality,
                            std::size_t loop_start, bool held) {
  if (from == to) return {samples.begin(), samples.end()};
  const auto count = static_cast<std::int64_t>(samples.size());
  const auto loop = static_cast<std::int64_t>(loop_start);
  const auto at = [&](std::int64_t i) -> float {
    if (i >= count) {
      if (loop >= count) return 0.0f;
      i = loop + (i - loop) % (count - loop);
    }
    if (i < 0) {
      if (loop != 0) return 0.0f;
      i = (i % count + count) % count;
    }
    return samples[static_cast<std::size_t>(i)];
  };
  const Resampler resampler(from, to, quality);
  std::vector<float> result(std::max<std::size_t>(resampler.length(samples.size()), 1));
  const auto reach = static_cast<std::int64_t>(resampler.reach());
  for (std::size_t j = 0; j < result.size(); ++j) {
    const auto position = static_cast<std::int64_t>(std::uint64_t{j} * from / to);
    if (held)
      result[j] = at(position);
    else if (position >= reach && position + reach < count)
      result[j] = resampler.sample(j, [&](std::int64_t i) { return samples[static_cast<std::size_t>(i)]; });
    else
      result[j] = resampler.sample(j, at);
  }
  return result;
}

}  // namespace fb::audio
