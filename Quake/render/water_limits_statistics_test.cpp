// Water where it is hard: the camera at the surface to the last bit, liquids in one another, glowing ground under a
// foot of water, water in a world without walls. Nothing is lost, nothing is not a number.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "render/test_device.h"
#include "render/test_image.h"
#include "render/test_water.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_of_water.h"
#include "shared/dielectric.h"

namespace fb::render {
namespace {

class WaterLimitsStatistics : public WaterDeviceTest {
 protected:
  static void expect_finite(const Renderer& renderer, const std::string& what) {
    EXPECT_EQ(renderer.read().counters().not_finite, 0u) << what;
    EXPECT_EQ(renderer.read().counters().states_not_finite, 0u) << what;
    for (const vec4& p : renderer.read().linear()) ASSERT_TRUE(p.x >= 0.0f && std::isfinite(p.x + p.y + p.z)) << what;
  }
};

constexpr const char* kEstimators[] = {"pt", "nee", "mcpg", "mcpg_nee"};

// In a closed room of albedo a and emission e all is e (1 + a), from wherever it is seen.
TEST_F(WaterLimitsStatistics, TheCameraIsAtTheSurfaceToTheLastBit) {
  const float albedo = 0.5f, level = 37.3f, far = std::numeric_limits<float>::max();
  for (const char* estimator : kEstimators) {
    for (const float z : {std::nextafter(level, -far), level, std::nextafter(level, far)}) {
      scene::FrameSnapshot snapshot = scene::furnace(albedo, 1.0f);
      look(snapshot, {3, 5, z}, 0, 100);
      add_water(snapshot, level, 140.0f, vec3(0.0f));
      RenderSettings s = water_settings(estimator, 1);
      s.spp = 16;
      auto renderer = make_renderer(s, 32, 32);
      for (int frame = 0; frame < 3; ++frame) renderer->render(snapshot, nullptr, s);
      const ImageEstimate e = image_estimate(renderer->read().linear());
      EXPECT_NEAR(e.mean, 1.0 + albedo, 5 * e.error + 1e-3) << estimator << ' ' << z - level;
      expect_finite(*renderer, estimator);
    }
  }
}

TEST_F(WaterLimitsStatistics, LiquidsInOneAnotherLoseNothing) {
  const float albedo = 0.5f;
  for (const char* estimator : kEstimators) {
    for (const float z : {20.0f, -5.0f, -30.0f}) {  // above both, in one, in both
      scene::FrameSnapshot snapshot = scene::furnace(albedo, 1.0f);
      look(snapshot, {0, 0, z}, 20, 100);
      add_water(snapshot, 0.0f, 140.0f, vec3(0.0f));
      add_water(snapshot, -10.0f, 140.0f, vec3(0.0f));
      RenderSettings s = water_settings(estimator, 1);
      s.spp = 16;
      s.water_waves = 1.5f;
      auto renderer = make_renderer(s, 32, 32);
      for (int frame = 0; frame < 3; ++frame) renderer->render(snapshot, nullptr, s);
      const ImageEstimate e = image_estimate(renderer->read().linear());
      EXPECT_NEAR(e.mean, 1.0 + albedo, 5 * e.error + 1e-3) << estimator << ' ' << z;
      expect_finite(*renderer, estimator);
    }
  }
}

// Straight down onto lava under 12 units of water, of which the surface reflects its share: the room above is dark.
TEST_F(WaterLimitsStatistics, LavaShinesThroughAFootOfWater) {
  scene::FrameSnapshot snapshot = scene::lava_bath();
  look(snapshot, {-36, 10, 60}, 90, 1);
  const RenderSettings s = water_settings("pt", 0);
  auto renderer = make_renderer(s, 3, 3);
  renderer->render(snapshot, nullptr, s);
  const float through = 1.0f - shared::dielectric_reflectance(1.0f, kIndex);
  const vec4 seen = renderer->read().linear()[4];
  EXPECT_NEAR(seen.x, 2.4f * through * std::exp(-0.004f * 12), 2e-3f);
  EXPECT_NEAR(seen.y, 0.5f * through * std::exp(-0.0015f * 12), 2e-3f);
  EXPECT_NEAR(seen.z, 0.06f * through * std::exp(-0.001f * 12), 2e-3f);
  for (const char* estimator : {"mcpg", "mcpg_nee"}) {  // they have the steps of the others
    RenderSettings all = water_settings(estimator, 3);
    all.spp = 2;
    all.water_waves = 1;
    auto other = make_renderer(all, 48, 32);
    for (int frame = 0; frame < 3; ++frame) other->render(scene::lava_bath(), nullptr, all);
    expect_finite(*other, estimator);
  }
}

// A map that leaks: rays leave the water downwards and sideways, and meet nothing.
TEST_F(WaterLimitsStatistics, WaterWithoutAWorld) {
  for (const char* estimator : {"mcpg", "mcpg_nee"})
    for (const float z : {30.0f, -30.0f}) {
      scene::FrameSnapshot snapshot = scene::one_light(10.0f, 10.0f, 0.5f);
      auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
      assets->generation = scene::next_generation();
      snapshot.assets = assets;
      ASSERT_FALSE(snapshot.instances.empty());
      snapshot.instances.front().transform[3] = glm::vec4(0, 0, 20000, 1);  // room and lamp are out of reach
      snapshot.medium = {0.002f, vec3(0.5f), 0.5f, 0.0f, 1.0f};
      snapshot.sky.beyond_everything = false;
      look(snapshot, {0, 0, z}, z, 100);
      add_water(snapshot, 0.0f, 5000.0f, vec3(1e-3f), 1e-3f);
      RenderSettings s = water_settings(estimator, 3);
      s.spp = 2;
      s.water_waves = 2;
      auto renderer = make_renderer(s, 32, 32);
      for (int frame = 0; frame < 3; ++frame) renderer->render(snapshot, nullptr, s);
      expect_finite(*renderer, estimator);
    }
}

}  // namespace
}  // namespace fb::render
