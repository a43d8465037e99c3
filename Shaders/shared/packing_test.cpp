#include "shared/packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "base/rng.h"
#include "shared/rng.h"

namespace fb::shared {
namespace {

TEST(Packing, DirectionsSurviveWithinTheirStep) {
  Rng rng(1);
  for (int i = 0; i < 100000; ++i) {
    const float z = rng.uniform(-1, 1), phi = rng.uniform(0, 6.2831853f), s = std::sqrt(1 - z * z);
    const vec3 d(s * std::cos(phi), s * std::sin(phi), z);
    const vec3 back = unpack_direction(pack_direction(d));
    ASSERT_LT(length(back - d), 8e-5f) << d.x << ' ' << d.y << ' ' << d.z;
  }
}

TEST(Packing, AxesAreExact) {
  for (int axis = 0; axis < 3; ++axis) {
    for (float sign : {-1.0f, 1.0f}) {
      vec3 d(0.0f);
      d[axis] = sign;
      EXPECT_LT(length(unpack_direction(pack_direction(d)) - d), 1e-6f);
    }
  }
}

TEST(DeviceRng, NeighbouringPathsAreUncorrelated) {
  // Correlation of the first draws of neighbouring pixels, frames and samples: |r| < 4.5/sqrt(n).
  constexpr int kCount = 100000;
  const auto correlation = [](auto other) {
    double sum = 0;
    for (uint i = 0; i < kCount; ++i) {
      uint a = rng_seed(i, 1, 0, 0), b = other(i);
      sum += (rng_uniform(a) - 0.5) * (rng_uniform(b) - 0.5) * 12;
    }
    return sum / kCount;
  };
  const double limit = 4.5 / std::sqrt(kCount);
  EXPECT_LT(std::abs(correlation([](uint i) { return rng_seed(i + 1, 1, 0, 0); })), limit);
  EXPECT_LT(std::abs(correlation([](uint i) { return rng_seed(i, 2, 0, 0); })), limit);
  EXPECT_LT(std::abs(correlation([](uint i) { return rng_seed(i, 1, 1, 0); })), limit);
  EXPECT_LT(std::abs(correlation([](uint i) { return rng_seed(i, 1, 0, 1); })), limit);
}

}  // namespace
}  // namespace fb::shared
