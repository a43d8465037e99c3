// Water (r_water 1) over many samples: what keeps the light that there is, suns that shadow rays find through it and in
// it, and where waves throw light.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "render/techniques/test_techniques.h"
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
  for (const std::string& estimator : one_of_each_family(Whose::kUnbiased)) {
    for (const float z : {-20.0f, 20.0f}) {
      scene::FrameSnapshot snapshot = scene::furnace(albedo, 1.0f);
      look(snapshot, {0, 0, z}, z, 100);
      add_water(snapshot, 0.0f, 140.0f, vec3(0.0f));
      RenderSettings s = water_settings(estimator, 1);
      s.spp = 16;
      s.water_waves = 1.5f;
      auto renderer = make_renderer(s, 48, 32);
      for (int frame = 0; frame < 4; ++frame) renderer->render(snapshot, nullptr, s);
      const ImageEstimate e = image_estimate(renderer->read().linear());
      EXPECT_NEAR(e.mean, 1.0 + albedo, 5 * e.error + 1e-3) << estimator << ' ' << z;
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

// A floor under still and moving water, lit by a sun alone: shadow rays find it through the surface, with what
// Fresnel's and Snell's laws leave of it. Of a sun that brings E to a surface across its rays the floor reflects, as
// basic radiance, albedo / pi (1 - R) exp(-sigma depth / cosine beyond) E cosine / n^2.
TEST_F(WaterStatistics, ShadowRaysFindTheSunThroughTheSurface) {
  const float depth = 80.0f, albedo = 0.5f, radius = 0.01f;
  const vec3 absorption(0.01f, 0.002f, 0.0f);
  for (const char* estimator : {"nee", "mcpg_nee"})
    for (const float waves : {0.0f, 0.6f})
      for (const bool above : {false, true}) {
        scene::Material ground;
        ground.base_color = vec3(albedo);
        scene::FrameSnapshot snapshot = one_quad(ground, {-2000, -2000, -depth}, {4000, 0, 0}, {0, 4000, 0});
        look(snapshot, {0, 0, above ? 100.0f : -10.0f}, 89.0f, 50);
        add_water(snapshot, 0.0f, 2000.0f, absorption);
        const float elevation = 0.9f, cosine = std::sin(elevation);
        snapshot.sky.mode = scene::SkyMode::kConstant;
        snapshot.sky.color = vec3(0.0f);
        snapshot.sky.beyond_everything = true;
        snapshot.sky.suns = {{vec3(std::cos(elevation), 0, cosine), vec3(1000.0f), radius * 180 / kPi}};
        RenderSettings s = water_settings(estimator, 1);
        s.spp = 64;
        s.water_waves = waves;
        s.water_scatter = 0;
        auto renderer = make_renderer(s, 32, 24);
        for (int i = 0; i < 8; ++i) renderer->render(snapshot, nullptr, s);
        const std::vector<vec4> image = renderer->read().linear(), variance = renderer->read().variance_of_mean();
        const float beyond = shared::dielectric_cosine_beyond(cosine, kIndex);
        const float let_in = 1.0f - shared::dielectric_reflectance(cosine, kIndex);
        double mean = 0, error = 0, expected = 0;
        const auto n = static_cast<double>(image.size());
        for (std::size_t i = 0; i < image.size(); ++i) {
          mean += static_cast<double>(image[i].y) / n;
          error += static_cast<double>(variance[i].y) / (n * n);
          const float column = static_cast<float>(i % 32), row = static_cast<float>(i / 32);
          const float half = std::tan(radians(25.0f)), x = ((column + 0.5f) / 16.0f - 1.0f) * half;
          const float y = ((row + 0.5f) / 16.0f - 0.75f) * half, from = std::sqrt(1.0f / (1.0f + x * x + y * y));
          const float inner = above ? shared::dielectric_cosine_beyond(from, kIndex) : from;
          const float seen = above ? 1.0f - shared::dielectric_reflectance(from, kIndex) : 1.0f;
          const float way = (above ? depth : depth - 10.0f) / inner + depth / beyond;
          expected += static_cast<double>(albedo * 1000.0f * let_in / kPi * cosine / (kIndex * kIndex) * seen *
                                          std::exp(-absorption.y * way)) /
                      n;
        }
        // Waves move the light about: what falls on the whole picture is that of level water but for a few percent.
        const double slack = waves > 0 ? 0.05 : 2e-3;
        EXPECT_NEAR(mean, expected, 4.5 * std::sqrt(error) + slack * expected)
            << estimator << ' ' << waves << ' ' << above;
        EXPECT_LT(std::sqrt(error), 0.01 * expected) << estimator << ' ' << waves << ' ' << above;
        EXPECT_EQ(renderer->read().counters().not_finite, 0u);
      }
}

// A slab that hangs over water, from below: the sun that the water mirrors onto it, by shadow rays. It reflects albedo
// / pi R E cosine.
TEST_F(WaterStatistics, ShadowRaysFindTheSunThatWaterMirrors) {
  const float albedo = 0.5f, elevation = 0.5f, cosine = std::sin(elevation);
  for (const char* estimator : {"nee", "mcpg_nee"})
    for (const float waves : {0.0f, 0.6f}) {
      scene::Material stone;
      stone.base_color = vec3(albedo);
      scene::FrameSnapshot snapshot = one_quad(stone, {-40, -40, 100}, {0, 80, 0}, {80, 0, 0});
      look(snapshot, {0, 0, 50}, -89.0f, 40);
      add_water(snapshot, 0.0f, 2000.0f, vec3(0.0f));
      snapshot.sky.mode = scene::SkyMode::kConstant;
      snapshot.sky.color = vec3(0.0f);
      snapshot.sky.beyond_everything = true;
      snapshot.sky.suns = {{vec3(std::cos(elevation), 0, cosine), vec3(1000.0f), 0.5f}};
      RenderSettings s = water_settings(estimator, 1);
      s.spp = 64;
      s.water_waves = waves;
      auto renderer = make_renderer(s, 32, 24);
      for (int i = 0; i < 16; ++i) renderer->render(snapshot, nullptr, s);
      const ImageEstimate e = image_estimate(renderer->read().linear());
      const double expected =
          static_cast<double>(albedo / kPi * 1000.0f * cosine * shared::dielectric_reflectance(cosine, kIndex));
      EXPECT_NEAR(e.mean, expected, 5 * e.error + (waves > 0 ? 0.1 : 2e-3) * expected) << estimator << ' ' << waves;
      // Taken from the scatter over the picture, so that the pattern which waves throw is in it.
      EXPECT_LT(e.error, 0.04 * expected) << estimator << ' ' << waves << ": the test can see little";
      EXPECT_EQ(renderer->read().counters().not_finite, 0u);
    }
}

// A lamp under the surface, over dark ground: shadow rays and chance lose as much on the way, also where other paths of
// the same moment go on to the surface and back.
TEST_F(WaterStatistics, EveryPieceAbsorbsOnce) {
  scene::FrameSnapshot snapshot = scene::one_light(24.0f, 10.0f, 0.5f);
  look(snapshot, {-60, 0, 50}, 89, 60);
  add_water(snapshot, 60.0f, 140.0f, vec3(0.005f, 0.01f, 0.002f));
  vec3 means[2];
  double errors[2];
  for (const int looks : {0, 1}) {
    RenderSettings s = water_settings(looks == 1 ? "nee" : "pt", 1);
    s.spp = looks == 1 ? 64 : 256;
    auto renderer = make_renderer(s, 32, 24);
    const int frames = 16;
    for (int i = 0; i < frames; ++i) renderer->render(snapshot, nullptr, s);
    const std::vector<vec4> image = renderer->read().linear(), variance = renderer->read().variance_of_mean();
    double sum = 0, n = static_cast<double>(image.size());
    means[looks] = vec3(0.0f);
    for (std::size_t i = 0; i < image.size(); ++i) {
      means[looks] += vec3(image[i]) / static_cast<float>(n);
      sum += static_cast<double>(variance[i].y);
    }
    errors[looks] = std::sqrt(sum) / n;
  }
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(means[0][c] / means[1][c], 1.0f, 5 * std::hypot(errors[0], errors[1]) / static_cast<double>(means[1].y))
        << c;
  EXPECT_LT(errors[0], 0.01 * static_cast<double>(means[1].y)) << "the test can see little";
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
