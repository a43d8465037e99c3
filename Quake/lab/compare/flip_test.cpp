// FLIP's pieces against what can be computed by hand, and the whole against the properties that the papers state.
#include "lab/compare/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <algorithm>

#include "base/rng.h"

namespace fb::lab::flip {
namespace {

Picture flat(vec3 color, std::uint32_t width = 40, std::uint32_t height = 30) {
  return {width, height, std::vector<vec3>(std::size_t{width} * height, color)};
}
Picture noise(std::uint64_t seed, float scale = 1.0f) {
  Picture picture = flat(vec3(0));
  Rng rng(seed);
  for (vec3& p : picture.pixels) p = scale * vec3(rng.uniform(), rng.uniform(), rng.uniform());
  return picture;
}

TEST(Flip, WhiteIsLightnessHundredWithoutColour) {
  const vec3 white = linear_to_ycxcz(vec3(1)), grey = linear_to_ycxcz(vec3(0.2f)), black = linear_to_ycxcz(vec3(0));
  EXPECT_NEAR(white.x, 100, 1e-3);
  EXPECT_NEAR(grey.x, 116 * 0.2 - 16, 1e-3);
  EXPECT_NEAR(black.x, -16, 1e-4);
  for (const vec3& v : {white, grey, black}) {
    EXPECT_NEAR(v.y, 0, 1e-3);
    EXPECT_NEAR(v.z, 0, 1e-3);
  }
  const vec3 lab = linear_to_hunt_lab(vec3(1));
  EXPECT_NEAR(lab.x, 100, 1e-3);
  EXPECT_NEAR(lab.y, 0, 1e-3);
}

TEST(Flip, OpponentColoursInvert) {
  Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const vec3 rgb(rng.uniform(), rng.uniform(), rng.uniform());
    EXPECT_LT(glm::length(ycxcz_to_linear(linear_to_ycxcz(rgb)) - rgb), 1e-5f);
  }
}

TEST(Flip, LabOfThePrimaries) {
  // CIELAB of sRGB's green and blue: (87.73, -86.18, 83.18) and (32.30, 79.19, -107.86); Hunt multiplies a, b by L/100.
  const vec3 green = linear_to_hunt_lab(vec3(0, 1, 0)), blue = linear_to_hunt_lab(vec3(0, 0, 1));
  EXPECT_NEAR(green.x, 87.73, 0.02);
  EXPECT_NEAR(green.y, -86.18 * 0.8773, 0.05);
  EXPECT_NEAR(green.z, 83.18 * 0.8773, 0.05);
  EXPECT_NEAR(blue.x, 32.30, 0.02);
  EXPECT_NEAR(blue.y, 79.19 * 0.3230, 0.05);
  EXPECT_NEAR(blue.z, -107.86 * 0.3230, 0.05);
  EXPECT_NEAR(hyab(green, blue), 55.43 + std::hypot(75.61 + 25.58, 72.97 + 34.84), 0.15);
}

TEST(Flip, RedistributionHasItsKneeAndItsEnds) {
  const float largest = hyab(linear_to_hunt_lab(vec3(0, 1, 0)), linear_to_hunt_lab(vec3(0, 0, 1)));
  EXPECT_EQ(redistribute(0), 0);
  EXPECT_NEAR(redistribute(largest), 1, 1e-6);
  // 0.4 of the largest, after the exponent of 0.7, goes to 0.95.
  EXPECT_NEAR(redistribute(largest * std::pow(0.4f, 1 / 0.7f)), 0.95, 1e-4);
  EXPECT_NEAR(redistribute(largest * std::pow(0.2f, 1 / 0.7f)), 0.475, 1e-4);
  EXPECT_NEAR(redistribute(largest * std::pow(0.7f, 1 / 0.7f)), 0.975, 1e-4);
}

TEST(Flip, SensitivityFiltersSumToOneAndHaveTheirWidth) {
  const double ppd = kPixelsPerDegree;
  for (int channel = 0; channel < 3; ++channel) {
    double total = 0;
    for (const SensitivityTerm& term : sensitivity(channel, ppd)) {
      EXPECT_NEAR(std::accumulate(term.kernel.begin(), term.kernel.end(), 0.0), 1, 1e-5);
      total += term.weight;
      EXPECT_EQ(term.kernel.size(), 21u) << "10 pixels: three times the widest sigma, sqrt(0.04 / 2) / pi degrees";
    }
    EXPECT_NEAR(total, 1, 1e-5);
  }
  // Achromatic: exp(-pi^2 x^2 / b) with b = 0.0047 falls to this at one pixel.
  const Kernel kernel = sensitivity(0, ppd).front().kernel;
  EXPECT_NEAR(kernel[11] / kernel[10], std::exp(-M_PI * M_PI / (ppd * ppd * 0.0047)), 1e-5);
  // Blue-yellow: in two dimensions a term's volume is a sqrt(pi/b) times b/pi, so the weights are as a sqrt(b).
  const auto terms = sensitivity(2, ppd);
  ASSERT_EQ(terms.size(), 2u);
  EXPECT_NEAR(terms[0].weight / terms[1].weight, 34.1 * std::sqrt(0.04) / (13.5 * std::sqrt(0.025)), 0.02);
}

TEST(Flip, FeatureKernelsAreBalanced) {
  const FeatureKernels k = feature_kernels(kPixelsPerDegree);
  EXPECT_EQ(k.edge.size(), 19u) << "sigma is half of 0.082 degrees, 2.75 pixels; three of them";
  for (const Kernel* kernel : {&k.edge, &k.point}) {
    double positive = 0, negative = 0;
    for (const float w : *kernel) (w > 0 ? positive : negative) += w;
    EXPECT_NEAR(positive, 1, 1e-5);
    EXPECT_NEAR(negative, -1, 1e-5);
  }
  EXPECT_GT(k.edge.front(), 0);
  EXPECT_FLOAT_EQ(k.edge.front(), -k.edge.back());
  EXPECT_FLOAT_EQ(k.point.front(), k.point.back());
  EXPECT_LT(k.point[9], 0);
}

TEST(Flip, EqualPicturesDifferNowhere) {
  const Picture picture = noise(3, 4.0f);
  EXPECT_EQ(mean_of(ldr_flip(picture, picture)), 0);
  EXPECT_EQ(mean_of(hdr_flip(picture, picture, choose_exposures(picture))), 0);
}

TEST(Flip, IsSymmetricAndWithinZeroAndOne) {
  const Picture a = noise(4), b = noise(5);
  const auto ab = ldr_flip(a, b), ba = ldr_flip(b, a);
  ASSERT_EQ(ab.size(), a.pixels.size());
  for (std::size_t i = 0; i < ab.size(); ++i) {
    EXPECT_EQ(ab[i], ba[i]);
    EXPECT_GE(ab[i], 0);
    EXPECT_LE(ab[i], 1);
  }
  EXPECT_GT(mean_of(ab), 0.1);
}

TEST(Flip, BlackAgainstWhite) {
  // No features; HyAB 100, to the 0.7th 25.119; the largest 203.3 to the 0.7th 41.29, so the knee is at 16.52 and the
  // rest of the way (25.12 - 16.52) / (41.29 - 16.52) of 0.05.
  const double expected = 0.95 + (25.119 - 16.52) / (41.29 - 16.52) * 0.05;
  for (const float value : ldr_flip(flat(vec3(0)), flat(vec3(1)))) EXPECT_NEAR(value, expected, 5e-4);
  // Green against blue is the largest difference that there is.
  EXPECT_NEAR(mean_of(ldr_flip(flat(vec3(0, 1, 0)), flat(vec3(0, 0, 1)))), 1, 1e-4);
}

TEST(Flip, AStepOfLightnessIsAnEdgeOfItsHeight) {
  // 0.5 on the left, 1 on the right, against 0.5 everywhere.
  Picture step = flat(vec3(0.5f));
  for (std::uint32_t y = 0; y < step.height; ++y)
    for (std::uint32_t x = 20; x < step.width; ++x) step.pixels[y * step.width + x] = vec3(1.0f);
  const auto map = ldr_flip(step, flat(vec3(0.5f)));
  const float* row = map.data() + 15 * 40;
  EXPECT_EQ(row[0], 0);
  EXPECT_NEAR(row[39], redistribute(100 - 76.07f), 1e-3) << "far from the step: lightness of 1 less that of 0.5";
  // Right of the step the sensitivity filter has more than half of its weight on the bright side. The edge detector's
  // weights sum to 1 a side, so its answer is the step's height, 0.5; the exponent is 1 - sqrt(0.5 / sqrt(2)).
  const Kernel blur = sensitivity(0, kPixelsPerDegree).front().kernel;
  const float bright = std::accumulate(blur.begin() + 10, blur.end(), 0.0f);
  const float lightness = linear_to_hunt_lab(vec3(0.5f + 0.5f * bright)).x;
  const float expected = std::pow(redistribute(lightness - 76.07f), 1 - std::sqrt(0.5f / std::sqrt(2.0f)));
  EXPECT_NEAR(row[20], expected, 2e-3);
  EXPECT_GT(row[20], row[39]) << "an edge makes a difference more visible";
}

TEST(Flip, ExposuresBracketTheReference) {
  // Two thirds of the pixels 1, the others 16 but for a dark one.
  Picture picture = flat(vec3(1.0f));
  for (std::size_t i = 0; i < picture.pixels.size(); i += 3) picture.pixels[i] = vec3(16.0f);
  picture.pixels[1] = vec3(0.01f);
  const Exposures e = choose_exposures(picture);
  const double limit = aces_inverse(0.85f);
  EXPECT_NEAR(aces(static_cast<float>(limit)), 0.85, 1e-6);
  EXPECT_NEAR(e.start, std::log2(limit / 16), 1e-5);
  EXPECT_NEAR(e.stop, std::log2(limit), 1e-5);
  EXPECT_EQ(e.count, 4);
  EXPECT_DOUBLE_EQ(e.at(0), e.start);
  EXPECT_DOUBLE_EQ(e.at(3), e.stop);
  EXPECT_EQ(choose_exposures(flat(vec3(3.0f))).count, 2) << "at least two";
  EXPECT_EQ(choose_exposures(flat(vec3(0.0f))).count, 2) << "nothing to expose";
  Picture dark = flat(vec3(0.0f));
  dark.pixels[7] = vec3(2.0f);
  EXPECT_NEAR(choose_exposures(dark).stop - choose_exposures(dark).start, 16, 1e-6);
}

TEST(Flip, HdrDoesNotDependOnTheUnitOfRadiance) {
  const Picture a = noise(6), b = noise(7);
  const double plain = mean_of(hdr_flip(a, b, choose_exposures(a)));
  Picture a8 = a, b8 = b;
  for (vec3& p : a8.pixels) p *= 8.0f;
  for (vec3& p : b8.pixels) p *= 8.0f;
  EXPECT_NEAR(mean_of(hdr_flip(a8, b8, choose_exposures(a8))), plain, 1e-4);
  EXPECT_GT(plain, 0.1);
}

TEST(Flip, HdrSeesWhatOneExposureCuts) {
  // Two highlights of 20 and 40 both are white at exposure 0, not at the reference's own exposures.
  Picture a = flat(vec3(0.2f)), b = a;
  for (std::uint32_t y = 5; y < 25; ++y)
    for (std::uint32_t x = 5; x < 35; ++x) {
      a.pixels[y * 40 + x] = vec3(20.0f);
      b.pixels[y * 40 + x] = vec3(40.0f);
    }
  EXPECT_EQ(mean_of(ldr_flip(a, b)), 0);
  EXPECT_GT(mean_of(hdr_flip(a, b, choose_exposures(a))), 0.05);
}

TEST(Flip, HdrIsTheLargestOfItsExposures) {
  const Picture a = noise(9, 8.0f), b = noise(10, 8.0f);
  const Exposures e{-3, 1, 3};
  std::vector<float> largest(a.pixels.size(), 0.0f);
  for (const double stops : {-3.0, -1.0, 1.0}) {
    Picture shown_a = a, shown_b = b;
    for (Picture* p : {&shown_a, &shown_b})
      for (vec3& v : p->pixels)
        for (int c = 0; c < 3; ++c) v[c] = aces(v[c] * static_cast<float>(std::exp2(stops)));
    const auto map = ldr_flip(shown_a, shown_b);
    for (std::size_t i = 0; i < map.size(); ++i) largest[i] = std::max(largest[i], map[i]);
  }
  const auto map = hdr_flip(a, b, e);
  for (std::size_t i = 0; i < map.size(); ++i) ASSERT_EQ(map[i], largest[i]);
}

TEST(Flip, WidthAndHeightAreNotConfused) {
  Picture wide = noise(8), tall{wide.height, wide.width, std::vector<vec3>(wide.pixels.size())};
  const Picture grey_wide = flat(vec3(0.3f)), grey_tall = flat(vec3(0.3f), 30, 40);
  for (std::uint32_t y = 0; y < wide.height; ++y)
    for (std::uint32_t x = 0; x < wide.width; ++x) tall.pixels[x * tall.width + y] = wide.pixels[y * wide.width + x];
  EXPECT_NEAR(mean_of(ldr_flip(wide, grey_wide)), mean_of(ldr_flip(tall, grey_tall)), 1e-5);
}

}  // namespace
}  // namespace fb::lab::flip
