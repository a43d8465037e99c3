// What a frame does only where some pixel needs it: water that is out of sight is not worked on.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "render/renderer.h"
#include "render/test_denoiser.h"
#include "render/test_device.h"
#include "render/test_water.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

constexpr float kAlbedo = 0.5f;

class WorkTest : public WaterDeviceTest {
 protected:
  static RenderSettings settings() {
    RenderSettings s = water_settings("pt", 1);
    s.denoise = 1;
    s.light_scale = 1;
    s.accumulate = 0;
    s.water_waves = 0;
    s.first_spp = 1;
    return s;
  }
  // A closed room whose walls glow, with water in it; `pitch` 60 sees nothing but its surface, -60 none of it.
  static scene::FrameSnapshot room(float pitch, float emission, float scattering) {
    scene::FrameSnapshot snapshot = scene::furnace(kAlbedo, emission);
    look(snapshot, {0, 0, 20}, pitch, 60);
    add_water(snapshot, 0.0f, 140.0f, vec3(0.0f), scattering);
    return snapshot;
  }
};

TEST_F(WorkTest, IsForWaterInSight) {
  RenderSettings s = settings();
  for (const float scattering : {0.0f, 0.01f}) {
    auto renderer = make_renderer(s, 40, 24);
    const auto work = [&](const scene::FrameSnapshot& snapshot, int frame) {
      renderer->render(at_time(snapshot, frame), nullptr, s);
      return renderer->read().work();
    };
    const scene::FrameSnapshot down = room(60, 1, scattering), up = room(-60, 1, scattering);
    FrameWork seen = work(down, 1);
    EXPECT_EQ(seen.water_tiles, 15u);
    EXPECT_TRUE(seen.second);
    EXPECT_EQ(seen.medium, scattering > 0);
    seen = work(up, 2);
    EXPECT_EQ(seen.water_tiles, 0u);
    EXPECT_FALSE(seen.second);
    EXPECT_FALSE(seen.medium);
    EXPECT_EQ(work(down, 3).water_tiles, 15u);
    // Fog scatters light to every pixel.
    scene::FrameSnapshot fog = up;
    fog.medium.extinction = 0.001f;
    fog.medium.albedo = vec3(1);
    EXPECT_TRUE(work(fog, 4).medium);
    EXPECT_FALSE(renderer->read().work().second);
  }
}

// A part of the picture.
TEST_F(WorkTest, IsOfTheTilesThatShowWater) {
  RenderSettings s = settings();
  scene::FrameSnapshot snapshot = room(0, 1, 0);  // the horizon is in the middle
  auto renderer = make_renderer(s, 40, 32);
  renderer->render(at_time(snapshot, 1), nullptr, s);
  std::vector<bool> tiles(20, false);
  const auto gbuffer = renderer->read().gbuffer();
  for (std::size_t i = 0; i < gbuffer.size(); ++i)
    if ((gbuffer[i].material_metalness & shared::kTexelLiquid) != 0) tiles[i / 40 / 8 * 5 + i % 40 / 8] = true;
  EXPECT_EQ(renderer->read().work().water_tiles, std::ranges::count(tiles, true));
  EXPECT_GT(std::ranges::count(tiles, true), 0);
  EXPECT_LT(std::ranges::count(tiles, true), 20);
}

// While water is out of sight nothing is remembered of it: what is left of earlier frames has no say when it comes
// back.
TEST_F(WorkTest, WhatIsOutOfSightIsForgotten) {
  RenderSettings s = settings();
  auto renderer = make_renderer(s, 40, 24);
  int frame = 0;
  const auto render = [&](const scene::FrameSnapshot& snapshot) {
    renderer->render(at_time(snapshot, ++frame), nullptr, s);
  };
  const scene::FrameSnapshot bright = room(60, 1, 0), away = room(-60, 1, 0), dim = room(60, 0.1f, 0);
  for (int i = 0; i < 4; ++i) render(bright);
  render(away);
  render(dim);
  // What the pixels' own surfaces were in the frame before was the ceiling, so that these have no history either.
  const auto pixels = renderer->read().denoised();
  for (const vec4& p : pixels) EXPECT_NEAR(p.x, 0.1f * (1 + kAlbedo), 0.005f);
  EXPECT_EQ(renderer->read().counters().history_not_finite, 0u);
}

}  // namespace
}  // namespace fb::render
