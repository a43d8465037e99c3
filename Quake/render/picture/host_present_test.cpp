// The last step on the host: its filter, and that it draws what the device's own does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <vector>

#include "render/picture/host_present.h"
#include "render/picture/test_temporal_upscale.h"
#include "render/test_device.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

PresentedPicture picture_of(uvec2 size, uvec2 output) {
  PresentedPicture p;
  p.size = size;
  p.output = output;
  p.place = {uvec2(0), output};
  return p;
}

std::vector<std::uint32_t> present(const PresentedPicture& p, const std::vector<std::uint32_t>& pixels,
                                   const scene::DrawList* list = nullptr) {
  HostPresent host;
  host.prepare(list);
  std::vector<std::uint32_t> output(std::size_t{p.output.x} * p.output.y, 0x12345678u);
  host.draw(p, pixels, output);
  return output;
}

// How far two pictures are apart, in any channel of any pixel, of 255.
int most_apart(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  EXPECT_EQ(a.size(), b.size());
  int most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    for (unsigned c = 0; c < 32; c += 8)
      most = std::max(most, std::abs(static_cast<int>(a[i] >> c & 255u) - static_cast<int>(b[i] >> c & 255u)));
  return most;
}

TEST(HostPresent, WeightsAddUpAndKeepStraightLines) {
  for (const float sharpness : {0.0f, 0.5f, 1.0f})
    for (const float f : {0.0f, 0.25f, 0.5f, 0.9f}) {
      const auto w = cubic_weights(f, sharpness);
      EXPECT_NEAR(std::accumulate(w.begin(), w.end(), 0.0f), 1.0f, 1e-6f) << sharpness << ' ' << f;
      if (sharpness == 0.5f) {
        EXPECT_NEAR(-w[0] + w[2] + 2 * w[3], f, 1e-6f) << f;
      }
    }
}

TEST(HostPresent, AnEvenPictureStaysSoAtAnySize) {
  for (std::uint32_t level = 0; level < 256; ++level) {
    const std::uint32_t color = level | (255u - level) << 8u | (level / 2u) << 16u | 0xff000000u;
    const std::vector<std::uint32_t> pixels(6 * 5, color);
    for (const std::uint32_t pixel : present(picture_of({6, 5}, {17, 11}), pixels)) ASSERT_EQ(pixel, color);
  }
}

TEST(HostPresent, ARampStaysStraight) {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t i = 0; i < 16 * 4; ++i) pixels.push_back(0xff000000u | (i % 16u * 16u) << 8u);
  const auto shown = present(picture_of({16, 4}, {48, 12}), pixels);
  for (std::size_t x = 6; x < 42; ++x) {
    const double wanted = 16.0 * ((static_cast<double>(x) + 0.5) / 3.0 - 0.5);
    EXPECT_NEAR(static_cast<double>(shown[5 * 48 + x] >> 8u & 255u), wanted, 0.51) << x;
  }
}

TEST(HostPresent, AnEdgeGainsContrastWithTheSetting) {
  std::vector<std::uint32_t> pixels(8 * 8, 0xff404040u);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (i % 8 >= 4) pixels[i] = 0xffc0c0c0u;
  PresentedPicture p = picture_of({8, 8}, {64, 64});
  const auto brightest = [&](float sharpness) {
    p.sharpness = sharpness;
    std::uint32_t most = 0;
    for (const std::uint32_t pixel : present(p, pixels)) most = std::max(most, pixel & 255u);
    return most;
  };
  EXPECT_EQ(brightest(0.0f), 0xc0u);
  EXPECT_GT(brightest(0.5f), 0xc0u + 5u);
  EXPECT_GT(brightest(1.0f), brightest(0.5f) + 5u);
}

// Everything at once, by the host and by the device: they may round differently, once for each thing drawn over
// another.
class LastStepTest : public TemporalUpscaleTest {
 protected:
  static scene::DrawList over() {
    scene::DrawList list;
    auto atlas = std::make_shared<scene::DrawAtlas>();
    atlas->width = 3;
    atlas->height = 2;
    atlas->texels = {0xff0000ffu, 0x80ff8000u, 0x00000000u, 0xff20c040u, 0xffffffffu, 0x40123456u};
    list.atlas = atlas;
    list.quads.push_back({{-5, 3.5f}, {30, 20}, {0, 0}, {0, 0}, {0.2f, 0.9f, 0.1f, 0.5f}});
    list.quads.push_back({{10, 8}, {60.5f, 50}, {0, 0}, {3, 2}, {1, 1, 1, 1}});
    list.quads.push_back({{40, 30}, {200, 300}, {1, 0}, {3, 2}, {0.7f, 0.5f, 1, 0.6f}});
    return list;
  }
};

TEST_F(LastStepTest, HostAndDeviceDrawTheSame) {
  if (!device_->is_software()) GTEST_SKIP() << "not on a CPU";
  for (const bool warps : {false, true})
    for (const bool swaps : {false, true})
      for (const bool placed : {false, true}) {
        scene::FrameSnapshot snapshot = room(1.0, 1.0);
        snapshot.screen_tint = vec4(0.8f, 0.4f, 0.1f, 0.3f);
        snapshot.in_liquid = snapshot.was_in_liquid = warps;
        RenderSettings s = settings_for(1);
        s.water_warp = 1;
        s.gamma = 0.8f;
        s.contrast = 1.2f;
        scene::DrawList list = over();
        if (placed) list.picture = {uvec2(7, 5), uvec2(60, 40)};
        std::vector<std::vector<std::uint32_t>> shown;
        for (const int host : {0, 1}) {
          s.host_present = host;
          auto renderer = make_renderer(s, kShownWidth, kShownHeight);
          renderer->set_swap_red_blue(swaps);
          renderer->render(snapshot, &list, s);
          shown.push_back(renderer->read().output());
          EXPECT_EQ(renderer->pass_times().back().name, "present");
        }
        EXPECT_LE(most_apart(shown[0], shown[1]), 4) << warps << swaps << placed;
        EXPECT_GT(most_apart(shown[0], std::vector<std::uint32_t>(shown[0].size(), 0xff000000u)), 100);
      }
}

// Scaled up by the host from what is rendered, a still picture is nearer to the pixels' means than a frame that is
// scaled up by itself; the temporal filter at twice the rendered size nearer still.
TEST_F(LastStepTest, AStillPictureThatIsScaledUp) {
  if (!device_->is_software()) GTEST_SKIP() << "not on a CPU";
  RenderSettings s = settings_for(0.5f);
  s.taa_scale = 1;
  const double once = error_of(s, 24, 0), bilinear = error_of(of_one_frame(0.5f), 4, 0);
  s.taa_scale = 2;
  const double twice = error_of(s, 24, 0);
  EXPECT_LT(once, 0.9 * bilinear);
  EXPECT_LT(twice, once);
  RecordProperty("once", std::to_string(once));
  RecordProperty("twice", std::to_string(twice));
  RecordProperty("bilinear", std::to_string(bilinear));
}

}  // namespace
}  // namespace fb::render
