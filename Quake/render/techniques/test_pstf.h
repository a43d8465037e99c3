// Fields of light in furnaces: what their tests share.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "render/test_device.h"
#include "render/test_image.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {

inline constexpr float kFieldAlbedo = 0.6f, kFieldEmission = 0.7f;
inline scene::FrameSnapshot lit_furnace() { return scene::furnace(kFieldAlbedo, kFieldEmission, true); }

class PstfTest : public DeviceTest {
 protected:
  static RenderSettings pstf_settings(const std::string& estimator, int bounces = 2) {
    RenderSettings s;
    s.estimator = estimator;
    s.bounces = bounces;
    s.accumulate = 0;
    return s;
  }
  static void expect_furnace(const Renderer& renderer, int bounces, const std::string& what,
                             float emission = kFieldEmission) {
    double expected = 0;
    for (int k = 0; k <= bounces; ++k)
      expected += static_cast<double>(emission) * std::pow(static_cast<double>(kFieldAlbedo), k);
    const ImageEstimate e = image_estimate(renderer.read().linear());
    EXPECT_NEAR(e.mean, expected, 5 * e.error + 1e-5 * expected) << what;
    EXPECT_EQ(renderer.read().counters().not_finite, 0u) << what;
  }
  // Mean over the picture's middle of a debug view's green, 0 to 255.
  static double green_of(Renderer& renderer, const scene::FrameSnapshot& scene, RenderSettings s, std::uint32_t view) {
    s.debug_view = static_cast<int>(view);
    s.fxaa = 0;
    renderer.render(scene, nullptr, s);
    const auto output = renderer.read().output();
    double sum = 0;
    for (const std::uint32_t pixel : output) sum += static_cast<double>((pixel >> 8u) & 255u);
    return sum / static_cast<double>(output.size());
  }
};

}  // namespace fb::render
