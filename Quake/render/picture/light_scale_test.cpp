// Light that is sampled at one pixel of a block (r_light_scale): it stays on its own surface, and measurements sample
// every pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/packing.hpp>

#include "base/hash.h"
#include "render/picture/test_light_scale.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

// While a view is still the history is what was gathered, unfiltered. At silhouettes it differs from that of light at
// every pixel by 6% of the mean; if samples of other surfaces counted like those of this one, by 26%.
TEST_F(LightScaleTest, LightStaysOnItsOwnSurface) {
  const scene::FrameSnapshot snapshot = scene::cornell_box();
  std::vector<std::vector<float>> gathered;
  std::vector<bool> silhouette(kWidth * kHeight);
  for (const float scale : {1.0f, 0.5f}) {
    RenderSettings s = scaled(scale);
    s.estimator = "nee";
    s.accumulate = 1;
    s.jitter = 0;
    s.spp = 8;
    auto renderer = make_renderer(s, kWidth, kHeight);
    for (int frame = 0; frame < 32; ++frame) renderer->render(snapshot, nullptr, s);
    std::vector<float>& green = gathered.emplace_back();
    for (const auto& texel : renderer->read().history()) green.push_back(glm::unpackHalf2x16(texel.x).y);
    const auto g = renderer->read().gbuffer();
    for (std::uint32_t i = kWidth; i + kWidth < g.size(); ++i) {
      for (const std::uint32_t j : {i - 1, i + 1, i - kWidth, i + kWidth})
        silhouette[i] = silhouette[i] || (g[i].motion.z > 0 && g[j].id != g[i].id);
    }
  }
  double difference = 0, sum = 0;
  int pixels = 0;
  for (std::size_t i = 0; i < silhouette.size(); ++i) {
    if (!silhouette[i]) continue;
    difference += std::abs(gathered[1][i] - gathered[0][i]);
    sum += gathered[0][i];
    ++pixels;
  }
  EXPECT_GT(pixels, 100);
  EXPECT_LT(difference, sum / 8);
}

TEST_F(LightScaleTest, DebugViewsAndMeasurementsSampleEveryPixel) {
  const scene::FrameSnapshot snapshot = scene::cornell_box();
  for (const bool view : {false, true}) {
    std::vector<std::uint64_t> hashes;
    for (const float scale : {1.0f, 0.25f}) {
      RenderSettings s = scaled(scale);
      s.jitter = 0;
      if (view)
        s.debug_view = 1;
      else
        s.denoise = 0;
      auto renderer = make_renderer(s, kWidth, kHeight);
      renderer->render(snapshot, nullptr, s);
      const auto image = renderer->read().linear();
      hashes.push_back(hash_span(std::span<const vec4>(image)));
    }
    EXPECT_EQ(hashes[0], hashes[1]) << view;
  }
}

}  // namespace
}  // namespace fb::render
