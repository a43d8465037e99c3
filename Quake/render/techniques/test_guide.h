// What tests of path guiding share: settings, a furnace with its closed form, and a rocket in flight.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "render/test_device.h"
#include "render/test_image.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_in_motion.h"

namespace fb::render {

class GuideTest : public DeviceTest {
 protected:
  // A frame of the rocket's flight without noise to speak of.
  static std::vector<vec4> rocket_reference(const std::shared_ptr<const scene::Assets>& assets, std::uint64_t frame,
                                            const uvec2& size) {
    RenderSettings s;
    s.estimator = "nee";
    s.spp = 64;
    s.jitter = 0;
    s.seed = 77;
    auto renderer = make_renderer(s, size.x, size.y);
    for (int i = 0; i < 4; ++i) renderer->render(scene::rocket(assets, frame, 60), nullptr, s);
    return renderer->read().linear();
  }
  static RenderSettings guided(int spp, int bounces, const std::function<void(RenderSettings&)>& change = {}) {
    RenderSettings s;
    s.estimator = "mcpg";
    s.spp = spp;
    s.bounces = bounces;
    if (change) change(s);
    return s;
  }
  static constexpr float kAlbedo = 0.6f, kEmission = 0.7f;
  static scene::FrameSnapshot furnace() { return scene::furnace(kAlbedo, kEmission, true); }
  // 4.5 standard errors, and rounding (lost rays are in the errors).
  static void expect_furnace(const Renderer& renderer, int bounces, double albedo, const std::string& what) {
    double expected = 0;
    for (int k = 0; k <= bounces; ++k) expected += std::pow(albedo, k);
    expected *= static_cast<double>(kEmission);
    const ImageEstimate e = image_estimate(renderer.read().linear());
    EXPECT_NEAR(e.mean, expected, 4.5 * e.error + 4e-6 * expected) << what;
    EXPECT_LT(e.error, 0.01 * expected) << what << ": the test can see little";
    EXPECT_EQ(renderer.read().counters().not_finite, 0u) << what;
    EXPECT_EQ(renderer.read().counters().states_not_finite, 0u) << what;
  }
};

}  // namespace fb::render
