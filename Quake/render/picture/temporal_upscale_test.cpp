// A picture that is rendered smaller and scaled up over time (r_scale with r_taa), against the pixels' true means.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "render/picture/picture_size.h"
#include "render/test_denoiser.h"
#include "render/test_device.h"
#include "scene/in_code/scenes_in_code.h"
#include "shared/kinds.h"

namespace fb::render {
namespace {

constexpr std::uint32_t kShownWidth = 96, kShownHeight = 64, kFine = 8;

class TemporalUpscaleTest : public DeviceTest {
 protected:
  static void SetUpTestSuite() {
    DeviceTest::SetUpTestSuite();
    assets_ = scene::moving_assets();
  }
  static void TearDownTestSuite() {
    assets_.reset();
    DeviceTest::TearDownTestSuite();
  }
  // The chequered room in even light, so that nothing in the picture is noise.
  static scene::FrameSnapshot room(double time, double before) {
    scene::FrameSnapshot snapshot = scene::moving(assets_, time, before);
    snapshot.ambient = vec3(1.0f);
    return snapshot;
  }
  static RenderSettings settings_for(float scale) {
    RenderSettings s = denoising();
    s.bounces = 0;
    s.auto_exposure = 0;
    s.scale = scale;
    return s;
  }
  static std::vector<vec3> shown(const Renderer& renderer) {
    std::vector<vec3> colors;
    for (const std::uint32_t word : renderer.read().output())
      colors.emplace_back(word & 0xffu, (word >> 8u) & 0xffu, (word >> 16u) & 0xffu);
    return colors;
  }
  // The room at time 1: means over many points of each pixel.
  static const std::vector<vec3>& truth() {
    static const std::vector<vec3> pixels = means_of_pixels(room(1.0, 1.0));
    return pixels;
  }
  static std::vector<vec3> means_of_pixels(const scene::FrameSnapshot& snapshot) {
    RenderSettings s = settings_for(1);
    s.denoise = s.fxaa = s.taa = 0;
    s.texture_filter = shared::kFilterNearest;
    auto renderer = make_renderer(s, kShownWidth * kFine, kShownHeight * kFine);
    renderer->render(snapshot, nullptr, s);
    const std::vector<vec3> fine = shown(*renderer);
    std::vector<vec3> mean(std::size_t{kShownWidth} * kShownHeight, vec3(0.0f));
    for (std::size_t i = 0; i < fine.size(); ++i) {
      const std::size_t x = i % (kShownWidth * kFine) / kFine, y = i / (kShownWidth * kFine) / kFine;
      mean[y * kShownWidth + x] += fine[i] / static_cast<float>(kFine * kFine);
    }
    return mean;
  }
  // Mean squared error of a picture after `frames` frames of 1/60 s; `speed` of the room's clock.
  static double error_of(const RenderSettings& s, int frames, double speed) {
    auto renderer = make_renderer(s, kShownWidth, kShownHeight);
    const auto time = [&](int frame) { return 1.0 + (frame - frames) * speed / 60; };
    for (int frame = 1; frame <= frames; ++frame) {
      scene::FrameSnapshot snapshot = room(time(frame), time(frame - 1));
      snapshot.frame = static_cast<std::uint64_t>(frame);
      snapshot.cut = frame == 1;
      renderer->render(snapshot, nullptr, s);
    }
    const std::vector<vec3> picture = shown(*renderer), &pixels = truth();
    double sum = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const vec3 d = picture[i] - pixels[i];
      sum += static_cast<double>(glm::dot(d, d)) / 3;
    }
    return sum / static_cast<double>(pixels.size());
  }
  static RenderSettings of_one_frame(float scale) {
    RenderSettings s = settings_for(scale);
    s.taa = s.fxaa = 0;
    return s;
  }

  static inline std::shared_ptr<const scene::Assets> assets_;
};

TEST_F(TemporalUpscaleTest, AStillPictureGainsWhatItsPixelsLack) {
  const double whole = error_of(settings_for(1), 40, 0), scaled = error_of(settings_for(0.5f), 40, 0);
  const double bilinear = error_of(of_one_frame(0.5f), 4, 0);
  EXPECT_LT(whole, scaled);
  EXPECT_LT(scaled, 0.45 * bilinear);
  RecordProperty("whole", std::to_string(whole));
  RecordProperty("scaled", std::to_string(scaled));
  RecordProperty("bilinear", std::to_string(bilinear));
}

TEST_F(TemporalUpscaleTest, MotionCarriesIt) {
  for (const float scale : {0.37f, 0.67f}) {
    const double scaled = error_of(settings_for(scale), 40, 1), bilinear = error_of(of_one_frame(scale), 4, 1);
    EXPECT_LT(scaled, 0.55 * bilinear) << scale;
  }
}

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
