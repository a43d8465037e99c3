// Where probes stand: evenly in a scene that they suffice for, about the camera elsewhere, never too many.
#include "render/techniques/probe_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

Bounds box(const vec3& min, const vec3& max) { return {min, max}; }

TEST(ProbeGridTest, ASceneThatProbesSufficeForHasThemEvenly) {
  const ProbeGrid grid = probe_grid(box({-100, 0, 50}, {140, 1200, 80}), vec3(0), 80);
  EXPECT_EQ(grid.count, (std::array<int, 3>{3, 15, 1}));
  EXPECT_EQ(grid.spacing, vec3(80, 80, 30));
  EXPECT_EQ(grid.origin, vec3(-100, 0, 50));
  const ProbeGrid even = probe_grid(box(vec3(0), vec3(16000)), vec3(0), 0);
  EXPECT_EQ(even.count, (std::array<int, 3>{16, 16, 8}));
  EXPECT_EQ(even.spacing, vec3(1000, 1000, 2000));
}

// A map of 30,000 units: the volume is about the camera and within the map, and what stays in it keeps its cell.
TEST(ProbeGridTest, ALargeMapHasThemAboutTheCamera) {
  const Bounds map = box(vec3(-15000), vec3(15000));
  for (const float x : {-15000.0f, -1234.5f, 0.0f, 79.9f, 14990.0f}) {
    const ProbeGrid grid = probe_grid(map, vec3(x, 100, -50), 80);
    EXPECT_EQ(grid.probes(), shared::kDdgiMostProbes);
    EXPECT_EQ(grid.spacing, vec3(80));
    const float least = 80 * static_cast<float>(grid.first[0]), most = least + 80 * 16;
    EXPECT_LE(least, x);
    EXPECT_GE(most, x);
    EXPECT_GE(least, -15000 - 80);
    EXPECT_LE(most, 15000 + 80);
    EXPECT_TRUE(grid.goes_on_as(probe_grid(map, vec3(x + 500, 0, 0), 80)));
  }
  EXPECT_FALSE(probe_grid(map, vec3(0), 80).goes_on_as(probe_grid(map, vec3(0), 81)));
}

TEST(ProbeGridTest, WhatIsNoBoxHasOneProbe) {
  const float inf = std::numeric_limits<float>::infinity();
  for (const Bounds& bounds : {Bounds{}, box(vec3(-inf), vec3(inf)), box(vec3(NAN), vec3(1)), box(vec3(5), vec3(5))}) {
    for (const float spacing : {0.0f, 80.0f, 4096.0f}) {
      const ProbeGrid grid = probe_grid(bounds, vec3(1, 2, 3), spacing);
      EXPECT_GE(grid.probes(), 1u);
      EXPECT_LE(grid.probes(), shared::kDdgiMostProbes);
      for (int axis = 0; axis < 3; ++axis) EXPECT_GT(grid.spacing[axis], 0);
    }
  }
}

TEST(ProbeGridTest, TheWorldsBoxIsWhatLightFallsOn) {
  EXPECT_EQ(lit_bounds(scene::furnace(0.5f, 1, true)).max, vec3(128));
  EXPECT_TRUE(lit_bounds(scene::FrameSnapshot{}).empty());
}

}  // namespace
}  // namespace fb::render
