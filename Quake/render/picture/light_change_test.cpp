// Light that changes is followed at once, and light that does not keeps its history (Shaders/shared/light_change.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "render/test_denoiser.h"
#include "scene/in_code/scenes_in_code.h"
#include "shared/light_change.h"

namespace fb::render {
namespace {

using LightChangeSequences = DeviceTest;

TEST(LightChange, AHistoryIsKeptByWhatChanceMayDo) {
  // 400 samples of deviation 2 and mean 1 over 19 frames' means: the mean's error is 0.1.
  const auto kept = [](float difference, float samples = 400) {
    const float square = samples * (4.0f + difference * difference);
    return shared::kept_of_change({difference * samples, square, samples, 4.0f * samples, 19.0f * samples, samples});
  };
  EXPECT_EQ(kept(0.0f), 1.0f);
  EXPECT_EQ(kept(-0.3f), 1.0f) << "three deviations";
  EXPECT_EQ(kept(0.5f), 0.0f);
  EXPECT_EQ(kept(-0.5f), 0.0f);
  EXPECT_GT(kept(0.39f), 0.0f);
  EXPECT_LT(kept(0.39f), 1.0f);
  EXPECT_EQ(kept(-0.5f, 40), 1.0f) << "of fewer samples";
  EXPECT_EQ(kept(5.0f, 3), 1.0f) << "of next to none";
  // One sample that is a thousand times as bright is chance, whatever the variance was.
  EXPECT_EQ(shared::kept_of_change({1000, 1e6f, 400, 400, 400 * 19, 400}), 1.0f);
  // Without noise a hundredth more is nothing, a tenth is.
  EXPECT_EQ(shared::kept_of_change({4, 0.04f, 400, 0, 400 * 19, 400}), 1.0f);
  EXPECT_EQ(shared::kept_of_change({40, 4, 400, 0, 400 * 19, 400}), 0.0f);
}

struct Lamp {
  scene::FrameSnapshot dim, bright;
};
Lamp lamp() {
  Lamp l{scene::one_light(24, 60, 0.5f), scene::one_light(24, 60, 0.5f)};
  for (scene::Instance& i : l.dim.instances)
    if (i.id == scene::kIdEntityLight) i.emission *= 0.1f;
  return l;
}
RenderSettings settings_at(float light_scale) {
  RenderSettings s = denoising();
  s.light_scale = light_scale;
  s.estimator = "nee";
  s.svgf_levels = 0;
  return s;
}

// A flash of two frames: what is shown of it, relative to what each frame's light is in the mean.
TEST_F(LightChangeSequences, InItsSecondFrameAFlashIsWhatItIs) {
  const Lamp l = lamp();
  for (const float light_scale : {1.0f, 0.5f}) {
    const RenderSettings s = settings_at(light_scale);
    auto renderer = make_renderer(s, 160, 96);
    int frame = 0;
    const auto mean_of = [&](const scene::FrameSnapshot& snapshot) {
      renderer->render(at_time(snapshot, frame++), nullptr, s);
      return mean_luminance(renderer->read().denoised());
    };
    double dim = 0;
    for (int i = 0; i < 40; ++i) dim = mean_of(l.dim);
    const double bright = 10 * dim;
    const double shown[] = {mean_of(l.bright), mean_of(l.bright), mean_of(l.dim), mean_of(l.dim), mean_of(l.dim)};
    std::string text;
    for (const double x : shown) text += std::to_string(x / dim) + ' ';
    RecordProperty(light_scale == 1 ? "shown" : "shown_at_half", text);
    EXPECT_NEAR(shown[1] / bright, 1, 0.15) << text;
    EXPECT_NEAR(shown[3] / dim, 1, 0.15) << text;
    EXPECT_NEAR(shown[4] / dim, 1, 0.15) << text;
  }
}

// Of light whose samples scatter, none of it changing, next to no pixel loses its past.
TEST_F(LightChangeSequences, NoiseIsNoChange) {
  for (const float light_scale : {1.0f, 0.5f})
    for (const char* estimator : {"nee", "pt"}) {
      RenderSettings s = settings_at(light_scale);
      s.estimator = estimator;
      auto renderer = make_renderer(s, 151, 91);  // tiles and blocks at the edges are not whole
      const scene::FrameSnapshot box = scene::cornell_box();
      std::size_t lost = 0, all = 0;
      for (int frame = 0; frame < 48; ++frame) {
        renderer->render(at_time(box, frame), nullptr, s);
        if (frame < 40) continue;
        const std::vector<std::uint32_t> frames = history_lengths(*renderer);
        lost += static_cast<std::size_t>(
            std::count_if(frames.begin(), frames.end(), [](auto n) { return n > 0 && n < 24; }));
        all += frames.size();
      }
      const double share = static_cast<double>(lost) / static_cast<double>(all);
      RecordProperty(std::string(estimator) + (light_scale == 1 ? "" : "_at_half"), std::to_string(share));
      EXPECT_LT(share, 0.02) << estimator << ' ' << light_scale;
    }
}

// A first frame of many samples says nothing of how one sample scatters: what follows it is not held against that.
TEST_F(LightChangeSequences, AFirstFrameOfManySamplesIsNoMeasureOfNoise) {
  RenderSettings s = settings_at(1);
  s.estimator = "pt";
  s.first_spp = 16;
  s.jitter = 0;  // then a pixel of a still view loses its past by this test alone
  const scene::FrameSnapshot box = scene::cornell_box();
  std::size_t lost = 0, all = 0;
  for (s.seed = 0; s.seed < 4; ++s.seed) {
    auto renderer = make_renderer(s, 96, 80);
    for (int frame = 0; frame < 4; ++frame) {
      renderer->render(at_time(box, frame), nullptr, s);
      if (frame == 0) continue;
      const std::vector<std::uint32_t> frames = history_lengths(*renderer);
      lost +=
          static_cast<std::size_t>(std::count_if(frames.begin(), frames.end(), [](auto n) { return n > 0 && n < 16; }));
      all += frames.size();
    }
  }
  EXPECT_LT(static_cast<double>(lost), 0.02 * static_cast<double>(all));
}

}  // namespace
}  // namespace fb::render
