// Where camera rays go through their pixels (r_jitter).
#include "render/picture/frame_constants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

#include "shared/kinds.h"

namespace fb::render {
namespace {

struct Jitter {
  float x, y;
  std::uint32_t seed;
  bool operator==(const Jitter&) const = default;
};

Jitter jitter_of(int asked, int seed, int accumulate, std::uint32_t frame, std::uint32_t accumulated, bool moving,
                 std::uint32_t filter = shared::kFilterNearest, bool denoised = false) {
  RenderSettings settings;
  settings.jitter = asked;
  settings.seed = seed;
  settings.accumulate = accumulate;
  shared::FrameConstants c{};
  c.accumulated_frames = accumulated;
  c.texture_filter = static_cast<std::int32_t>(filter);
  c.denoise = denoised ? 1 : 0;
  fill_jitter(c, settings, frame, moving);
  return {c.jitter_x, c.jitter_y, c.jitter_seed};
}

TEST(Jitter, LeftToItselfItIsOfAccumulatingAndOfMovingFrames) {
  const Jitter none{0, 0, 0};
  EXPECT_EQ(jitter_of(-1, 1, 1, 7, 0, false), none) << "the first frame goes through the middle";
  EXPECT_NE(jitter_of(-1, 1, 1, 7, 3, false), none);
  EXPECT_EQ(jitter_of(-1, 1, 1, 7, 3, false), jitter_of(-1, 2, 1, 9, 3, false)) << "the same for every seed";
  EXPECT_NE(jitter_of(-1, 1, 0, 7, 0, true), none);
  EXPECT_NE(jitter_of(-1, 1, 0, 7, 0, true), jitter_of(-1, 1, 0, 8, 0, true));
  EXPECT_EQ(jitter_of(0, 1, 1, 7, 3, true), none);
}

TEST(Jitter, AskedForItBeginsElsewhereForEverySeed) {
  std::set<std::pair<float, float>> starts;
  for (int seed = 0; seed < 100; ++seed) {
    const Jitter j = jitter_of(1, seed, 1, 0, 0, false);
    starts.emplace(j.x, j.y);
    EXPECT_NE(j.seed, 0u) << "pixels have their own";
  }
  EXPECT_EQ(starts.size(), 100u);
  // Accumulated frames go on in one sequence, whose steps all seeds share; others are drawn for themselves.
  const auto step = [](const Jitter& a, const Jitter& b) { return b.x - a.x - std::floor(b.x - a.x); };
  const auto at = [](int seed, std::uint32_t n) { return jitter_of(1, seed, 1, 0, n, false); };
  EXPECT_NEAR(step(at(1, 0), at(1, 1)), step(at(2, 5), at(2, 6)), 1e-5);
  EXPECT_EQ(at(1, 0).seed, at(1, 1).seed);
  EXPECT_NE(jitter_of(1, 1, 0, 3, 0, false).seed, jitter_of(1, 1, 0, 4, 0, false).seed);
}

TEST(Jitter, WhatCountsOnOneForAllGetsIt) {
  EXPECT_EQ(jitter_of(1, 1, 1, 0, 0, false, shared::kFilterFootprint).seed, 0u);
  EXPECT_EQ(jitter_of(1, 1, 1, 0, 0, false, shared::kFilterNearest, true).seed, 0u);
}

}  // namespace
}  // namespace fb::render
