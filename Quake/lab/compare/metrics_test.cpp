// Errors that can be computed by hand, and the decomposition of the error held to noise of known variance and bias.
#include "lab/compare/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/rng.h"

namespace fb::lab {
namespace {

Picture flat(float value, std::uint32_t width = 4, std::uint32_t height = 2) {
  return {width, height, std::vector<vec3>(std::size_t{width} * height, vec3(value))};
}
// Uniform noise of the given standard deviation about `value`.
Picture noisy(float value, double deviation, std::uint64_t seed) {
  Picture picture = flat(value, 64, 64);
  Rng rng(seed);
  const float half = static_cast<float>(deviation * std::sqrt(3.0));
  for (vec3& p : picture.pixels)
    p += vec3(rng.uniform(-half, half), rng.uniform(-half, half), rng.uniform(-half, half));
  return picture;
}

TEST(Metrics, OfAConstantDifference) {
  const Reference reference{flat(0.5f), {}};
  const Errors e = measure(reference, flat(0.7f));
  EXPECT_NEAR(e.mse, 0.04, 1e-7);
  EXPECT_NEAR(e.rmse(), 0.2, 1e-7);
  EXPECT_NEAR(e.rel_mse, 0.04 / 0.26, 1e-6);
  EXPECT_NEAR(e.mape, 0.2 / 0.51, 1e-6);
  EXPECT_NEAR(e.smape, 0.2 / 1.21, 1e-6);
  EXPECT_NEAR(e.peak, 0.5, 1e-7) << "the reference's largest";
  EXPECT_NEAR(e.psnr(), 10 * std::log10(0.25 / 0.04), 1e-5);
  EXPECT_NEAR(measure(reference, flat(0.7f), {0.01, 2}).psnr(), 10 * std::log10(4 / 0.04), 1e-5);
  EXPECT_NEAR(e.bias, 0.2, 1e-6);
  EXPECT_NEAR(e.median_mse, 0.04, 1e-7);
  EXPECT_NEAR(e.top_share, 1.0 / 8, 1e-6) << "at least one pixel of the eight";
  EXPECT_NEAR(measure(reference, flat(0.3f)).bias, -0.2, 1e-6);
  EXPECT_NEAR(measure(reference, flat(0.7f), {0.5}).rel_mse, 0.04 / 0.75, 1e-6);
  EXPECT_EQ(measure(reference, flat(0.5f)).mse, 0);
  EXPECT_EQ(measure(reference, flat(0.5f)).top_share, 0);
}

TEST(Metrics, AFireflyIsInTheMeanAndNotInTheMedian) {
  const Reference reference{flat(0.0f, 100, 30), {}};
  Picture test = flat(0.1f, 100, 30);
  for (int i = 0; i < 3; ++i) test.pixels[static_cast<std::size_t>(i) * 1000] = vec3(100.0f);  // 0.1% of 3000
  const Errors e = measure(reference, test);
  EXPECT_NEAR(e.median_mse, 0.01, 1e-6);
  EXPECT_NEAR(e.mse, (3 * 1e4 + 2997 * 0.01) / 3000, 1e-4);
  EXPECT_NEAR(e.top_share, 3e4 / (3e4 + 29.97), 1e-6);
}

TEST(Metrics, WhatIsNotFiniteIsCountedAndZero) {
  const Reference reference{flat(1.0f), {}};
  Picture test = flat(1.0f);
  test.pixels[3].y = std::numeric_limits<float>::quiet_NaN();
  test.pixels[5].x = std::numeric_limits<float>::infinity();
  const Errors e = measure(reference, test);
  EXPECT_EQ(e.not_finite, 2u);
  EXPECT_NEAR(e.mse, 2.0 / 8, 1e-6);
}

TEST(Metrics, TheReferencesVarianceIsTakenOff) {
  // Truth 1; the test's deviation 0.3 and bias 0.1; the reference's deviation 0.2, known to it.
  Reference reference{noisy(1.0f, 0.2, 1), {}};
  reference.variance.assign(reference.mean.pixels.size(), vec3(0.04f));
  const Errors e = measure(reference, noisy(1.1f, 0.3, 2));
  // 12288 values of (x - r)^2, each with a spread of at most twice its mean: 1.8%, three times that.
  EXPECT_NEAR(e.mse, 0.09 + 0.01 + 0.04, 0.14 * 0.055);
  EXPECT_NEAR(e.mse_corrected(), 0.10, 0.14 * 0.055);
  EXPECT_NEAR(e.reference_variance, 0.04, 1e-6);
  EXPECT_NEAR(e.reference_bias_error, 0.2 / std::sqrt(4096.0), 1e-6) << "channels err together";
  EXPECT_NEAR(e.bias, 0.1, 4 * std::sqrt(0.13 / 12288));
  EXPECT_LT(e.rel_mse_corrected(), e.rel_mse);
}

TEST(Metrics, RunsTellVarianceFromBias) {
  Reference reference{noisy(1.0f, 0.2, 1), {}};
  reference.variance.assign(reference.mean.pixels.size(), vec3(0.04f));
  for (const float bias : {0.0f, 0.1f}) {
    Runs runs;
    for (std::uint64_t i = 0; i < 8; ++i) runs.add(noisy(1.0f + bias, 0.3, 10 + i));
    EXPECT_EQ(runs.count(), 8u);
    EXPECT_NEAR(runs.variance(), 0.09, 0.002);
    // Its noise: that of 12288 squares with mean 0.04 + 0.09 / 8, spread about as large.
    EXPECT_NEAR(runs.bias_squared(reference), bias * bias, 4 * 0.051 / std::sqrt(12288.0) + 0.003 * bias);
  }
  Runs one;
  one.add(flat(1));
  EXPECT_EQ(one.variance(), 0);
}

}  // namespace
}  // namespace fb::lab
