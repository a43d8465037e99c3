// Fog in the denoised picture, against its mean over many samples: its energy and its error.
#include <gtest/gtest.h>

#include <vector>

#include "render/picture/test_fog_denoiser.h"

namespace fb::render {
namespace {

class FogDenoiserStatistics : public FogDenoiserTest {
 protected:
  static std::vector<vec4> foggy_reference(const uvec2& size) {
    RenderSettings s;
    s.intersector = Intersector::kBvh;
    s.estimator = "nee";
    s.spp = 64;
    s.jitter = 0;
    s.seed = 99;
    auto renderer = make_renderer(s, size.x, size.y);
    for (int i = 0; i < 16; ++i) renderer->render(foggy_box(), nullptr, s);
    return renderer->read().linear();
  }
};

TEST_F(FogDenoiserStatistics, DenoisedItKeepsItsEnergyAndLosesItsNoise) {
  const uvec2 size(96, 96);
  const std::vector<vec4> reference = foggy_reference(size);
  for (const vec2 scales : {vec2(1, 0.5f), vec2(0.5f, 0.5f)}) {
    const RenderSettings s = denoising_fog(scales.x, scales.y);
    auto renderer = make_renderer(s, size.x, size.y);
    double mean = 0, error = 0, raw = 0;
    for (int frame = 0; frame < 40; ++frame) {
      renderer->render(at_time(foggy_box(), frame), nullptr, s);
      if (frame < 24) continue;
      const std::vector<vec4> picture = renderer->read().denoised();
      mean += mean_luminance(picture) / 16;
      error += mean_square_difference(picture, reference) / 16;
    }
    RenderSettings noisy = s;
    noisy.denoise = 0;
    auto other = make_renderer(noisy, size.x, size.y);
    other->render(at_time(foggy_box(), 0), nullptr, noisy);
    raw = mean_square_difference(other->read().linear(), reference);
    // Light at half of the resolution loses some at edges.
    const bool whole = scales.x == 1.0f;
    EXPECT_NEAR(mean / mean_luminance(reference), 1.0, whole ? 0.015 : 0.05) << scales.x << " " << scales.y;
    EXPECT_LT(error, raw / (whole ? 5 : 3)) << scales.x << " " << scales.y;
    EXPECT_EQ(renderer->read().counters().not_finite + renderer->read().counters().history_not_finite, 0u);
  }
}

}  // namespace
}  // namespace fb::render
