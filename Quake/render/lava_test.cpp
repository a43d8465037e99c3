// Lava and teleporters that are less than opaque (r_lavaalpha, r_telealpha, a map's keys): surfaces that glow by a
// share and are an interface for the rest, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "render/renderer.h"
#include "render/test_device.h"
#include "render/test_image.h"
#include "render/test_water.h"
#include "shared/dielectric.h"

namespace fb::render {
namespace {

using LavaTest = WaterDeviceTest;

// A level quad about the origin.
void add_level(scene::FrameSnapshot& snapshot, scene::Assets& assets, float z, float half, std::uint32_t material) {
  scene::Mesh quad;
  scene::add_quad(quad, {-half, -half, z}, {2 * half, 0, 0}, {0, 2 * half, 0}, material);
  scene::finish_mesh(quad);
  assets.meshes.push_back(quad);
  scene::Instance instance;
  instance.id = scene::kIdEntity + static_cast<std::uint32_t>(assets.meshes.size());
  instance.mesh = static_cast<std::uint32_t>(assets.meshes.size() - 1);
  snapshot.instances.push_back(instance);
}

// White, so that it glows by one.
scene::Material glowing_liquid(scene::Assets& assets, scene::EmissionKind kind, scene::OpacityFrom from) {
  assets.images.push_back({"white", scene::ImageEncoding::kSrgba, 1, 1, {255, 255, 255, 255}});
  scene::Material m;
  m.frames = {scene::TextureSet{static_cast<std::uint32_t>(assets.images.size() - 1)}};
  m.emission = vec3(1.0f);
  m.emission_kind = kind;
  m.flags = scene::kMaterialLiquid;
  m.opacity_from = from;
  return m;
}

scene::Material constant(const vec3& radiance, const vec3& albedo) {
  scene::Material m;
  m.base_color = albedo;
  m.emission = radiance;
  m.emission_kind = scene::EmissionKind::kConstant;
  return m;
}

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

// Share of a hemisphere's light, by its cosine, that a square straight above brings (Howell, configuration factor B-3).
double share_of_square(double half, double height) {
  const double a = half / height, root = std::sqrt(1 + a * a);
  return 4 / kPi * (a / root) * std::atan(a / root);
}

// A floor under a teleporter's face, and a lamp above that: no way is bent, so every estimator has the sum of both
// squares' light, of the first by its opaque share and of the second by the rest.
TEST_F(LavaTest, IsALampByItsShareAndLetsTheRestOfLightThrough) {
  constexpr float kAlbedo = 0.6f, kLamp = 0.5f;
  for (const TechniqueInfo& estimator : techniques()) {
    if (!estimator.unbiased()) continue;
    scene::FrameSnapshot snapshot;
    auto assets = std::make_shared<scene::Assets>();
    assets->materials.push_back(constant(vec3(0.0f), vec3(kAlbedo)));
    assets->materials.push_back(glowing_liquid(*assets, scene::EmissionKind::kTeleport, scene::OpacityFrom::kItself));
    assets->materials[1].flags |= scene::kMaterialDielectric;
    assets->materials[1].alpha = 0.5f;
    assets->materials[1].index = 1.0f;
    assets->materials.push_back(constant(vec3(kLamp), vec3(0.0f)));
    add_level(snapshot, *assets, 0, 40, 0);
    add_level(snapshot, *assets, 100, 200, 1);
    add_level(snapshot, *assets, 200, 150, 2);
    snapshot.assets = assets;
    look(snapshot, {0, 0, 60}, 90, 4);
    RenderSettings s = water_settings(std::string(estimator.name), 1);
    s.emit_teleport = 1.0f;
    s.spp = 16;
    auto renderer = make_renderer(s, 48, 48);
    for (int frame = 0; frame < 8; ++frame) {
      snapshot.frame = static_cast<std::uint64_t>(frame);
      renderer->render(snapshot, nullptr, s);
    }
    const ImageEstimate e = image_estimate(renderer->read().linear());
    const double expected = kAlbedo * (0.5 * share_of_square(200, 100) + 0.5 * kLamp * share_of_square(150, 200));
    EXPECT_NEAR(e.mean, expected, 4 * e.error + 1e-3 * expected) << estimator.name;
    EXPECT_LT(e.error, 0.02 * expected) << estimator.name << ": says something";
    EXPECT_EQ(renderer->read().counters().not_finite, 0u);
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
