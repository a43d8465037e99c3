// Even light (FrameSnapshot::ambient): what the camera sees reflects it once, exactly, whatever the estimator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "render/techniques/test_techniques.h"
#include "render/test_device.h"
#include "scene/in_code/scene_of_kinds.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

using AmbientStatistics = DeviceTest;

RenderSettings settings_of(const std::string& estimator, int bounces) {
  RenderSettings s;
  s.intersector = Intersector::kBvh;
  s.estimator = estimator;
  s.spp = 2;
  s.bounces = bounces;
  s.deterministic = 1;
  return s;
}

// A closed room of albedo a and emission e under even light A: e (1 + a + ... + a^n) + a A. Where e is 0 all estimators
// give it without noise, where not, pt alone: each of its paths finds the same.
TEST_F(AmbientStatistics, FurnaceGivesItsClosedForm) {
  const float albedo = 0.6f;
  const vec3 light(0.5f, 0.25f, 2.0f);
  for (const std::string& estimator : one_of_each_family(Whose::kAll))
    for (const float emission : {0.0f, 0.7f})
      for (const int bounces : {0, 1, 3}) {
        if (estimator != "pt" && (emission > 0.0f || bounces < 3)) continue;
        const RenderSettings s = settings_of(estimator, bounces);
        scene::FrameSnapshot snapshot = scene::furnace(albedo, emission);
        snapshot.ambient = light;
        auto renderer = make_renderer(s, 24, 16);
        for (int frame = 0; frame < 3; ++frame) renderer->render(snapshot, nullptr, s);
        float sum = 0.0f;
        for (int k = 0; k <= bounces; ++k) sum += std::pow(albedo, static_cast<float>(k));
        const vec3 expected = vec3(emission * sum) + albedo * light;
        for (const vec4& p : renderer->read().linear())
          for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(p[c], expected[c], 1e-5f * expected[c]) << estimator << ' ' << emission << ' ' << bounces;
      }
}

// All kinds of light, textures, holes, panes and coats: with even light each pixel is its albedo times that light
// brighter, and no path differs.
TEST_F(AmbientStatistics, AddsTheSameToEveryEstimator) {
  const vec3 light(0.5f, 0.25f, 2.0f);
  for (const std::string& estimator : one_of_each_family(Whose::kAll)) {
    const RenderSettings s = settings_of(estimator, 2);
    scene::FrameSnapshot snapshot = scene::light_of_every_kind();
    std::vector<vec4> images[2];
    std::vector<shared::GBufferTexel> texels;
    for (const bool lit : {false, true}) {
      snapshot.ambient = lit ? light : vec3(0.0f);
      auto renderer = make_renderer(s, 48, 36);
      for (int frame = 0; frame < 3; ++frame) {
        snapshot.time = frame;  // nothing is accumulated
        renderer->render(snapshot, nullptr, s);
      }
      images[lit] = renderer->read().linear();
      texels = renderer->read().gbuffer();
    }
    float largest = 0.0f;
    for (std::size_t i = 0; i < texels.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const float added = texels[i].albedo_roughness[c] * light[c];
        largest = std::max(largest, added);
        ASSERT_NEAR(images[1][i][c] - images[0][i][c], added, 1e-5f * (1.0f + images[1][i][c]))
            << estimator << ' ' << i;
      }
    EXPECT_GT(largest, 0.1f);
  }
}

// In fog: what is left of it from the wall, and as much of A as the fog takes from the ray times its albedo.
TEST_F(AmbientStatistics, FogScattersIt) {
  const float albedo = 0.6f, light = 0.5f;
  RenderSettings s = settings_of("pt", 1);
  scene::FrameSnapshot snapshot = scene::furnace(albedo, 0.0f);
  snapshot.ambient = vec3(light);
  snapshot.medium.extinction = 0.01f;
  snapshot.medium.albedo = vec3(0.8f, 0.4f, 0.0f);
  auto renderer = make_renderer(s, 24, 16);
  renderer->render(snapshot, nullptr, s);
  const std::vector<vec4> picture = renderer->read().linear();
  const std::vector<shared::GBufferTexel> texels = renderer->read().gbuffer();
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const float left = std::exp(-0.01f * texels[i].position_t.w);
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(picture[i][c], light * (albedo * left + snapshot.medium.albedo[c] * (1.0f - left)), 1e-4f) << i;
  }
}

}  // namespace
}  // namespace fb::render
