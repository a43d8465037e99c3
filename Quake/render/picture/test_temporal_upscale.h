// A room that is rendered smaller and scaled up over time, and how far its picture is from the pixels' true means.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/test_denoiser.h"
#include "render/test_device.h"
#include "scene/in_code/scenes_in_code.h"
#include "shared/kinds.h"

namespace fb::render {

class TemporalUpscaleTest : public DeviceTest {
 protected:
  static constexpr std::uint32_t kShownWidth = 96, kShownHeight = 64, kFine = 8;

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
    s.taa_scale = 0;
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
    s.host_present = 0;  // bilinear
    return s;
  }

  static inline std::shared_ptr<const scene::Assets> assets_;
};

}  // namespace fb::render
