// Light about a point that glows itself, as within a flame: scattered rays meet it wherever they go, so that no
// estimator may scatter more than those rays do.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/test_device.h"
#include "render/test_image.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/shapes.h"
#include "shared/frame.h"

namespace fb::render {
namespace {

class FlameTest : public DeviceTest {
 protected:
  static RenderSettings flame_settings(const char* estimator, int bounces) {
    RenderSettings s = plain_settings(estimator, bounces);
    s.accumulate = 0;
    return s;
  }
  // Of the pixels of a frame after some that an estimator learns from.
  static ImageEstimate estimate_after(Renderer& renderer, const scene::FrameSnapshot& snapshot,
                                      const RenderSettings& s) {
    for (int i = 0; i < 12; ++i) renderer.render(snapshot, nullptr, s);
    return image_estimate(renderer.read().linear());
  }
};
using FlameSequences = FlameTest;

constexpr float kFlameAlbedo = 0.6f, kFlameGlow = 0.7f;

// A room of this width, all of whose walls are alike.
scene::FrameSnapshot glowing_room(float width, float emission) {
  auto assets = scene::new_code_assets();
  const std::uint32_t walls = scene::add_material(*assets, "walls", vec3(kFlameAlbedo), vec3(emission));
  scene::Mesh box;
  scene::add_box(box, vec3(-0.5f * width), vec3(0.5f * width), walls, true);
  scene::FrameSnapshot snapshot = scene::still(assets, scene::camera_at({0, 0, 0}, {10, 20, 0}, 90));
  snapshot.instances.push_back(
      scene::make_instance(scene::kIdWorld, scene::add_finished(*assets, std::move(box), "room")));
  return snapshot;
}

TEST_F(FlameSequences, OneReflectionWithinItHasNoVariance) {
  const double expected = static_cast<double>(kFlameGlow) * (1 + static_cast<double>(kFlameAlbedo));
  for (const char* estimator : {"pt", "nee", "mcpg", "mcpg_nee"}) {
    const RenderSettings s = flame_settings(estimator, 1);
    auto renderer = make_renderer(s, 64, 48);
    const ImageEstimate e = estimate_after(*renderer, glowing_room(8, kFlameGlow), s);
    EXPECT_NEAR(e.mean, expected, 1e-4 * expected) << estimator;
    EXPECT_LT(e.error, 1e-4 * expected) << estimator;
  }
  // In a room light is worth looking for. Its estimate scatters.
  const RenderSettings s = flame_settings("nee", 1);
  auto renderer = make_renderer(s, 64, 48);
  const ImageEstimate e = estimate_after(*renderer, glowing_room(256, kFlameGlow), s);
  EXPECT_NEAR(e.mean, expected, 4.5 * e.error);
  EXPECT_GT(e.error, 1e-3 * expected);
}

// The last ray, which does for both, mostly scatters there: three times in four it meets the light.
TEST_F(FlameTest, TheLastRayScattersMoreOftenThanItLooks) {
  const RenderSettings s = flame_settings("nee", 2);
  auto renderer = make_renderer(s, 64, 48);
  const ImageEstimate e = estimate_after(*renderer, glowing_room(8, kFlameGlow), s);
  const double a = static_cast<double>(kFlameAlbedo), last = a * a * static_cast<double>(kFlameGlow);
  EXPECT_NEAR(e.mean, static_cast<double>(kFlameGlow) * (1 + a + a * a), 4.5 * e.error);
  EXPECT_NEAR(e.error * std::sqrt(64.0 * 48.0), last * std::sqrt(1 / 0.75 - 1), 0.1 * last);
}

// What a texel emits besides, even light for one, is not its own glow.
TEST_F(FlameTest, TheGBufferKnowsWhatGlowsItself) {
  for (const float emission : {0.0f, 1e-3f}) {
    const RenderSettings s = flame_settings("mcpg", 1);
    auto renderer = make_renderer(s, 32, 24);
    scene::FrameSnapshot snapshot = glowing_room(8, emission);
    snapshot.ambient = vec3(0.5f);
    renderer->render(snapshot, nullptr, s);
    int glowing = 0;
    for (const shared::GBufferTexel& texel : renderer->read().gbuffer())
      glowing += (texel.material_metalness & shared::kTexelGlows) != 0 ? 1 : 0;
    EXPECT_EQ(glowing, emission > 0 ? 32 * 24 : 0);
  }
}

}  // namespace
}  // namespace fb::render
