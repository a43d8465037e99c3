// r_texture_filter: what camera rays see of a texture in one frame, against the mean over the pixel.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/hash.h"
#include "render/test_device.h"
#include "render/test_image.h"
#include "scene/in_code/scenes_in_code.h"
#include "shared/kinds.h"

namespace fb::render {
namespace {

class TextureFilterStatistics : public DeviceTest {
 protected:
  static RenderSettings settings_for(Intersector intersector, int filter) {
    RenderSettings s;
    s.intersector = intersector;
    s.bounces = 0;
    s.accumulate = 0;
    s.jitter = 1;
    s.texture_filter = filter;
    return s;
  }
  // Red albedo of the chequered room in each of so many frames, whose rays are jittered; `inside`: pixels that see one
  // and the same face of it in all of them.
  static std::vector<std::vector<float>> frames_of(const RenderSettings& s, int frames, std::vector<bool>& inside) {
    auto renderer = make_renderer(s, 40, 24);
    scene::FrameSnapshot snapshot = scene::moving(scene::moving_assets(), 1.0, 1.0);
    std::vector<std::vector<float>> all;
    std::vector<std::uint32_t> normals;
    for (int frame = 0; frame < frames; ++frame) {
      snapshot.frame = static_cast<std::uint64_t>(frame);
      renderer->render(snapshot, nullptr, s);
      std::vector<float>& albedo = all.emplace_back();
      const auto texels = renderer->read().gbuffer();
      inside.resize(texels.size(), true);
      normals.resize(texels.size(), texels[0].normal);
      for (std::size_t i = 0; i < texels.size(); ++i) {
        if (frame == 0) normals[i] = texels[i].normal;
        if (texels[i].id != scene::kIdWorld || texels[i].normal != normals[i]) inside[i] = false;
        albedo.push_back(texels[i].albedo_roughness.x);
      }
    }
    return all;
  }
  static std::vector<double> mean_of(const std::vector<std::vector<float>>& frames) {
    std::vector<double> mean(frames[0].size());
    for (const auto& frame : frames)
      for (std::size_t i = 0; i < mean.size(); ++i)
        mean[i] += static_cast<double>(frame[i]) / static_cast<double>(frames.size());
    return mean;
  }
};

TEST_F(TextureFilterStatistics, TheFootprintIsTheMeanOverThePixel) {
  for (const Intersector intersector : intersectors()) {
    std::vector<bool> inside;
    const auto nearest = frames_of(settings_for(intersector, shared::kFilterNearest), 256, inside);
    const auto wide = frames_of(settings_for(intersector, shared::kFilterFootprint), 64, inside);
    const std::vector<double> truth = mean_of(nearest), of_wide = mean_of(wide);
    double error_nearest = 0, error_wide = 0, error_mean = 0;
    int pixels = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (!inside[i]) continue;
      ++pixels;
      const auto square = [&](double x) { return (x - truth[i]) * (x - truth[i]); };
      for (std::size_t frame = 0; frame < 64; ++frame) {
        error_nearest += square(static_cast<double>(nearest[frame][i])) / 64;
        error_wide += square(static_cast<double>(wide[frame][i])) / 64;
      }
      error_mean += square(of_wide[i]);
    }
    ASSERT_GT(pixels, 300);
    ASSERT_GT(error_nearest / pixels, 1e-3) << "the room shows no chequers";
    EXPECT_LT(error_wide, 0.25 * error_nearest) << "one frame: better than four independent points";
    EXPECT_LT(error_mean, 0.01 * error_nearest) << "their mean";
    RecordProperty("one_frame", std::to_string(error_wide / error_nearest));
    RecordProperty("mean", std::to_string(error_mean / error_nearest));
  }
}

TEST_F(TextureFilterStatistics, MeasurementsSeeTheNearestTexelAndTheGameTheFootprint) {
  for (const bool denoise : {false, true}) {
    std::uint64_t seen[2] = {};
    for (const bool chosen : {false, true}) {
      const std::uint32_t filter = denoise ? shared::kFilterFootprint : shared::kFilterNearest;
      RenderSettings s = settings_for(Intersector::kBvh, chosen ? static_cast<int>(filter) : -1);
      s.denoise = denoise;
      auto renderer = make_renderer(s, 40, 24);
      renderer->render(scene::moving(scene::moving_assets(), 1.0, 1.0), nullptr, s);
      const auto texels = renderer->read().gbuffer();
      seen[chosen] = hash_span(std::span<const shared::GBufferTexel>(texels));
    }
    EXPECT_EQ(seen[0], seen[1]) << denoise;
  }
}

}  // namespace
}  // namespace fb::render
