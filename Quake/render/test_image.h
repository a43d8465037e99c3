// What tests ask of a whole picture.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "base/hash.h"
#include "render/renderer.h"

namespace fb::render {

// Mean of the red channel and its standard error. Given what was learnt before, samples are independent and unbiased,
// so pixels and frames are uncorrelated and their spread tells the error.
struct ImageEstimate {
  double mean = 0, error = 0;
};
inline ImageEstimate image_estimate(const std::vector<vec4>& image) {
  double sum = 0, sum2 = 0;
  for (const vec4& p : image) {
    sum += p.x;
    sum2 += static_cast<double>(p.x) * p.x;
  }
  const double n = static_cast<double>(image.size()), mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, sum2 / n - mean * mean) / n)};
}

// Two renderers whose linear means have the same bits have the same hash.
inline std::uint64_t image_hash(const Renderer& renderer) {
  const std::vector<vec4> image = renderer.read().linear();
  return hash_span(std::span<const vec4>(image));
}

}  // namespace fb::render
