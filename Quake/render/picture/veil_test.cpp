// Translucent liquids without refraction: every pixel shows the liquid and what shines through it, each by its share.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "render/renderer.h"
#include "render/test_denoiser.h"
#include "render/test_device.h"
#include "render/test_water.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

using VeilTest = WaterDeviceTest;

// A level veil from edge to edge of `half`.
void add_veil(scene::FrameSnapshot& snapshot, float z, float half, float alpha, float albedo, float emission) {
  add_water(snapshot, z, half, vec3(0.0f));
  auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
  assets->generation = scene::next_generation();
  scene::Material& veil = assets->materials.back();
  veil.flags = scene::kMaterialLiquid;
  veil.alpha = alpha;
  veil.base_color = vec3(albedo);
  veil.emission_kind = emission > 0 ? scene::EmissionKind::kConstant : scene::EmissionKind::kNone;
  veil.emission = vec3(emission);
  snapshot.assets = assets;
  snapshot.camera_liquid = scene::kNone;
}

// By chance a pixel would show one of both. From above and from below, where more is seen of the one or of the other.
TEST_F(VeilTest, BothSurfacesHaveTheirShares) {
  const float glow = 0.2f;
  for (const float alpha : {0.3f, 0.7f}) {
    for (const float z : {-20.0f, 20.0f}) {
      scene::FrameSnapshot snapshot = scene::furnace(0.0f, 1.0f);
      look(snapshot, {0, 0, z}, z / 4, 100);
      add_veil(snapshot, 0.0f, 90.0f, alpha, 0.0f, glow);
      RenderSettings s = plain_settings("pt", 1);
      s.water = 0;
      s.jitter = 0;
      auto renderer = make_renderer(s, 48, 32);
      renderer->render(at_time(snapshot, 1), nullptr, s);
      std::size_t veiled = 0;
      for (const vec4& p : renderer->read().linear()) {
        const float mixed = alpha * glow + (1 - alpha);
        const bool by_veil = std::abs(p.x - mixed) < 1e-3f;
        EXPECT_TRUE(by_veil || std::abs(p.x - 1.0f) < 1e-3f) << p.x;
        veiled += by_veil ? 1 : 0;
      }
      EXPECT_GT(veiled, 200u) << alpha << ' ' << z;
      EXPECT_LT(veiled, 48u * 32u - 200u) << alpha << ' ' << z;
    }
  }
}

// Where all surfaces glow and reflect alike, paths begin at either, and no pixel is told from another.
TEST_F(VeilTest, EvenLightStaysEven) {
  const float albedo = 0.5f;
  for (const float light_scale : {1.0f, 0.5f}) {
    for (const float alpha : {0.3f, 0.7f}) {
      scene::FrameSnapshot snapshot = scene::furnace(albedo, 1.0f);
      look(snapshot, {0, 0, 20}, 5, 100);
      add_veil(snapshot, 0.0f, 90.0f, alpha, albedo, 1.0f);
      RenderSettings s = denoised_water_settings(light_scale);
      s.water = 0;
      s.first_spp = 1;
      auto renderer = make_renderer(s, 48, 32);
      for (int frame = 1; frame <= 3; ++frame) {
        renderer->render(at_time(snapshot, frame), nullptr, s);
        for (const vec4& p : renderer->read().denoised())
          ASSERT_NEAR(p.x, 1.0f + albedo, 0.03f) << light_scale << ' ' << alpha << ' ' << frame;
      }
      EXPECT_EQ(renderer->read().counters().history_not_finite, 0u);
    }
  }
}

// Where more is seen of a veil than of what is behind it, and the other way round, the mean is that of rays that pass
// the veil by chance, which an instance of alpha below one does.
TEST_F(VeilTest, HasTheMeanOfRaysThatPassByChance) {
  for (const float alpha : {0.3f, 0.7f}) {
    std::vector<double> means;
    for (const bool liquid : {true, false}) {
      scene::FrameSnapshot snapshot = scene::cornell_box();
      add_veil(snapshot, 60.0f, 200.0f, alpha, 0.6f, 0.0f);
      auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
      assets->generation = scene::next_generation();
      scene::Material& veil = assets->materials.back();
      veil.specular = 1.0f;
      veil.roughness = 0.4f;
      if (!liquid) veil.flags = 0;
      snapshot.assets = assets;
      RenderSettings s = plain_settings("nee", 2);
      s.water = 0;
      s.spp = 256;
      auto renderer = make_renderer(s, 32, 32);
      renderer->render(at_time(snapshot, 1), nullptr, s);
      double mean = 0;
      for (const vec4& p : renderer->read().linear()) mean += static_cast<double>(p.y) / (32.0 * 32.0);
      means.push_back(mean);
    }
    EXPECT_NEAR(means[0], means[1], 0.01 * means[1]) << alpha;
  }
}

}  // namespace
}  // namespace fb::render
