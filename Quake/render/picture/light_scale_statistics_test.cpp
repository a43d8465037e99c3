// Light that is sampled at one pixel of a block (r_light_scale), over many frames: every pixel has its turn, none is
// left dark, and the picture keeps its energy.
#include <gtest/gtest.h>

#include <vector>

#include "render/picture/test_light_scale.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

using LightScaleStatistics = LightScaleTest;

struct Scale {
  float scale;
  int block;
};
constexpr Scale kScales[]{{0.5f, 2}, {0.33f, 3}, {0.25f, 4}};

TEST_F(LightScaleStatistics, EveryPixelHasItsTurn) {
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

TEST_F(LightScaleStatistics, AFurnaceHasItsValueAtEveryPixelOfEveryFrame) {
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
TEST_F(LightScaleStatistics, KeepsEnergyAndMostOfTheDenoisersGain) {
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

}  // namespace
}  // namespace fb::render
