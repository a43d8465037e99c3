// A picture that is rendered smaller and scaled up over time (r_scale with r_taa), against the pixels' true means.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "render/picture/picture_size.h"
#include "render/picture/test_temporal_upscale.h"
#include "render/test_denoiser.h"

namespace fb::render {
namespace {

TEST_F(TemporalUpscaleTest, TheFirstFrameHasNoPast) {
  // One frame whose rays are jittered: up to half a pixel beside their places.
  EXPECT_LT(error_of(settings_for(0.5f), 1, 1), 1.3 * error_of(of_one_frame(0.5f), 1, 1));
}

TEST_F(TemporalUpscaleTest, JitterLosesNoHistoryOfSlantedPlanes) {
  // Large pixels: from one's side to the other a floor's depth changes by more than any tolerance.
  const RenderSettings s = settings_for(0.37f);
  auto renderer = make_renderer(s, kShownWidth, kShownHeight);
  for (int frame = 1; frame <= 32; ++frame) renderer->render(at_time(room(1.0, 1.0), frame), nullptr, s);
  const std::vector<std::uint32_t> frames = history_lengths(*renderer);
  const auto kept = std::count(frames.begin(), frames.end(), 32u);
  EXPECT_GT(kept, static_cast<std::ptrdiff_t>(frames.size() * 95 / 100));
  RecordProperty("kept", std::to_string(static_cast<double>(kept) / static_cast<double>(frames.size())));
}

TEST(PictureSize, ScaleIsAFractionOrQuakeSpasmsWholeNumber) {
  RenderSettings s;
  EXPECT_EQ(scaled_size({1280, 720}, s), uvec2(1280, 720));
  s.scale = scale_for_pixels({1280, 720}, 480 * 270);
  EXPECT_EQ(scaled_size({1280, 720}, s), uvec2(480, 270));
  EXPECT_EQ(scale_for_pixels({320, 180}, 480 * 270), 1.0f);
  s.scale = 3;
  EXPECT_EQ(scaled_size({1280, 720}, s), uvec2(427, 240));
}

TEST(PictureSize, AnAreaEndsWhereTheOutputDoes) {
  const uvec2 output(640, 480);
  EXPECT_EQ(area_within({uvec2(10, 20), uvec2(30, 40)}, output), (scene::Area{uvec2(10, 20), uvec2(30, 40)}));
  EXPECT_EQ(area_within({uvec2(600, 100), uvec2(100, 500)}, output), (scene::Area{uvec2(600, 100), uvec2(40, 380)}));
  const scene::Area all{uvec2(0), output};
  EXPECT_EQ(area_within({}, output), all) << "none was asked for";
  EXPECT_EQ(area_within({uvec2(700, 0), uvec2(50, 50)}, output), all) << "it lies beyond";
}

}  // namespace
}  // namespace fb::render
