// shared/seen_grid.h: shares of rays that arrived, folded over frames.
#include "shared/seen_grid.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace fb::shared
