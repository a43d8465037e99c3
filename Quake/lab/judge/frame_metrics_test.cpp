// The judge's metrics on pictures of which the answer is known.
#include "lab/judge/frame_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/rng.h"

namespace fb::lab {
namespace {

constexpr std::uint32_t kWidth = 24, kHeight = 16;
constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;

Picture flat(float value) { return {kWidth, kHeight, std::vector<vec3>(kPixels, vec3(value))}; }
Picture painted(const std::function<float(int x, int y)>& value) {
  Picture picture = flat(0);
  for (std::uint32_t i = 0; i < kPixels; ++i)
    picture.pixels[i] = vec3(value(static_cast<int>(i % kWidth), static_cast<int>(i / kWidth)));
  return picture;
}
std::size_t at(std::uint32_t x, std::uint32_t y) { return std::size_t{y} * kWidth + x; }

// A wall that moves by `motion` pixels a frame.
Guides wall(vec2 motion, float depth = 100, float depth_before = 100) {
  return {kWidth,
          kHeight,
          std::vector<vec2>(kPixels, motion),
          std::vector<float>(kPixels, depth),
          std::vector<float>(kPixels, depth_before),
          std::vector<std::uint32_t>(kPixels, 1),
          std::vector<float>(kPixels, 0.0f)};
}

TEST(FrameMetrics, IsolatedPixelsAreCountedByKind) {
  const Picture reference = flat(0.5f);
  Picture test = reference;
  EXPECT_EQ(isolated_pixels(reference, test).dark, 0u);
  test.pixels[at(5, 5)] = vec3(0.2f);
  test.pixels[at(0, 0)] = vec3(0.2f);  // a corner has three neighbours
  test.pixels[at(12, 5)] = vec3(0.9f);
  test.pixels[at(15, 5)] = vec3(0.5f - 0.9f * kIsolated);  // too little
  const IsolatedPixels count = isolated_pixels(reference, test);
  EXPECT_EQ(count.dark, 2u);
  EXPECT_EQ(count.bright, 1u);
}

TEST(FrameMetrics, PairsAndWhatTheReferenceShowsAreNotIsolated) {
  Picture reference = flat(0.5f);
  reference.pixels[at(5, 5)] = vec3(0.1f);
  Picture test = reference;
  test.pixels[at(10, 10)] = test.pixels[at(11, 11)] = vec3(0.1f);
  IsolatedPixels count = isolated_pixels(reference, test);
  EXPECT_EQ(count.dark, 0u) << "the reference has that pixel, and a pair is no single pixel";
  test.pixels[at(5, 5)] = vec3(0.5f);
  count = isolated_pixels(reference, test);
  EXPECT_EQ(count.bright, 0u) << "a missing dark pixel is wrong, but does not stand out";
}

TEST(FrameMetrics, APatternCarriedExactlyByMotionDoesNotFlicker) {
  const auto pattern = [](float shift) {
    return painted(
        [&](int x, int y) { return 0.5f + 0.4f * std::sin(0.7f * (static_cast<float>(x) + shift)) * float(y % 3); });
  };
  const Guides guides = wall({-2, 0});
  const Picture before = pattern(0), now = pattern(-2), plain = flat(0.3f);
  EXPECT_NEAR(flicker({before, before, guides}, {now, now, guides}), 0, 1e-6);
  EXPECT_NEAR(flicker({plain, before, guides}, {plain, now, guides}), 0, 1e-6) << "wrong, but it moves with the wall";
  EXPECT_GT(flicker({plain, before, guides}, {plain, before, guides}), 0.1) << "an error that stays behind";
}

TEST(FrameMetrics, FlickerIsTheChangeOfTheError) {
  const Guides still = wall({0, 0});
  const Picture dark = flat(0.4f), bright = flat(0.5f);
  EXPECT_NEAR(flicker({dark, dark, still}, {dark, bright, still}), 0.1, 1e-6);
  EXPECT_NEAR(flicker({dark, dark, still}, {bright, bright, still}), 0, 1e-6) << "the light itself changed";
  EXPECT_NEAR(flicker({dark, bright, still}, {dark, bright, still}), 0, 1e-6) << "a bias does not flicker";
}

TEST(FrameMetrics, WhatWasNotInSightDoesNotCount) {
  const Picture dark = flat(0.4f), bright = flat(0.5f);
  const Guides outside = wall({100, 0}), uncovered = wall({0, 0}, 100, 200);
  EXPECT_TRUE(std::isnan(flicker({dark, dark, outside}, {dark, bright, outside})));
  EXPECT_TRUE(std::isnan(flicker({dark, dark, uncovered}, {dark, bright, uncovered})));
  // Half of it: what comes from beyond the edge.
  const Guides half = wall({static_cast<float>(kWidth) / 2, 0});
  Picture test = dark;
  for (std::uint32_t y = 0; y < kHeight; ++y) test.pixels[at(kWidth - 1, y)] = vec3(0.9f);
  EXPECT_NEAR(flicker({dark, dark, half}, {dark, test, half}), 0, 1e-6);
}

TEST(FrameMetrics, SilhouettesAreWhereIdsOrDepthsPart) {
  Guides g = wall({0, 0});
  const auto count = [](const std::vector<bool>& edges) { return std::count(edges.begin(), edges.end(), true); };
  EXPECT_EQ(count(silhouettes(g)), 0);
  // A floor towards the horizon: depth is the inverse of a linear function of the row.
  for (std::uint32_t i = 0; i < kPixels; ++i) g.depth[i] = 100.0f / (0.02f + static_cast<float>(i / kWidth));
  EXPECT_EQ(count(silhouettes(g)), 0) << "a plane is no edge, however steep";
  g = wall({0, 0});
  g.id[at(6, 6)] = 2;
  EXPECT_EQ(count(silhouettes(g)), 5) << "the pixel and its four neighbours";
  g = wall({0, 0});
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 12; x < kWidth; ++x) g.depth[at(x, y)] = 150;
  const auto edges = silhouettes(g);
  EXPECT_EQ(count(edges), 2 * static_cast<std::ptrdiff_t>(kHeight)) << "both sides of a step";
  EXPECT_TRUE(edges[at(11, 3)] && edges[at(12, 3)]);
  for (float& depth : g.depth) depth = depth > 120 ? 0 : depth;
  EXPECT_EQ(count(silhouettes(g)), 2 * static_cast<std::ptrdiff_t>(kHeight)) << "against the sky";

  std::vector<float> map(kPixels, 0.1f);
  map[at(11, 3)] = 0.7f;
  std::vector<bool> one(kPixels, false);
  EXPECT_TRUE(std::isnan(mean_where(map, one)));
  one[at(11, 3)] = one[at(11, 4)] = true;
  EXPECT_NEAR(mean_where(map, one), 0.4, 1e-6);
}

TEST(FrameMetrics, InsideIsAwayFromSilhouettesAndLamps) {
  Guides g = wall({0, 0});
  const auto outside = [](const std::vector<bool>& inside) { return std::count(inside.begin(), inside.end(), false); };
  EXPECT_EQ(outside(interior(g)), 0);
  g.emission[at(6, 6)] = 2;
  EXPECT_EQ(outside(interior(g)), 21) << "a lamp of one pixel, its four neighbours, and all about them";
  g = wall({0, 0});
  for (std::uint32_t i = 0; i < kPixels; ++i) g.emission[i] = i % kWidth < 12 ? 1.0f : 1.05f;
  EXPECT_EQ(outside(interior(g)), 0) << "a lamp that shines nearly evenly";
  for (std::uint32_t i = 0; i < kPixels; ++i) g.id[i] = i % kWidth < 12 ? 1 : 2;
  EXPECT_EQ(outside(interior(g)), 4 * static_cast<std::ptrdiff_t>(kHeight));
  const std::vector<bool> inside = interior(g);
  Reference reference{flat(0.5f), std::vector<vec3>(kPixels, vec3(0.1f))};
  reference.mean.pixels[at(12, 4)] = vec3(9.0f);
  const Reference kept = pixels_where(reference, inside);
  EXPECT_EQ(kept.mean.pixels.size(), kPixels - 4 * kHeight);
  EXPECT_EQ(kept.variance.size(), kept.mean.pixels.size());
  EXPECT_EQ(kept.mean.width, kept.mean.pixels.size());
  EXPECT_EQ(*std::max_element(kept.mean.pixels.begin(), kept.mean.pixels.end(),
                              [](const vec3& a, const vec3& b) { return a.x < b.x; }),
            vec3(0.5f));
}

TEST(FrameMetrics, EpsilonGoesWithThePicture) {
  EXPECT_NEAR(relative_epsilon(flat(0.02f)), 0.002 * 0.002, 1e-9);
  EXPECT_NEAR(relative_epsilon(flat(20.0f)), 4, 1e-5);
  Picture lamp = flat(0.02f);
  lamp.pixels[7] = vec3(1000.0f);
  EXPECT_NEAR(relative_epsilon(lamp), 0.002 * 0.002, 1e-9) << "a lamp of one pixel sets no scale";
  EXPECT_GT(relative_epsilon(flat(0)), 0);
  // So relMSE is the same in any unit of radiance.
  Rng rng(3);
  Picture reference = flat(0), test = flat(0);
  for (std::size_t i = 0; i < kPixels; ++i) {
    reference.pixels[i] = vec3(rng.uniform());
    test.pixels[i] = vec3(rng.uniform());
  }
  const double plain = measure({reference, {}}, test, {relative_epsilon(reference)}).rel_mse;
  for (vec3& p : reference.pixels) p *= 1e-3f;
  for (vec3& p : test.pixels) p *= 1e-3f;
  EXPECT_NEAR(measure({reference, {}}, test, {relative_epsilon(reference)}).rel_mse, plain, 1e-4 * plain);
}

TEST(FrameMetrics, TrimmedErrorHasNoFireflies) {
  const Reference reference{flat(1.0f), std::vector<vec3>(kPixels, vec3(0.001f))};
  Picture test = flat(1.1f);
  const double plain = trimmed_rel_mse(reference, test, 0.01);
  EXPECT_NEAR(plain, (0.01 - 0.001) / 1.01, 1e-6);
  test.pixels[17] = vec3(1000.0f);
  EXPECT_NEAR(trimmed_rel_mse(reference, test, 0.01), plain, 1e-6);
  EXPECT_GT(measure(reference, test, {0.01}).rel_mse, 1000);
}

TEST(FrameMetrics, ShownIsExposureCurveAndSrgb) {
  EXPECT_EQ(shown(flat(0), 3, true).pixels[0].x, 0);
  EXPECT_NEAR(shown(flat(0.25f), 2, false).pixels[0].x, 0.735357, 1e-5) << "sRGB of a half";
  EXPECT_NEAR(shown(flat(7.0f), 1, false).pixels[0].x, 1, 1e-6);
  // Narkowicz: (0.5 (2.51/2 + 0.03)) / (0.5 (2.43/2 + 0.59) + 0.14) = 0.6163, in sRGB 0.8071.
  EXPECT_NEAR(shown(flat(0.25f), 2, true).pixels[0].x, 0.8071, 1e-3);
}

TEST(FrameMetrics, FlipOfTheReferencesNoise) {
  Reference reference{flat(0.3f), std::vector<vec3>(kPixels, vec3(0.0f))};
  EXPECT_EQ(reference_flip(reference, 1, true), 0);
  reference.variance.assign(kPixels, vec3(1e-4f));
  const double little = reference_flip(reference, 1, true);
  reference.variance.assign(kPixels, vec3(1e-2f));
  EXPECT_GT(little, 0);
  EXPECT_GT(reference_flip(reference, 1, true), 2 * little);
  reference.variance.clear();
  EXPECT_TRUE(std::isnan(reference_flip(reference, 1, true)));
}

// A block that stays says nothing; one whose light changes, how much of it is shown.
TEST(FrameMetrics, LagIsTheShareOfAChangeThatIsMissing) {
  const auto picture = [](float left, float right) {
    Picture p{16, 8, {}};
    for (std::size_t i = 0; i < 16 * 8; ++i) p.pixels.emplace_back(i % 16 < 8 ? left : right);
    return p;
  };
  EXPECT_TRUE(std::isnan(lag(picture(1, 2), picture(1.1f, 2), picture(3, 3))));
  EXPECT_NEAR(lag(picture(1, 2), picture(1, 4), picture(1, 4)), 0, 1e-6);
  EXPECT_NEAR(lag(picture(1, 2), picture(1, 4), picture(9, 3)), 0.5, 1e-6);
  EXPECT_NEAR(lag(picture(8, 2), picture(2, 2), picture(8, 2)), 1, 1e-6) << "and where light goes";
  EXPECT_NEAR(lag(picture(8, 2), picture(2, 4), picture(2, 3)), 0.125, 1e-6) << "by how much it changes";
  EXPECT_LT(lag(picture(8, 2), picture(2, 2), picture(1, 2)), 0);
}

}  // namespace
}  // namespace fb::lab
