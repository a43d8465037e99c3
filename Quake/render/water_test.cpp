// Water (r_water 1): interfaces that reflect, refract and absorb, against closed forms. What takes many samples:
// water_statistics_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "render/picture/frame_constants.h"
#include "render/renderer.h"
#include "render/test_device.h"
#include "render/test_image.h"
#include "render/test_water.h"
#include "scene/in_code/scenes_in_code.h"
#include "shared/dielectric.h"

namespace fb::render {
namespace {

using WaterTest = WaterDeviceTest;

// A floor that glows under a depth of water: where each ray meets it by Snell's law, and what of its light arrives.
TEST_F(WaterTest, BendsAndAbsorbsAsTheFormulasSay) {
  const float height = 40.0f, depth = 80.0f;
  const vec3 absorption(0.01f, 0.002f, 0.0f);
  scene::Material ground;
  ground.emission = vec3(1.0f);
  ground.emission_kind = scene::EmissionKind::kConstant;
  scene::FrameSnapshot snapshot = one_quad(ground, {-2000, -2000, -depth}, {4000, 0, 0}, {0, 4000, 0});
  look(snapshot, {0, 0, height}, 50.0f, 60);
  add_water(snapshot, 0.0f, 2000.0f, absorption);
  const RenderSettings s = water_settings("pt", 0);
  constexpr int kSize = 33;
  auto renderer = make_renderer(s, kSize, kSize);
  renderer->render(snapshot, nullptr, s);
  const auto texels = renderer->read().gbuffer();
  const auto image = renderer->read().linear();
  for (int row = 0; row < kSize; row += 8) {
    const auto at = static_cast<std::size_t>(row * kSize + kSize / 2);
    const float above = 2.0f * (static_cast<float>(row) + 0.5f) / kSize - 1.0f;
    const float angle = radians(40.0f) - std::atan(above * std::tan(radians(30.0f)));  // from the vertical
    const float inner = std::asin(std::sin(angle) / kIndex), way = depth / std::cos(inner);
    const float x = height * std::tan(angle) + depth * std::tan(inner);
    EXPECT_NEAR(texels[at].position_t.x, x, 2e-3f * (1 + x)) << row;
    EXPECT_NEAR(texels[at].position_t.z, -depth, 1e-2f) << row;
    const float through = 1.0f - shared::dielectric_reflectance(std::cos(angle), kIndex);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(image[at][c], through * std::exp(-absorption[c] * way), 1e-3f) << row << ' ' << c;
  }
}

TEST_F(WaterTest, TheCameraUnderWaterSeesLessTheFartherItLooks) {
  scene::FrameSnapshot snapshot = scene::furnace(0.0f, 1.0f);
  look(snapshot, {-64, 0, -20}, 0, 20);
  add_water(snapshot, 100.0f, 140.0f, vec3(0.01f, 0.0f, 0.1f));
  const RenderSettings s = water_settings("pt", 1);
  auto renderer = make_renderer(s, 33, 33);
  renderer->render(snapshot, nullptr, s);
  const vec4 middle = renderer->read().linear()[33 * 16 + 16];
  EXPECT_NEAR(middle.x, std::exp(-0.01f * 192), 1e-3f);
  EXPECT_NEAR(middle.y, 1.0f, 1e-5f);
  EXPECT_NEAR(middle.z, std::exp(-0.1f * 192), 1e-3f);
}

// What absorbs light needs no tint on top; a liquid that is drawn opaque, or none at all, has the whole.
TEST(WaterTint, IsLeftOutWhereTheCameraIsInAClearLiquid) {
  scene::FrameSnapshot snapshot;
  snapshot.screen_tint = vec4(0.5f, 0.3f, 0.2f, 0.5f);
  snapshot.tint_in_liquid = vec4(1, 0, 0, 0.1f);
  RenderSettings s;
  const auto tint = [&] { return frame_constants(snapshot, s, {8, 8}, {8, 8}).screen_tint; };
  s.water = 1;
  EXPECT_EQ(tint(), snapshot.screen_tint);
  snapshot.camera_liquid = 3;
  EXPECT_EQ(tint(), snapshot.tint_in_liquid);
  s.water = 0;
  EXPECT_EQ(tint(), snapshot.screen_tint);
}

TEST_F(WaterTest, WithoutWaterNothingChanges) {
  std::uint64_t hashes[2];
  for (const int water : {0, 1}) {
    RenderSettings s = water_settings("mcpg_nee", 2);
    s.water = water;
    s.deterministic = 1;
    auto renderer = make_renderer(s, 48, 48);
    for (int frame = 0; frame < 3; ++frame) renderer->render(scene::cornell_box(), nullptr, s);
    hashes[water] = image_hash(*renderer);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace fb::render
