// Whether light changed in a part of the world: it is found where it did, and by its ratio; neither noise, nor one cell
// alone, nor light of which too little is straight is a change.
#include "estimators/pstf/pstf_change.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "base/rng.h"

namespace fb::shared {
namespace {

constexpr float kErrors = 6;

void add(RegionLight& sum, const RegionLight& r) {
  sum.now += r.now;
  sum.memory += r.memory;
  sum.variance += r.variance;
  sum.scatter += r.scatter;
  sum.samples += r.samples;
}
RegionLight none() { return light_of_cell(0, 0, 0, 0, 0, 0); }

// Cells of `samples` each, whose samples are exponential: of straight light 0.5 `of` what is remembered of 1 in all.
RegionLight noisy_region(int cells, int samples, float of, Rng& rng) {
  RegionLight sum = none();
  for (int cell = 0; cell < cells; ++cell) {
    float now = 0;
    for (int i = 0; i < samples; ++i) now -= std::log(1 - rng.uniform()) * 0.5f * of;
    const auto n = static_cast<float>(samples);
    add(sum, light_of_cell(now / n, 0.5f, 1, 1.25f, n, 64 * n));
  }
  return sum;
}

TEST(PstfChange, WhatChangesIsFoundByItsRatio) {
  Rng rng(1);
  for (const float of : {0.0f, 0.1f, 0.5f, 2.0f}) {
    const RegionLight r = noisy_region(200, 8, of, rng);
    EXPECT_NEAR(change_of_light(r, kErrors), of, 0.05f * of + 1e-6f) << of;
  }
  EXPECT_TRUE(knows_change(noisy_region(200, 8, 1, rng), kErrors)) << "nothing changed, for sure";
  EXPECT_EQ(change_of_light(noisy_region(200, 8, 50, rng), kErrors), kMostRatio);
  EXPECT_EQ(change_of_light(noisy_region(200, 8, 0, rng), 0), 1) << "it is off";
}

TEST(PstfChange, NoiseIsNoChange) {
  Rng rng(2);
  int found = 0;
  for (int i = 0; i < 4000; ++i) found += change_of_light(noisy_region(1 + i % 40, 1 + i % 7, 1, rng), kErrors) != 1;
  EXPECT_LE(found, 4);
}

// Of few cells nothing is known: wider parts tell.
TEST(PstfChange, FewCellsAndDimOnesTellNothing) {
  RegionLight one = none();
  add(one, light_of_cell(100, 0.5f, 1, 1.25f, 64, 1000));
  EXPECT_EQ(change_of_light(one, kErrors), 1) << "one bright sample";
  RegionLight few = none();
  for (int i = 0; i < 8; ++i) add(few, light_of_cell(0, 0.5f, 1, 1.01f, 64, 1000));
  EXPECT_EQ(change_of_light(few, kErrors), 1);
  EXPECT_FALSE(knows_change(few, kErrors));
  RegionLight dim = none();
  for (int i = 0; i < 1000; ++i) add(dim, light_of_cell(0, 0.03f, 1, 1.01f, 64, 1000));
  EXPECT_EQ(change_of_light(dim, kErrors), 1) << "nearly all light was reflected before";
  EXPECT_FALSE(knows_change(dim, kErrors));
  RegionLight dark = none();
  add(dark, light_of_cell(1, 0, 0, 0, 64, 1000));
  add(dark, light_of_cell(1, 0.5f, 1, 1, 64, 0));
  EXPECT_EQ(dark.samples, 0) << "nothing is remembered";
}

TEST(PstfChange, AWordNamesItsParts) {
  for (const uint fine : {0u, 77u, kRegions - 1, 123456789u})
    for (const uint wide : {0u, 5u, kWideRegions - 1, 987654321u}) {
      const uint word = region_word(fine, wide);
      EXPECT_NE(word, 0u);
      EXPECT_EQ(region_of(word, 0), fine % kRegions);
      EXPECT_EQ(region_of(word, 1), kRegions + wide % kWideRegions);
      EXPECT_EQ(region_of(word, 2), kWholeWorld);
    }
}

}  // namespace
}  // namespace fb::shared
