// Water (r_water 1) over many frames: what keeps the light that there is, and where waves throw it.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "render/renderer.h"
#include "render/test_device.h"
#include "render/test_image.h"
#include "render/test_water.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_of_water.h"
#include "shared/dielectric.h"

namespace fb::render {
namespace {

using WaterStatistics = WaterDeviceTest;

// A closed room of albedo a and emission e, half full of water that absorbs nothing, with waves: e (1 + a), above and
// below.
TEST_F(WaterStatistics, AFurnaceStaysAFurnace) {
  const float albedo = 0.5f;
  for (const TechniqueInfo& estimator : techniques()) {
    if (!estimator.unbiased()) continue;
    for (const float z : {-20.0f, 20.0f}) {
      scene::FrameSnapshot snapshot = scene::furnace(albedo, 1.0f);
      look(snapshot, {0, 0, z}, z, 100);
      add_water(snapshot, 0.0f, 140.0f, vec3(0.0f));
      RenderSettings s = water_settings(std::string(estimator.name), 1);
      s.spp = 16;
      s.water_waves = 1.5f;
      auto renderer = make_renderer(s, 48, 32);
      for (int frame = 0; frame < 4; ++frame) renderer->render(snapshot, nullptr, s);
      const ImageEstimate e = image_estimate(renderer->read().linear());
      EXPECT_NEAR(e.mean, 1.0 + albedo, 5 * e.error + 1e-3) << estimator.name << ' ' << z;
      EXPECT_EQ(renderer->read().counters().not_finite, 0u);
    }
  }
}

// White all around: what is reflected and what comes through are together all of it, at every angle and from both
// sides.
TEST_F(WaterStatistics, ReflectsWhatItDoesNotLetThrough) {
  for (const float z : {-50.0f, -1e-3f, 0.0f, 1e-3f, 50.0f})
    for (const float waves : {0.0f, 2.0f}) {
      scene::FrameSnapshot snapshot;
      snapshot.assets = std::make_shared<scene::Assets>();
      snapshot.sky.mode = scene::SkyMode::kConstant;
      snapshot.sky.color = vec3(1, 2, 3);
      snapshot.sky.beyond_everything = true;
      look(snapshot, {3, 5, z}, z > 0 ? 20.0f : -20.0f, 120);
      add_water(snapshot, 0.0f, 5000.0f, vec3(0.0f));
      RenderSettings s = water_settings("pt", 1);
      s.water_waves = waves;
      auto renderer = make_renderer(s, 48, 48);
      renderer->render(snapshot, nullptr, s);
      for (const vec4& p : renderer->read().linear())
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(p[c], static_cast<float>(c + 1), 1e-4f) << z << ' ' << waves;
    }
}

// One sine wave focuses the sun: the floor is brightest under its crests, and darkest between them (geometric optics;
// the irradiance under a crest at depth d over that without waves is 1 / |1 - d (1 - 1 / n) a k^2|, under a trough 1 /
// (1 + ...)).
TEST_F(WaterStatistics, CausticsLieUnderTheCrests) {
  scene::FrameSnapshot snapshot = scene::ripple({3.0f, false, false});
  snapshot.sky.color = vec3(0.0f);
  look(snapshot, {0, 0, 115}, 89.9f, 90);
  RenderSettings s = water_settings("pt", 1);
  s.spp = 64;
  s.accumulate = 1;
  auto renderer = make_renderer(s, 64, 64);
  for (int frame = 0; frame < 32; ++frame) renderer->render(snapshot, nullptr, s);
  const auto texels = renderer->read().gbuffer();
  const auto image = renderer->read().linear();
  double crest = 0, trough = 0;
  int crests = 0, troughs = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (texels[i].position_t.z > 1.0f) continue;
    const float x = texels[i].position_t.x,
                off = std::fabs(x - scene::kRippleLength * std::round(x / scene::kRippleLength));
    if (off < 3.0f) crest += image[i].y, ++crests;
    if (off > 0.5f * scene::kRippleLength - 8.0f) trough += image[i].y, ++troughs;
  }
  ASSERT_GT(crests, 50);
  ASSERT_GT(troughs, 50);
  const double between = trough / troughs;
  EXPECT_GT(crest / crests, 3.0 * between);
  // Under a trough: albedo / pi times the sun's irradiance, what is let through, absorption, and the spread; all of it
  // over the index squared, since radiance in water is basic radiance.
  const float k = 2 * kPi / scene::kRippleLength, d = scene::kRippleDepth - scene::kRippleHeight;
  const float spread = 1.0f + d * (1.0f - 1.0f / kIndex) * scene::kRippleHeight * k * k;
  const float through = 1.0f - shared::dielectric_reflectance(1.0f, kIndex);
  const double expected = 0.62 / kPi * 8.0 * through * std::exp(-0.0015f * d) / (spread * kIndex * kIndex);
  EXPECT_NEAR(between / expected, std::exp(-0.0015f * 115), 0.1);  // some 1500 of the trough's paths find the sun
}

TEST_F(WaterStatistics, NothingIsLostInTheSurface) {
  for (const char* estimator : {"pt", "nee", "mcpg", "mcpg_nee"})
    for (const float z : {-1e-4f, 0.0f, 1e-4f}) {
      scene::FrameSnapshot snapshot = scene::one_light(20.0f, 10.0f, 0.5f);  // the light is half in water
      look(snapshot, {-60, 0, z}, 0, 100);
      add_water(snapshot, 0.0f, 140.0f, vec3(1e-3f, 0.0f, 10.0f));
      RenderSettings s = water_settings(estimator, 3);
      s.spp = 4;
      s.water_waves = 8;
      auto renderer = make_renderer(s, 48, 48);
      for (int frame = 0; frame < 4; ++frame) renderer->render(snapshot, nullptr, s);
      EXPECT_EQ(renderer->read().counters().not_finite, 0u) << estimator << ' ' << z;
      EXPECT_EQ(renderer->read().counters().states_not_finite, 0u) << estimator << ' ' << z;
    }
}

}  // namespace
}  // namespace fb::render
