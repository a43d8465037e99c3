// Water (r_water 1): interfaces that reflect, refract and absorb, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "render/picture/frame_constants.h"
#include "render/renderer.h"
#include "render/test_device.h"
#include "render/test_image.h"
#include "render/test_water.h"
#include "scene/in_code/scenes_in_code.h"
#include "shared/dielectric.h"

namespace fb::render {
namespace {

using WaterTest = WaterDeviceTest;

scene::FrameSnapshot one_quad(const scene::Material& material, const vec3& corner, const vec3& u, const vec3& v) {
  scene::FrameSnapshot snapshot;
  auto assets = std::make_shared<scene::Assets>();
  assets->materials.push_back(material);
  scene::Mesh quad;
  scene::add_quad(quad, corner, u, v, 0);
  scene::finish_mesh(quad);
  assets->meshes.push_back(quad);
  snapshot.assets = assets;
  snapshot.instances.emplace_back();
  return snapshot;
}

// A floor that glows under a depth of water: where each ray meets it by Snell's law, and what of its light arrives.
TEST_F(WaterTest, BendsAndAbsorbsAsTheFormulasSay) {
  const float height = 40.0f, depth = 80.0f;
  const vec3 absorption(0.01f, 0.002f, 0.0f);
  scene::Material ground;
  ground.emission = vec3(1.0f);
  ground.emission_kind = scene::EmissionKind::kConstant;
  scene::FrameSnapshot snapshot = one_quad(ground, {-2000, -2000, -depth}, {4000, 0, 0}, {0, 4000, 0});
  look(snapshot, {0, 0, height}, 50.0f, 60);
  add_water(snapshot, 0.0f, 2000.0f, absorption);
  const RenderSettings s = water_settings("pt", 0);
  constexpr int kSize = 33;
  auto renderer = make_renderer(s, kSize, kSize);
  renderer->render(snapshot, nullptr, s);
  const auto texels = renderer->read().gbuffer();
  const auto image = renderer->read().linear();
  for (int row = 0; row < kSize; row += 8) {
    const auto at = static_cast<std::size_t>(row * kSize + kSize / 2);
    const float above = 2.0f * (static_cast<float>(row) + 0.5f) / kSize - 1.0f;
    const float angle = radians(40.0f) - std::atan(above * std::tan(radians(30.0f)));  // from the vertical
    const float inner = std::asin(std::sin(angle) / kIndex), way = depth / std::cos(inner);
    const float x = height * std::tan(angle) + depth * std::tan(inner);
    EXPECT_NEAR(texels[at].position_t.x, x, 2e-3f * (1 + x)) << row;
    EXPECT_NEAR(texels[at].position_t.z, -depth, 1e-2f) << row;
    const float through = 1.0f - shared::dielectric_reflectance(std::cos(angle), kIndex);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(image[at][c], through * std::exp(-absorption[c] * way), 1e-3f) << row << ' ' << c;
  }
}

TEST_F(WaterTest, TheCameraUnderWaterSeesLessTheFartherItLooks) {
  scene::FrameSnapshot snapshot = scene::furnace(0.0f, 1.0f);
  look(snapshot, {-64, 0, -20}, 0, 20);
  add_water(snapshot, 100.0f, 140.0f, vec3(0.01f, 0.0f, 0.1f));
  const RenderSettings s = water_settings("pt", 1);
  auto renderer = make_renderer(s, 33, 33);
  renderer->render(snapshot, nullptr, s);
  const vec4 middle = renderer->read().linear()[33 * 16 + 16];
  EXPECT_NEAR(middle.x, std::exp(-0.01f * 192), 1e-3f);
  EXPECT_NEAR(middle.y, 1.0f, 1e-5f);
  EXPECT_NEAR(middle.z, std::exp(-0.1f * 192), 1e-3f);
}

// A floor under still and moving water, lit by a sun alone: shadow rays find it through the surface, with what
// Fresnel's and Snell's laws leave of it. Of a sun that brings E to a surface across its rays the floor reflects, as
// basic radiance, albedo / pi (1 - R) exp(-sigma depth / cosine beyond) E cosine / n^2.
TEST_F(WaterTest, ShadowRaysFindTheSunThroughTheSurface) {
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
TEST_F(WaterTest, ShadowRaysFindTheSunThatWaterMirrors) {
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
TEST_F(WaterTest, EveryPieceAbsorbsOnce) {
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

// What absorbs light needs no tint on top; a liquid that is drawn opaque, or none at all, has the whole.
TEST(WaterTint, IsLeftOutWhereTheCameraIsInAClearLiquid) {
  scene::FrameSnapshot snapshot;
  snapshot.screen_tint = vec4(0.5f, 0.3f, 0.2f, 0.5f);
  snapshot.tint_in_liquid = vec4(1, 0, 0, 0.1f);
  RenderSettings s;
  const auto tint = [&] { return frame_constants(snapshot, s, {8, 8}, {8, 8}).screen_tint; };
  s.water = 1;
  EXPECT_EQ(tint(), snapshot.screen_tint);
  snapshot.camera_liquid = 3;
  EXPECT_EQ(tint(), snapshot.tint_in_liquid);
  s.water = 0;
  EXPECT_EQ(tint(), snapshot.screen_tint);
}

TEST_F(WaterTest, WithoutWaterNothingChanges) {
  std::uint64_t hashes[2];
  for (const int water : {0, 1}) {
    RenderSettings s = water_settings("mcpg_nee", 2);
    s.water = water;
    s.deterministic = 1;
    auto renderer = make_renderer(s, 48, 48);
    for (int frame = 0; frame < 3; ++frame) renderer->render(scene::cornell_box(), nullptr, s);
    hashes[water] = image_hash(*renderer);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace fb::render
