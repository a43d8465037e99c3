#include "render/scene/gpu_scene_room.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fb::render {
namespace {

using testing::ElementsAre;

SceneDemand thing(float distance, std::uint64_t triangles, std::uint64_t nodes = 0) {
  return {{.triangles = triangles, .nodes = nodes}, distance};
}
constexpr std::uint64_t kMany = 1000;

TEST(SceneRoom, AllAreDrawnWhereAllFit) {
  const SceneDemand all[]{thing(9, 10), thing(1, 10), thing(5, 10)};
  EXPECT_THAT(nearest_that_fit(all, {3, 0, 30, 0, 0}), ElementsAre(true, true, true));
  EXPECT_THAT(nearest_that_fit({}, {0, 0, 0, 0, 0}), ElementsAre());
}

TEST(SceneRoom, TheFarthestAreLeftOut) {
  const SceneDemand all[]{thing(9, 10), thing(1, 10), thing(5, 10)};
  EXPECT_THAT(nearest_that_fit(all, {3, 0, 29, 0, 0}), ElementsAre(false, true, true));
  EXPECT_THAT(nearest_that_fit(all, {1, 0, kMany, 0, 0}), ElementsAre(false, true, false));
  EXPECT_THAT(nearest_that_fit(all, {3, 0, 9, 0, 0}), ElementsAre(false, false, false));
}

TEST(SceneRoom, WhatIsTooLargeLeavesRoomForWhatIsBehindIt) {
  const SceneDemand all[]{thing(1, 1000), thing(2, 10), thing(3, 10), thing(4, 10)};
  EXPECT_THAT(nearest_that_fit(all, {4, 0, 20, 0, 0}), ElementsAre(false, true, true, false));
}

TEST(SceneRoom, OfEqualDistancesTheFirstAreDrawn) {
  const SceneDemand all[]{thing(1, 10), thing(1, 10), thing(1, 10)};
  EXPECT_THAT(nearest_that_fit(all, {3, 0, 20, 0, 0}), ElementsAre(true, true, false));
}

TEST(SceneRoom, EveryArrayCounts) {
  SceneDemand demand{{.instances = 1, .copies = 2, .triangles = 3, .nodes = 4, .vertices = 5}, 0};
  const SceneRoom enough = demand.room;
  EXPECT_THAT(nearest_that_fit({&demand, 1}, enough), ElementsAre(true));
  for (std::uint64_t SceneRoom::*array :
       {&SceneRoom::instances, &SceneRoom::copies, &SceneRoom::triangles, &SceneRoom::nodes, &SceneRoom::vertices}) {
    SceneRoom less = enough;
    --(less.*array);
    EXPECT_THAT(nearest_that_fit({&demand, 1}, less), ElementsAre(false));
  }
}

}  // namespace
}  // namespace fb::render
