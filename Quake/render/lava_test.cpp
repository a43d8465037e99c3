// Lava and teleporters that are less than opaque (r_lavaalpha, r_telealpha, a map's keys): surfaces that glow by a
// share and are an interface for the rest, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>

#include "render/renderer.h"
#include "render/test_image.h"
#include "render/test_lava.h"
#include "shared/dielectric.h"

namespace fb::render {
namespace {

// A ground that glows under lava, from straight above: the surface's share glows, the rest shows the ground.
TEST_F(LavaTest, ShowsWhatItDoesNotHide) {
  constexpr float kDepth = 80.0f, kGlow = 3.0f, kLavaIndex = 1.5f;
  const vec3 absorption(0.002f, 0.01f, 0.02f);
  for (const float opaque : {0.25f, 0.75f, 1.0f}) {
    scene::FrameSnapshot snapshot;
    auto assets = std::make_shared<scene::Assets>();
    assets->materials.push_back(constant(vec3(1.0f), vec3(0.0f)));
    assets->materials.push_back(glowing_liquid(*assets, scene::EmissionKind::kLava, scene::OpacityFrom::kLava));
    assets->materials[1].index = kLavaIndex;
    assets->materials[1].absorption = absorption;
    add_level(snapshot, *assets, -kDepth, 200, 0);
    add_level(snapshot, *assets, 0, 200, 1);
    snapshot.assets = assets;
    snapshot.liquid_opacity.lava = opaque;
    look(snapshot, {0, 0, 60}, 90, 4);
    RenderSettings s = water_settings("pt", 0);
    s.emit_lava = kGlow;
    auto renderer = make_renderer(s, 16, 16);
    renderer->render(snapshot, nullptr, s);
    const float through = 1.0f - shared::dielectric_reflectance(1.0f, kLavaIndex);
    for (const vec4& p : renderer->read().linear())
      for (int c = 0; c < 3; ++c) {
        const float below = through * std::exp(-absorption[c] * kDepth * opaque);
        ASSERT_NEAR(p[c], opaque * kGlow + (1 - opaque) * below, 2e-3f) << opaque << ' ' << c;
      }
  }
}

// Opaque lava is no interface: the picture has the bits that it has without r_water.
TEST_F(LavaTest, OpaqueIsASurfaceLikeAnyOther) {
  scene::FrameSnapshot snapshot;
  auto assets = std::make_shared<scene::Assets>();
  assets->materials.push_back(constant(vec3(0.0f), vec3(0.5f)));
  assets->materials.push_back(glowing_liquid(*assets, scene::EmissionKind::kLava, scene::OpacityFrom::kLava));
  add_level(snapshot, *assets, 40, 200, 0);
  add_level(snapshot, *assets, 0, 200, 1);
  snapshot.assets = assets;
  look(snapshot, {0, 0, 20}, -40, 80);
  std::uint64_t hashes[2];
  for (const int water : {0, 1}) {
    RenderSettings s = water_settings("nee", 1);
    s.water = water;
    auto renderer = make_renderer(s, 32, 32);
    renderer->render(snapshot, nullptr, s);
    hashes[water] = image_hash(*renderer);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace fb::render
