// Suns over many samples: a floor has all of a sun's light, however small its disc.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "render/renderer.h"
#include "render/techniques/test_techniques.h"
#include "render/test_device.h"
#include "render/test_image.h"
#include "render/test_water.h"

namespace fb::render {
namespace {

using SunStatistics = DeviceTest;

// Of a sun that brings E to a surface across its rays a floor of albedo a reflects a / pi E cosine. A disc of 0.05
// degrees has 1 - cosine of 4e-7, six steps of a float below 1.
TEST_F(SunStatistics, AFloorHasAllOfASmallSunsLight) {
  const float albedo = 0.5f, brings = 10.0f;
  for (const char* estimator : {"nee", "mcpg_nee", "restir_di"})
    for (const float degrees : {0.05f, 1.0f})
      for (const vec3& towards : {vec3(0.5f, 0.2f, 1.0f), vec3(-0.31f, 0.72f, 0.4f)}) {
        scene::Material ground;
        ground.base_color = vec3(albedo);
        scene::FrameSnapshot snapshot = one_quad(ground, {-2000, -2000, -80}, {4000, 0, 0}, {0, 4000, 0});
        look(snapshot, {0, 0, 0}, 89.0f, 50);
        snapshot.sky.mode = scene::SkyMode::kConstant;
        snapshot.sky.color = vec3(0.0f);
        snapshot.sky.beyond_everything = true;
        const vec3 direction = glm::normalize(towards);
        snapshot.sky.suns = {{direction, vec3(brings), degrees}};
        RenderSettings s;
        s.intersector = Intersector::kBvh;
        s.estimator = estimator;
        s.bounces = 1;
        s.spp = 16;
        auto renderer = make_renderer(s, 32, 24);
        for (int i = 0; i < 4; ++i) renderer->render(snapshot, nullptr, s);
        const ImageEstimate e = image_estimate(renderer->read().linear());
        const auto expected = static_cast<double>(albedo / kPi * brings * direction.z);
        EXPECT_NEAR(e.mean, expected, 5 * e.error + 1e-3 * expected) << estimator << ' ' << degrees;
        EXPECT_LT(e.error, 2e-3 * expected) << estimator << ' ' << degrees;
      }
}

}  // namespace
}  // namespace fb::render
