// Fog in the denoised picture: its energy, its error, what a still view converges to, fog that comes and goes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "render/test_denoiser.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_of_fog.h"

namespace fb::render {
namespace {

using FogDenoiserTest = DeviceTest;

// The same assets always.
const scene::FrameSnapshot& clear_box() {
  static const scene::FrameSnapshot snapshot = scene::cornell_box();
  return snapshot;
}
scene::FrameSnapshot foggy_box() {
  scene::FrameSnapshot snapshot = clear_box();
  snapshot.medium = {1.0f / 900, vec3(0.9f, 0.8f, 0.7f), 0.3f, 0.0f, 1.0f};
  return snapshot;
}

RenderSettings denoising_fog(float light_scale, float fog_scale) {
  RenderSettings s = denoising();
  s.estimator = "nee";
  s.jitter = 0;
  s.light_scale = light_scale;
  s.fog_scale = fog_scale;
  return s;
}

using Maker = std::function<std::unique_ptr<Renderer>(const RenderSettings&)>;
std::vector<vec4> foggy_reference(const Maker& make) {
  RenderSettings s;
  s.intersector = Intersector::kBvh;
  s.estimator = "nee";
  s.spp = 64;
  s.jitter = 0;
  s.seed = 99;
  auto renderer = make(s);
  for (int i = 0; i < 16; ++i) renderer->render(foggy_box(), nullptr, s);
  return renderer->read().linear();
}

TEST_F(FogDenoiserTest, DenoisedItKeepsItsEnergyAndLosesItsNoise) {
  const uvec2 size(96, 96);
  const std::vector<vec4> reference =
      foggy_reference([&](const RenderSettings& r) { return make_renderer(r, size.x, size.y); });
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

TEST_F(FogDenoiserTest, AStillViewConvergesToTheRawMean) {
  RenderSettings s = denoising_fog(0.5f, 0.5f);
  s.accumulate = 1;
  s.svgf_mean_frames = 4;
  auto renderer = make_renderer(s, 48, 48);
  for (int frame = 0; frame < 640; ++frame) renderer->render(foggy_box(), nullptr, s);
  // A pixel has a sixteenth of the frames.
  const auto raw = renderer->read().linear(), denoised = renderer->read().denoised();
  for (std::size_t i = 0; i < raw.size(); ++i) EXPECT_NEAR(denoised[i].y, raw[i].y, 0.05f * (raw[i].y + 0.2f)) << i;
}

// Shafts of light of which a first frame's samples meet a few: each block that met one is spread over its surroundings,
// and is not shown as a dot.
TEST_F(FogDenoiserTest, AFirstFrameShowsNoDots) {
  const RenderSettings s = denoising_fog(0.5f, 0.5f);
  double dots = 0;
  constexpr int kSeeds = 8;
  for (int seed = 0; seed < kSeeds; ++seed) {
    RenderSettings seeded = s;
    seeded.seed = static_cast<std::uint32_t>(seed);
    seeded.estimator = "pt";
    seeded.first_spp = 4;
    auto renderer = make_renderer(seeded, 96, 96);
    renderer->render(scene::window(), nullptr, seeded);
    const std::vector<vec4> picture = renderer->read().denoised();
    // Brighter by far than all that is a little way off, in each direction.
    constexpr int kSide = 96, kOff = 10;
    for (int y = kOff; y < kSide - kOff; ++y) {
      for (int x = kOff; x < kSide - kOff; ++x) {
        const auto at = [&](int dx, int dy) { return picture[static_cast<std::size_t>((y + dy) * kSide + x + dx)].y; };
        const float about = std::max({at(kOff, 0), at(-kOff, 0), at(0, kOff), at(0, -kOff)});
        dots += at(0, 0) > 3 * about ? 1.0 / kSeeds : 0.0;
      }
    }
  }
  EXPECT_LT(dots, 55);  // 35; 80 where the frame's few samples were taken to tell their deviation
}

TEST_F(FogDenoiserTest, ComesAndGoes) {
  const RenderSettings s = denoising_fog(0.5f, 0.5f);
  auto renderer = make_renderer(s, 48, 48);
  auto clear_renderer = make_renderer(s, 48, 48);
  const auto clear = [](int frame) { return at_time(clear_box(), frame); };
  for (int frame = 0; frame < 40; ++frame) {
    renderer->render(frame >= 3 && frame < 8 ? at_time(foggy_box(), frame) : clear(frame), nullptr, s);
    clear_renderer->render(clear(frame), nullptr, s);
  }
  EXPECT_NEAR(mean_luminance(renderer->read().denoised()) / mean_luminance(clear_renderer->read().denoised()), 1.0,
              0.05);
  EXPECT_EQ(renderer->read().counters().history_not_finite, 0u);
}

}  // namespace
}  // namespace fb::render
