// What stands between radiance and the screen: automatic exposure, local exposure, bloom. On pictures whose answer is
// known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "render/renderer.h"
#include "render/test_device.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

constexpr std::uint32_t kLensWidth = 96, kLensHeight = 54;
constexpr float kGrey = 0.18f;

RenderSettings lens_settings(float local, float bloom) {
  RenderSettings s;
  s.auto_exposure = s.tone_map = s.fxaa = s.accumulate = 0;
  s.bounces = 0;  // a furnace of nothing but its emission
  s.local_exposure = local;
  s.bloom = bloom;
  return s;
}

double linear_of(std::uint32_t byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
// Green, from 0 to 1.
std::vector<double> shown(const Renderer& renderer) {
  std::vector<double> values;
  for (const std::uint32_t pixel : renderer.read().output()) values.push_back(linear_of(pixel >> 8u & 255u));
  return values;
}
double sum_of(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

class LensTest : public DeviceTest {
 protected:
  // Shows an even picture of this radiance.
  std::vector<double> even(float radiance, const RenderSettings& settings) {
    auto renderer = make_renderer(settings, kLensWidth, kLensHeight);
    renderer->render(scene::furnace(0.5f, radiance), nullptr, settings);
    renderer->render(scene::furnace(0.5f, radiance), nullptr, settings);  // what the first left behind is gone
    return shown(*renderer);
  }
};

TEST_F(LensTest, AnEvenPictureStaysEvenAndComesNearerToGrey) {
  // Pixels differ by the dither alone, a step of 8 bits.
  const auto expect_even = [](const std::vector<double>& values, double expected) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    EXPECT_LT(*high, *low * 1.12) << expected;
    EXPECT_NEAR(sum_of(values) / static_cast<double>(values.size()), expected, 0.02 * expected);
  };
  for (const float radiance : {0.02f, 0.18f, 0.7f}) {
    expect_even(even(radiance, lens_settings(0, 0.3f)), radiance);
    const double above = std::log2(radiance / kGrey), taken = 0.5 * (above > 0 ? above : 0.5 * above);
    expect_even(even(radiance, lens_settings(0.5f, 0)), radiance * std::exp2(-taken));
  }
}

// A lamp in a black room: what leaves its pixels is found about them.
TEST_F(LensTest, BloomSpreadsLightAndKeepsItsSum) {
  const scene::FrameSnapshot lamp = scene::one_light(8, 1, 0.5f);
  RenderSettings settings = lens_settings(0, 0);
  settings.exposure = 0.9f;
  auto renderer = make_renderer(settings, kLensWidth, kLensHeight);
  renderer->render(lamp, nullptr, settings);
  const auto sharp = shown(*renderer);
  settings.bloom = 0.5f;
  renderer->render(lamp, nullptr, settings);
  const auto spread = shown(*renderer);
  ASSERT_GT(sum_of(sharp), 1.0);
  EXPECT_NEAR(sum_of(spread), sum_of(sharp), 0.05 * sum_of(sharp));
  const auto lit = [](const std::vector<double>& values) {
    return std::count_if(values.begin(), values.end(), [](double value) { return value > 0.01; });
  };
  EXPECT_GT(lit(spread), lit(sharp));
  EXPECT_LT(*std::max_element(spread.begin(), spread.end()), *std::max_element(sharp.begin(), sharp.end()));
}

TEST_F(LensTest, OutsideOfTheGameBothAreOff) {
  const RenderSettings untouched, game = as_in_game(untouched, false);
  EXPECT_GT(game.local_exposure, 0);
  EXPECT_GT(game.bloom, 0);
  EXPECT_EQ(game.denoise, 1);
  EXPECT_EQ(game.water, 1);
  EXPECT_EQ(as_in_game(untouched, true).water, 0);
  RenderSettings chosen;
  chosen.denoise = 0;
  chosen.local_exposure = chosen.bloom = 0;
  chosen.water = chosen.water_warp = 0;
  EXPECT_EQ(as_in_game(chosen, false), chosen);
  EXPECT_EQ(even(0.3f, lens_settings(-1, -1)), even(0.3f, lens_settings(0, 0)));
}

// The light grows by a factor from one frame to the next, a tenth of a second later.
TEST_F(LensTest, ExposureRestsWhileThePictureIsNotFarFromIt) {
  RenderSettings settings = lens_settings(0, 0);
  settings.auto_exposure = 1;
  settings.exposure_rest = 0.5f;
  const auto change = [&](float factor, bool cut) {
    auto renderer = make_renderer(settings, kLensWidth, kLensHeight);
    double stops = 0;
    for (int i = 0; i < 40; ++i) {
      scene::FrameSnapshot frame = scene::furnace(0.5f, i == 0 ? 0.2f : 0.2f * factor);
      frame.frame = static_cast<std::uint64_t>(i);
      frame.time = 0.1 * i;
      frame.cut = i == 0 || (cut && i == 1);
      renderer->render(frame, nullptr, settings);
      const double now = std::log2(renderer->read().exposure());
      if (i == 0) stops = now;
      if (i == 39) stops = now - stops;
    }
    return stops;
  };
  const double bin = 0.1875, kept = 0.85;  // of the histogram; of a dark room's darkness 0.15 stays
  EXPECT_EQ(change(1.2f, false), 0.0);
  EXPECT_NEAR(change(4, false), -(2 * kept - 0.5), 0.05 + bin);
  EXPECT_NEAR(change(4, true), -2 * kept, 0.05 + bin);
  EXPECT_NEAR(change(0.25f, false), 2 * kept - 0.5, 0.05 + bin);
}

}  // namespace
}  // namespace fb::render
