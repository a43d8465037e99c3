// shared/seen_grid.h: shares of rays that arrived, folded over frames.
#include "shared/seen_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fb::shared {
namespace {

uint tally(uint rays, uint met) { return rays * kSeenRay + met * kSeenMet; }

TEST(SeenGrid, SharesAreOfRaysThatWereSent) {
  EXPECT_EQ(seen_share(0u), 0.0f);
  EXPECT_EQ(seen_rays(0u), 0.0f);
  EXPECT_EQ(seen_share(fold_seen(0u, tally(3, 0))), 0.0f);
  EXPECT_EQ(seen_share(fold_seen(0u, tally(3, 3))), 1.0f);
  EXPECT_EQ(seen_rays(fold_seen(0u, tally(3, 1))), 3.0f);
}

TEST(SeenGrid, FramesAddUpAndTheirNumberIsBounded) {
  uint cell = 0u;
  for (int frame = 0; frame < 4; ++frame) cell = fold_seen(cell, tally(25, 10));
  EXPECT_NEAR(seen_share(cell), 0.4f, 0.002f);
  for (int frame = 0; frame < 1000; ++frame) cell = fold_seen(cell, tally(65000, 26000));
  EXPECT_NEAR(seen_share(cell), 0.4f, 0.002f);
}

TEST(SeenGrid, WhatChangesIsLearntAnewWithinTheRaysThatAreRemembered) {
  uint cell = 0u;
  for (int frame = 0; frame < 1000; ++frame) cell = fold_seen(cell, tally(100, 0));
  EXPECT_LT(seen_share(cell), 0.001f);
  for (int sent = 0; sent < static_cast<int>(kSeenMost); sent += 64) cell = fold_seen(cell, tally(64, 64));
  EXPECT_GT(seen_share(cell), 0.5f);
}

// A point's cell is that of its neighbours on the same side, and not that of a wall that faces it.
TEST(SeenGrid, CellsAreAsWideAsTheySayAndTellSidesApart) {
  const vec3 corner(-640.0f, 128.0f, 64.0f), up(0, 0, 1);
  EXPECT_EQ(seen_cell(corner + vec3(1.0f), up), seen_cell(corner + vec3(kSeenWidth - 1.0f), up));
  EXPECT_NE(seen_cell(corner + vec3(1.0f), up), seen_cell(corner + vec3(kSeenWidth + 1.0f, 1, 1), up));
  EXPECT_NE(seen_cell(corner + vec3(1.0f), up), seen_cell(corner + vec3(1.0f), vec3(0, 0, -1)));
  EXPECT_LT(seen_cell(corner, up), kSeenCells);
}

TEST(SeenGrid, WaysAreBetweenCubesAndHaveADirection) {
  const vec3 a(-640.0f, 128.0f, 256.0f), b(384.0f, 0, -128.0f), within(kWayWidth - 1.0f), beside(1.0f, 0, 0);
  const uint way = seen_way(seen_place(a, 0u), b);
  EXPECT_EQ(seen_way(seen_place(a + within, 0u), b + within), way);
  EXPECT_NE(seen_way(seen_place(a, 0u), b - beside), way);
  EXPECT_NE(seen_way(seen_place(a - beside, 0u), b), way);
  EXPECT_NE(seen_way(seen_place(b, 0u), a), way);
  for (uint from = 0; from < 1000u; ++from) EXPECT_LT(seen_way(from, b), kSeenWays);
}

// Before anything is known it is what was hoped; then the root of the share that arrived; never zero, which would be a
// bias.
TEST(SeenGrid, HopeIsTheRootOfTheShareThatArrived) {
  EXPECT_FLOAT_EQ(seen_hope(uvec2(0u, 0u), 1.0f), 1.0f);
  EXPECT_FLOAT_EQ(seen_hope(uvec2(0u, 0u), 0.5f), 0.5f);
  EXPECT_NEAR(seen_hope(uvec2(400u, 100u), 1.0f), 0.5f, 0.002f);
  EXPECT_FLOAT_EQ(seen_hope(uvec2(60u, 60u), 1.0f), 1.0f);
  EXPECT_LT(seen_hope(uvec2(3u, 0u), 1.0f), 0.3f);
  EXPECT_FLOAT_EQ(seen_hope(uvec2(4000000u, 0u), 1.0f), kLeastSeen);
}

TEST(SeenGrid, LampsAreCountedAndNamedPlaceByPlace) {
  SeenLamps lamps{uvec4(0u), uvec4(0u)};
  EXPECT_EQ(times_seen(lamps, 0u), kSeenLamps);
  const uint names[kSeenLamps] = {7, 65535, 7, 1, 2, 3, 7, 9, 65535, 4, 5, 6, 8, 7, 11, 12};
  for (uint i = 0; i < kSeenLamps; ++i) {
    uvec4& half = i < 8u ? lamps.a : lamps.b;
    half[static_cast<int>(i / 2u % 4u)] |= names[i] << (16u * (i & 1u));
  }
  for (uint i = 0; i < kSeenLamps; ++i) EXPECT_EQ(seen_name(lamps, i), names[i]) << i;
  EXPECT_EQ(times_seen(lamps, 0u), 0u);
  EXPECT_EQ(times_seen(lamps, 7u), 4u);
  EXPECT_EQ(times_seen(lamps, 65535u), 2u);
  EXPECT_EQ(times_seen(lamps, 10u), 0u);
}

// The greatest of a frame is a lamp's as often as it has of the light, and nobody's is zero.
TEST(SeenGrid, TheLampThatIsKeptIsChosenByItsLight) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(1e-7f, 1.0f);
  int first = 0;
  constexpr int kRaces = 20000;
  for (int i = 0; i < kRaces; ++i)
    first += lamp_found(3u, 0.75f, uniform(random)) > lamp_found(40000u, 0.25f, uniform(random)) ? 1 : 0;
  EXPECT_NEAR(first / double{kRaces}, 0.75, 4.5 * std::sqrt(0.75 * 0.25 / kRaces) + 0.003)
      << "16 bits tie now and then";
  for (const float light : {1e-30f, 1e-6f, 1.0f, 1e30f})
    for (const float u : {1e-7f, 0.5f, 0.9999999f}) EXPECT_EQ(lamp_found(40000u, light, u) & 0xffffu, 40000u);
}

}  // namespace
}  // namespace fb::shared
