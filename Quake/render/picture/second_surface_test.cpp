// The denoiser over water: a pixel shows two surfaces, and the light on each is denoised by itself, where that surface
// was.
#include <gtest/gtest.h>

#include <algorithm>

#include "render/renderer.h"
#include "render/test_denoiser.h"
#include "render/test_device.h"
#include "render/test_water.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

using SecondSurfaceTest = WaterDeviceTest;

// In a closed room of even light every sample of either surface is the same: so is every pixel, from the first frame
// on, though in most a path begins at one of both alone.
TEST_F(SecondSurfaceTest, EvenLightStaysEven) {
  const float albedo = 0.5f;
  for (const float light_scale : {1.0f, 0.5f}) {
    for (const float z : {-20.0f, 20.0f}) {
      scene::FrameSnapshot snapshot = scene::furnace(albedo, 1.0f);
      look(snapshot, {0, 0, z}, z / 4, 100);
      add_water(snapshot, 0.0f, 140.0f, vec3(0.0f));
      RenderSettings s = denoised_water_settings(light_scale);
      s.water_waves = 1.5f;
      s.first_spp = 1;
      auto renderer = make_renderer(s, 48, 32);
      for (int frame = 1; frame <= 4; ++frame) {
        renderer->render(at_time(snapshot, frame), nullptr, s);
        float least = 1e9f, most = 0;
        for (const vec4& p : renderer->read().denoised()) {
          least = std::min(least, p.x);
          most = std::max(most, p.x);
        }
        EXPECT_NEAR(least, 1.0f + albedo, 0.03f) << light_scale << ' ' << z << ' ' << frame;
        EXPECT_NEAR(most, 1.0f + albedo, 0.03f) << light_scale << ' ' << z << ' ' << frame;
      }
      EXPECT_EQ(renderer->read().counters().history_not_finite, 0u);
    }
  }
}

// Light that goes out in a few frames: also blocks that no path has asked since, among others of which none was, have a
// number.
TEST_F(SecondSurfaceTest, LightThatGoesOutLeavesNoHoles) {
  for (const float light_scale : {1.0f, 0.5f}) {
    scene::FrameSnapshot bright = scene::furnace(0.5f, 1.0f);
    look(bright, {0, 0, -20}, -5, 100);
    add_water(bright, 0.0f, 140.0f, vec3(0.0f));
    scene::FrameSnapshot dim = bright;
    dim.instances[0].flags |= scene::kInstanceColor;
    dim.instances[0].color = vec3(0.5f);
    dim.instances[0].emission = vec3(0.01f);
    RenderSettings s = denoised_water_settings(light_scale);
    s.water_waves = 1.5f;
    auto renderer = make_renderer(s, 48, 32);
    for (int frame = 1; frame <= 12; ++frame) {
      renderer->render(at_time(frame < 9 ? bright : dim, frame), nullptr, s);
      for (const vec4& p : renderer->read().denoised()) {
        ASSERT_GE(p.x, 0.0f) << light_scale << ' ' << frame;
        ASSERT_LT(p.x, 2.0f) << light_scale << ' ' << frame;
      }
    }
    EXPECT_EQ(renderer->read().counters().history_not_finite, 0u);
  }
}

}  // namespace
}  // namespace fb::render
