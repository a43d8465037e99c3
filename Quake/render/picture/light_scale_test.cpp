// Light that is sampled at one pixel of a block (r_light_scale): every pixel has its turn, none is left dark, and light
// stays on its own surface.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/packing.hpp>

#include "base/hash.h"
#include "render/test_denoiser.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

using LightScaleTest = DeviceTest;

RenderSettings scaled(float scale) {
  RenderSettings s = denoising();
  s.light_scale = scale;
  return s;
}

struct Scale {
  float scale;
  int block;
};
constexpr Scale kScales[]{{0.5f, 2}, {0.33f, 3}, {0.25f, 4}};
constexpr std::uint32_t kWidth = 71, kHeight = 41;  // blocks at the edges are not whole

TEST_F(LightScaleTest, EveryPixelHasItsTurn) {
  for (const Scale& scale : kScales) {
    RenderSettings s = scaled(scale.scale);
    s.accumulate = 1;
    auto renderer = make_renderer(s, kWidth, kHeight);
    const scene::FrameSnapshot snapshot = scene::cornell_box();
    const int turns = scale.block * scale.block;
    for (int frame = 0; frame < 2 * turns; ++frame) {
      renderer->render(snapshot, nullptr, s);
      int lit = 0;
      for (const vec4& p : renderer->read().linear()) lit += static_cast<int>(p.w);
      // In a turn each pixel has one sample, and no frame has much more than its share.
      if ((frame + 1) % turns == 0) {
        for (const vec4& p : renderer->read().linear()) ASSERT_EQ(p.w, static_cast<float>((frame + 1) / turns));
      } else if (frame == 0) {
        EXPECT_LE(lit, static_cast<int>((kWidth + scale.block) * (kHeight + scale.block)) / turns) << scale.scale;
        EXPECT_GE(lit, static_cast<int>((kWidth - scale.block) * (kHeight - scale.block)) / turns) << scale.scale;
      }
    }
  }
}

TEST_F(LightScaleTest, AFurnaceHasItsValueAtEveryPixelOfEveryFrame) {
  const float albedo = 0.6f, emission = 0.7f;
  const double expected = emission * (1.0 + albedo + albedo * albedo);
  for (const Scale& scale : kScales) {
    for (const bool still : {false, true}) {
      RenderSettings s = scaled(scale.scale);
      s.accumulate = still ? 1 : 0;
      auto renderer = make_renderer(s, kWidth, kHeight);
      const scene::FrameSnapshot snapshot = scene::furnace(albedo, emission, true);
      for (int frame = 0; frame < 6; ++frame) {
        renderer->render(still ? snapshot : at_time(snapshot, frame), nullptr, s);
        for (const vec4& p : renderer->read().denoised()) ASSERT_NEAR(p.x, expected, expected / 200) << frame;
      }
      EXPECT_EQ(renderer->read().counters().history_not_finite, 0u);
    }
  }
}

// The picture of a box, against its mean over many samples: energy within 5%, and a good part of what light at every
// pixel gains over the raw picture.
TEST_F(LightScaleTest, KeepsEnergyAndMostOfTheDenoisersGain) {
  const scene::FrameSnapshot snapshot = scene::cornell_box();
  RenderSettings many;
  many.estimator = "nee";
  many.spp = 8;
  many.jitter = 0;
  many.seed = 1000;
  auto accumulating = make_renderer(many, kWidth, kHeight);
  for (int frame = 0; frame < 16; ++frame) accumulating->render(snapshot, nullptr, many);
  const std::vector<vec4> reference = accumulating->read().linear();
  std::vector<double> errors;
  for (const float scale : {1.0f, 0.5f, 0.25f}) {
    RenderSettings s = scaled(scale);
    s.estimator = "nee";
    s.jitter = 0;
    s.taa = 0;
    auto renderer = make_renderer(s, kWidth, kHeight);
    for (int frame = 0; frame < 32; ++frame) renderer->render(at_time(snapshot, frame), nullptr, s);
    const std::vector<vec4> picture = renderer->read().denoised();
    errors.push_back(mean_square_difference(picture, reference));
    EXPECT_NEAR(mean_luminance(picture), mean_luminance(reference), 0.05 * mean_luminance(reference)) << scale;
    if (scale == 1.0f) {
      errors.push_back(mean_square_difference(renderer->read().linear(), reference));  // raw
    }
  }
  // 0.09 and 0.15 of the raw picture's error here; 0.09 with light at every pixel.
  EXPECT_LT(errors[2], errors[1] / 8) << "0.5 against the raw picture";
  EXPECT_LT(errors[3], errors[1] / 4) << "0.25 against the raw picture";
}

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
