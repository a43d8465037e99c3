// Means of pictures over runs with other seeds, for tests of what does not change a mean.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/test_image.h"

namespace fb::render {

inline double mean_of(const Renderer& renderer) { return image_estimate(renderer.read().linear()).mean; }

// The means of runs with other seeds, and their standard error.
struct Means {
  double mean = 0, square = 0;
  int runs = 0;
  void add(double m) {
    mean += (m - mean) / ++runs;
    square += (m * m - square) / runs;
  }
  double error() const { return std::sqrt(std::max(square - mean * mean, 0.0) / (runs - 1)); }
};
inline void expect_equal(const Means& a, const Means& b, double least_seen) {
  const double error = std::hypot(a.error(), b.error());
  EXPECT_GT(b.mean, 0);
  EXPECT_NEAR(a.mean, b.mean, 4.5 * error);
  EXPECT_LT(error, least_seen * b.mean) << "the test can see little";
}

}  // namespace fb::render
