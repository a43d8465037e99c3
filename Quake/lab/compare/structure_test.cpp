// SSIM and MS-SSIM where they have closed forms; compare_metrics_test.py holds them to other programs.
#include "lab/compare/structure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fb::lab {
namespace {

constexpr double kC1 = 1e-4, kC2 = 9e-4;

// Columns that alternate about `mean` by `depth`.
Picture stripes(float mean, float depth, std::uint32_t width = 64, std::uint32_t height = 48) {
  Picture picture{width, height, {}};
  for (std::uint32_t i = 0; i < width * height; ++i)
    picture.pixels.push_back(vec3(mean + (i % width % 2 == 0 ? depth : -depth)));
  return picture;
}

double luminance_factor(double a, double b) { return (2 * a * b + kC1) / (a * a + b * b + kC1); }

TEST(Structure, OfConstantsOnlyTheirLuminanceCounts) {
  EXPECT_NEAR(ssim(stripes(0.3f, 0), stripes(0.3f, 0)), 1, 1e-12);
  EXPECT_NEAR(ssim(stripes(0.2f, 0), stripes(0.7f, 0)), luminance_factor(0.2, 0.7), 1e-6);
  EXPECT_NEAR(ms_ssim(stripes(0.2f, 0, 200, 190), stripes(0.7f, 0, 200, 190)),
              std::pow(luminance_factor(0.2, 0.7), 0.1333), 1e-6);
}

// The Gaussian's even taps less its odd ones: what is left of a stripe's depth in a window's mean.
double rest_of_stripes() {
  double sum = 0, alternating = 0;
  for (int i = -5; i <= 5; ++i) {
    const double w = std::exp(-i * i / 4.5);
    sum += w;
    alternating += i % 2 == 0 ? w : -w;
  }
  return alternating / sum;
}

TEST(Structure, OfStripesOfLessContrast) {
  const double depth = 0.2, k = 0.4, mean = 0.5, a = rest_of_stripes();
  const double variance = depth * depth * (1 - a * a);
  const double contrast = (2 * k * variance + kC2) / ((1 + k * k) * variance + kC2);
  // Half of the windows stand on a bright column, half on a dark one.
  const double luminance = (luminance_factor(mean + depth * a, mean + k * depth * a) +
                            luminance_factor(mean - depth * a, mean - k * depth * a)) /
                           2;
  EXPECT_NEAR(ssim(stripes(0.5f, 0.2f), stripes(0.5f, 0.08f)), contrast * luminance, 1e-6);
  // Halved once, both are even: the first scale alone tells them apart.
  EXPECT_NEAR(ms_ssim(stripes(0.5f, 0.2f, 176, 176), stripes(0.5f, 0.08f, 176, 176)), std::pow(contrast, 0.0448), 1e-6);
}

TEST(Structure, WhatIsInvertedIsWorseThanWhatIsLost) {
  EXPECT_LT(ssim(stripes(0.5f, 0.2f), stripes(0.5f, -0.2f)), -0.9);
  EXPECT_NEAR(ssim(stripes(0.5f, 0.2f), stripes(0.5f, 0)), 0.02, 0.02);
  EXPECT_EQ(ms_ssim(stripes(0.5f, 0.2f, 176, 176), stripes(0.5f, -0.2f, 176, 176)), 0);
}

TEST(Structure, WhereNoWindowFitsThereIsNoNumber) {
  EXPECT_TRUE(std::isnan(ssim(stripes(0.5f, 0.1f, 10, 48), stripes(0.5f, 0.1f, 10, 48))));
  EXPECT_TRUE(std::isnan(ms_ssim(stripes(0.5f, 0.1f, 200, 175), stripes(0.5f, 0.1f, 200, 175))));
}

}  // namespace
}  // namespace fb::lab
