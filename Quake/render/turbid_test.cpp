// Liquids that scatter light, against fog, whose integrals fog_statistics_test.cpp has, and against a closed form of
// their own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "render/test_denoiser.h"
#include "render/test_device.h"
#include "render/test_image.h"
#include "render/test_water.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_of_fog.h"
#include "scene/in_code/scenes_of_water.h"
#include "shared/dielectric.h"
#include "shared/test_quadrature.h"

namespace fb::render {
namespace {

class TurbidSequences : public WaterDeviceTest {
 protected:
  static RenderSettings turbid_settings(const std::string& estimator, int spp) {
    RenderSettings s = water_settings(estimator, 1);
    s.spp = spp;
    return s;
  }
  // Level water.
  static RenderSettings denoised_settings(const std::string& estimator) {
    RenderSettings s = denoising();
    s.estimator = estimator;
    s.water = 1;
    s.water_waves = 0;
    s.jitter = 0;
    return s;
  }
};

ImageEstimate mean_of(Renderer& renderer, const scene::FrameSnapshot& snapshot, const RenderSettings& s, int frames) {
  double sum = 0, variance = 0;
  for (int i = 0; i < frames; ++i) {
    scene::FrameSnapshot now = snapshot;
    now.frame = static_cast<std::uint64_t>(i);
    renderer.render(now, nullptr, s);
    const ImageEstimate e = image_estimate(renderer.read().linear());
    sum += e.mean / frames;
    variance += e.error * e.error / (frames * frames);
  }
  return {sum, std::sqrt(variance)};
}

// Where the liquid has no end in sight it is fog.
TEST_F(TurbidSequences, AroundALampItIsAsFog) {
  const float extinction = 0.01f, share = 0.6f;
  const float g = 0.7f;
  scene::FrameSnapshot fog = scene::slab(extinction, g);
  fog.camera.angles = {0, -8, 0};
  fog.camera.fov_x = 24;
  fog.prev_camera = fog.camera;
  fog.medium.albedo = vec3(share);
  scene::FrameSnapshot liquid = fog;
  liquid.medium = {};
  add_water(liquid, 20000.0f, 1.0f, vec3((1 - share) * extinction), share * extinction);
  RenderSettings s = turbid_settings("nee", 256);
  s.accumulate = 0;
  s.water_g = g;
  auto renderer = make_renderer(s, 16, 8);
  const ImageEstimate expected = mean_of(*renderer, fog, s, 8);
  for (const char* estimator : {"pt", "nee", "mcpg", "mcpg_nee"}) {
    s.estimator = estimator;
    s.spp = std::string(estimator) == "pt" ? 1024 : 256;
    const ImageEstimate e = mean_of(*renderer, liquid, s, 8);
    EXPECT_NEAR(e.mean, expected.mean, 4.5 * std::hypot(e.error, expected.error)) << estimator;
    EXPECT_LT(e.error, 0.04 * expected.mean) << estimator << ": the test can see little";
    EXPECT_EQ(renderer->read().counters().not_finite, 0u);
  }
}

// A level liquid over black ground, an even sky of radiance 1, seen from straight above: light enters within Snell's
// cone, is scattered once, evenly, and leaves. At a depth z, of basic radiance, J(z) = 1/2 integral over the cone's
// cosines of (1 - R) exp(-sigma z / cosine), and the camera has R0 + (1 - R0) integral of scattering exp(-sigma z)
// J(z).
double seen_from_above(double sigma, double scattering, double depth) {
  const auto integral = [](double low, double high, int panels, const auto& f) {
    return static_cast<double>(shared::integrate(
        [&](long double x) { return static_cast<long double>(f(static_cast<double>(x))); }, low, high, panels));
  };
  const double least = std::sqrt(1.0 - 1.0 / (static_cast<double>(kIndex) * static_cast<double>(kIndex)));
  // With cosine = least + u^2 the square root that Fresnel's equations begin with is smooth.
  const auto arrives = [&](double z) {
    return 0.5 * integral(0, std::sqrt(1 - least), 24, [&](double u) {
             const double cosine = least + u * u;
             const double r =
                 static_cast<double>(shared::dielectric_reflectance(static_cast<float>(cosine), 1.0f / kIndex));
             return 2 * u * (1 - r) * std::exp(-sigma * z / cosine);
           });
  };
  const double r0 = static_cast<double>(shared::dielectric_reflectance(1.0f, kIndex));
  return r0 +
         (1 - r0) * integral(0, depth, 24, [&](double z) { return scattering * std::exp(-sigma * z) * arrives(z); });
}

TEST_F(TurbidSequences, FromAboveItHasTheIntegralOverSnellsCone) {
  const float depth = 120.0f, scattering = 0.006f;
  const vec3 absorption(0.004f, 0.0f, 0.03f);
  scene::FrameSnapshot snapshot;
  auto assets = std::make_shared<scene::Assets>();
  scene::Material ground;
  ground.base_color = vec3(0.0f);
  ground.emission_kind = scene::EmissionKind::kNone;
  assets->materials.push_back(ground);
  scene::Mesh floor;
  scene::add_quad(floor, {-9000, -9000, -depth}, {18000, 0, 0}, {0, 18000, 0}, 0);
  scene::finish_mesh(floor);
  assets->meshes.push_back(floor);
  snapshot.assets = assets;
  snapshot.instances.emplace_back();
  snapshot.sky.mode = scene::SkyMode::kConstant;
  snapshot.sky.color = vec3(1.0f);
  snapshot.sky.beyond_everything = true;
  look(snapshot, {0, 0, 60}, 89.9f, 2);
  add_water(snapshot, 0.0f, 8000.0f, absorption, scattering);
  for (const char* estimator : {"pt", "nee", "mcpg", "mcpg_nee"}) {
    RenderSettings s = turbid_settings(estimator, 64);
    s.water_waves = 0;
    s.water_g = 0;
    s.accumulate = 0;
    auto renderer = make_renderer(s, 32, 32);
    double sums[3] = {}, squares[3] = {};
    constexpr int kFrames = 16;
    for (int i = 0; i < kFrames; ++i) {
      snapshot.frame = static_cast<std::uint64_t>(i);
      renderer->render(snapshot, nullptr, s);
      for (int c = 0; c < 3; ++c) {
        double mean = 0;
        for (const vec4& p : renderer->read().linear()) mean += static_cast<double>(p[c]) / (32 * 32);
        sums[c] += mean / kFrames;
        squares[c] += mean * mean / kFrames;
      }
    }
    for (int c = 0; c < 3; ++c) {
      const double expected = seen_from_above(static_cast<double>(absorption[c] + scattering), scattering, depth);
      const double error = std::sqrt(std::max(squares[c] - sums[c] * sums[c], 0.0) / (kFrames - 1));
      EXPECT_NEAR(sums[c], expected, 4.5 * error + 2e-4) << estimator << ' ' << c;
      EXPECT_LT(error, 2e-3) << estimator << ": the test can see little";
    }
  }
}

// Each path of a pixel that has fog and a liquid begins in one of them: together they bring what each brings alone.
TEST_F(TurbidSequences, FogAndALiquidAddUp) {
  scene::FrameSnapshot pool = scene::ripple({40.0f, true, true, 0.006f});
  pool.medium = {0.003f, vec3(0.8f), 0.4f, 0.0f, 1.0f};
  RenderSettings s = turbid_settings("nee", 32);
  s.accumulate = 0;
  auto renderer = make_renderer(s, 32, 24);
  double means[2][2], variance = 0;  // does fog scatter, does the liquid
  for (const int fog : {0, 1})
    for (const int liquid : {0, 1}) {
      pool.medium.albedo = vec3(fog != 0 ? 0.8f : 0.0f);
      s.water_scatter = static_cast<float>(liquid);
      constexpr int kFrames = 24;
      double sum = 0, squares = 0;
      for (int i = 0; i < kFrames; ++i) {
        pool.frame = static_cast<std::uint64_t>(i);
        renderer->render(pool, nullptr, s);
        const double mean = mean_luminance(renderer->read().linear());
        sum += mean / kFrames;
        squares += mean * mean / kFrames;
      }
      means[fog][liquid] = sum;
      variance += std::max(squares - sum * sum, 0.0) / (kFrames - 1);
    }
  const double of_fog = means[1][0] - means[0][0], of_liquid = means[0][1] - means[0][0], error = std::sqrt(variance);
  EXPECT_NEAR(means[1][1] - means[0][0], of_fog + of_liquid, 5 * error);
  EXPECT_LT(5 * error, 0.5 * std::min(of_fog, of_liquid)) << "the test can see little";
  fmt::print("fog {:.5f}, liquid {:.5f}, both {:.5f} +- {:.5f}\n", of_fog, of_liquid, means[1][1] - means[0][0], error);
}

// A clear liquid that loses as much light is drawn instead, by the same shaders as ever.
TEST_F(TurbidSequences, WithoutScatteringItIsAClearLiquid) {
  const auto hash = [&](const vec3& absorption, float scattering, float factor) {
    scene::FrameSnapshot snapshot = scene::one_light(20.0f, 10.0f, 0.5f);
    look(snapshot, {-60, 0, 30}, 20, 90);
    add_water(snapshot, 0.0f, 140.0f, absorption, scattering);
    RenderSettings s = turbid_settings("nee", 4);
    s.water_scatter = factor;
    auto renderer = make_renderer(s, 48, 48);
    renderer->render(snapshot, nullptr, s);
    return image_hash(*renderer);
  };
  const vec3 half(0.25f, 0.5f, 0.125f);  // sums are exact
  EXPECT_EQ(hash(half, 0.25f, 0.0f), hash(half + vec3(0.25f), 0.0f, 1.0f));
  EXPECT_NE(hash(half, 0.25f, 1.0f), hash(half + vec3(0.25f), 0.0f, 1.0f));
}

TEST_F(TurbidSequences, NothingIsLostAtTheEndsOfTheRanges) {
  for (const char* estimator : {"nee", "mcpg_nee"})  // they have the steps of the others
    for (const float scattering : {1e-9f, 1e-2f, 10.0f})
      for (const float z : {-1e-4f, 60.0f}) {
        scene::FrameSnapshot snapshot = scene::one_light(20.0f, 10.0f, 0.5f);  // the light is half in water
        snapshot.medium = {0.002f, vec3(0.5f), 0.5f, 0.0f, 1.0f};
        look(snapshot, {-60, 0, z}, 10, 100);
        add_water(snapshot, 0.0f, 140.0f, vec3(0.0f, 1e-3f, 10.0f), scattering);
        RenderSettings s = turbid_settings(estimator, 2);
        s.medium_bounces = 2;
        s.water_waves = 8;
        s.water_g = 0.999f;
        auto renderer = make_renderer(s, 32, 32);
        for (int frame = 0; frame < 3; ++frame) renderer->render(snapshot, nullptr, s);
        EXPECT_EQ(renderer->read().counters().not_finite, 0u) << estimator << ' ' << scattering << ' ' << z;
        EXPECT_EQ(renderer->read().counters().states_not_finite, 0u) << estimator << ' ' << scattering << ' ' << z;
        for (const vec4& p : renderer->read().linear())
          ASSERT_TRUE(p.x >= 0.0f && std::isfinite(p.x + p.y + p.z)) << estimator << ' ' << scattering << ' ' << z;
      }
}

// A pool beside its dry rim: what scatters in the water stays in it. The same samples, denoised and not.
TEST_F(TurbidSequences, DenoisedItKeepsItsEnergy) {
  for (const bool above : {true, false}) {
    const scene::FrameSnapshot pool = scene::ripple({40.0f, true, above, 0.006f});
    RenderSettings s = denoised_settings("mcpg_nee");
    s.fog_scale = 1;
    auto renderer = make_renderer(s, 48, 32);
    double denoised = 0, raw = 0;
    for (int frame = 0; frame < 48; ++frame) {
      renderer->render(at_time(pool, frame), nullptr, s);
      if (frame < 16) continue;
      denoised += mean_luminance(renderer->read().denoised());
      raw += mean_luminance(renderer->read().linear());
      EXPECT_EQ(renderer->read().counters().not_finite + renderer->read().counters().history_not_finite, 0u);
    }
    EXPECT_NEAR(denoised / raw, 1.0, 0.03) << above;
    fmt::print("{}: denoised over raw {:.4f}\n", above ? "above" : "under water", denoised / raw);
  }
}

// A block of pixels that lies across the rim of a pool is asked at dry pixels, too: there nothing scatters, which says
// nothing of the light in the water.
TEST_F(TurbidSequences, DenoisedItIsNoDarkerAtAPoolsRim) {
  scene::FrameSnapshot pool = scene::furnace(0.0f, 1.0f);
  look(pool, {0, 0, 60}, 90, 60);
  add_water(pool, 0.0f, 20.0f, vec3(0.0f), 0.02f);
  RenderSettings s = denoised_settings("pt");
  s.light_scale = 0.5f;
  s.fog_scale = 0.5f;
  RenderSettings every = s;  // pixel's own samples, and many
  every.light_scale = every.fog_scale = 1;
  every.spp = 64;
  every.accumulate = 0;
  const auto mean_of_frames = [&](const RenderSettings& settings, int from, int to, bool denoised) {
    auto renderer = make_renderer(settings, 48, 48);
    std::vector<double> mean(48 * 48);
    for (int frame = 0; frame < to; ++frame) {
      renderer->render(at_time(pool, frame), nullptr, settings);
      if (frame < from) continue;
      const auto picture = denoised ? renderer->read().denoised() : renderer->read().linear();
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += static_cast<double>(picture[i].x) / (to - from);
    }
    return mean;
  };
  const std::vector<double> shown = mean_of_frames(s, 64, 96, true), truth = mean_of_frames(every, 0, 16, false);
  auto renderer = make_renderer(every, 48, 48);
  renderer->render(at_time(pool, 0), nullptr, every);
  const auto gbuffer = renderer->read().gbuffer();
  const auto wet = [&](std::size_t i) { return (gbuffer[i].material_metalness & shared::kTexelLiquid) != 0; };
  double rim = 0, rim_truth = 0;
  int pixels = 0;
  for (std::size_t y = 1; y < 47; ++y)
    for (std::size_t x = 1; x < 47; ++x) {
      const std::size_t i = y * 48 + x;
      if (!wet(i) || (wet(i - 1) && wet(i + 1) && wet(i - 48) && wet(i + 48))) continue;
      rim += shown[i];
      rim_truth += truth[i];
      ++pixels;
    }
  fmt::print("{} pixels at the rim: {:.4f} for {:.4f}\n", pixels, rim / pixels, rim_truth / pixels);
  ASSERT_GT(pixels, 40);
  EXPECT_NEAR(rim / rim_truth, 1.0, 0.02);
}

}  // namespace
}  // namespace fb::render
