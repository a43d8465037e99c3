// Glass (r_glass 1): what a .mat text names refractive is the interface that water has, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "render/techniques/test_techniques.h"
#include "render/test_device.h"
#include "render/test_image.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_of_glass.h"
#include "scene/shapes.h"
#include "shared/dielectric.h"

namespace fb::render {
namespace {

using GlassStatistics = DeviceTest;

constexpr float kGlassIndex = 1.5f;

// A body of glass, or of a liquid, as an instance of its own. Gives its material.
struct Body {
  float index = kGlassIndex;
  vec3 absorption{0.0f};
  std::uint32_t flags = scene::kMaterialDielectric;
  float alpha = 1.0f;
};
std::uint32_t add_body(scene::FrameSnapshot& snapshot, const std::function<void(scene::Mesh&, std::uint32_t)>& shape,
                       const Body& body = {}, const mat4x3& transform = mat4x3(1.0f)) {
  auto assets = std::make_shared<scene::Assets>(*snapshot.assets);
  assets->generation = scene::next_generation();
  scene::Material material;
  material.base_color = vec3(0.2f);
  material.emission_kind = scene::EmissionKind::kNone;
  material.flags = body.flags;
  material.index = body.index;
  material.absorption = body.absorption;
  const auto number = static_cast<std::uint32_t>(assets->materials.size());
  assets->materials.push_back(material);
  scene::Mesh mesh;
  shape(mesh, number);
  scene::finish_mesh(mesh);
  assets->meshes.push_back(mesh);
  scene::Instance instance;
  instance.id = scene::kIdEntity + 100 + number;
  instance.mesh = static_cast<std::uint32_t>(assets->meshes.size() - 1);
  instance.transform = instance.prev_transform = transform;
  instance.alpha = body.alpha;
  snapshot.instances.push_back(instance);
  snapshot.assets = assets;
  return number;
}

std::function<void(scene::Mesh&, std::uint32_t)> box(const vec3& min, const vec3& max) {
  return [=](scene::Mesh& mesh, std::uint32_t material) { scene::add_box(mesh, min, max, material); };
}
void ring(scene::Mesh& mesh, std::uint32_t material) { scene::add_torus(mesh, 40, 15, material, 24, 12); }

void look_from(scene::FrameSnapshot& snapshot, const vec3& position, float pitch, float fov) {
  snapshot.camera.position = position;
  snapshot.camera.angles = {pitch, 0, 0};
  snapshot.camera.fov_x = fov;
  snapshot.prev_camera = snapshot.camera;
}

// A closed room of albedo a and emission e with a ring and a block of glass in it: e (1 + a) wherever one looks.
TEST_F(GlassStatistics, AFurnaceStaysWhite) {
  const float albedo = 0.5f;
  for (const std::string& estimator : one_of_each_family(Whose::kUnbiased)) {
    scene::FrameSnapshot snapshot = scene::furnace(albedo, 1.0f);
    look_from(snapshot, {-90, 0, 40}, 25, 90);
    add_body(snapshot, ring, {}, entity_transform({0, 0, 0}, {20, 0, 40}, 1));
    add_body(snapshot, box({-10, 60, -80}, {60, 110, -20}));
    RenderSettings s = plain_settings(estimator, 1);
    s.spp = 16;
    auto renderer = make_renderer(s, 48, 32);
    for (int frame = 0; frame < 4; ++frame) renderer->render(snapshot, nullptr, s);
    const ImageEstimate e = image_estimate(renderer->read().linear());
    EXPECT_NEAR(e.mean, 1.0 + albedo, 5 * e.error + 1e-3) << estimator;
    EXPECT_EQ(renderer->read().counters().not_finite, 0u);
  }
}

// White all around: what a ring reflects and what comes through it are together all of it, but for light that more
// interfaces send around in it than are followed.
TEST_F(GlassStatistics, ReflectsWhatItDoesNotLetThrough) {
  scene::FrameSnapshot snapshot;
  snapshot.assets = std::make_shared<scene::Assets>();
  snapshot.sky.mode = scene::SkyMode::kConstant;
  snapshot.sky.color = vec3(1, 2, 3);
  snapshot.sky.beyond_everything = true;
  add_body(snapshot, ring);
  for (const vec3& position :
       {vec3(-80, 0, 60), vec3(-40, 0, 0), vec3(0, 0, 0)}) {  // outside, within the glass, its hole
    look_from(snapshot, position, position.z > 0 ? 35.0f : 0.0f, 90);
    const RenderSettings s = plain_settings("pt", 1);
    auto renderer = make_renderer(s, 64, 64);
    renderer->render(snapshot, nullptr, s);
    const auto image = renderer->read().linear();
    std::size_t lost = 0;
    for (const vec4& p : image) {
      ASSERT_LE(p.z, 3.0f + 1e-3f);
      if (std::fabs(p.x - 1.0f) + std::fabs(p.y - 2.0f) + std::fabs(p.z - 3.0f) > 1e-3f) ++lost;
    }
    EXPECT_LE(lost, image.size() / 400) << position.x;
  }
}

// From within a block its upper face mirrors a panel that glows by Fresnel's reflectance, and all of it where the angle
// exceeds the critical one.
TEST_F(GlassStatistics, AFaceReflectsAllBeyondTheCriticalAngle) {
  scene::FrameSnapshot snapshot;
  auto assets = std::make_shared<scene::Assets>();
  scene::Material panel;
  panel.emission = vec3(1.0f);
  panel.emission_kind = scene::EmissionKind::kConstant;
  assets->materials.push_back(panel);
  scene::Mesh floor;
  scene::add_quad(floor, {-2000, -2000, -40}, {4000, 0, 0}, {0, 4000, 0}, 0);
  scene::finish_mesh(floor);
  assets->meshes.push_back(floor);
  snapshot.assets = assets;
  snapshot.instances.emplace_back();
  add_body(snapshot, box({-3000, -3000, -100}, {3000, 3000, 20}));
  look_from(snapshot, {0, 0, 0}, -48, 60);
  const RenderSettings s = plain_settings("pt", 0);
  constexpr int kSize = 65;
  auto renderer = make_renderer(s, kSize, kSize);
  renderer->render(snapshot, nullptr, s);
  const auto image = renderer->read().linear();
  int total = 0;
  for (int row = 0; row < kSize; ++row) {
    const float above = 1.0f - 2.0f * (static_cast<float>(row) + 0.5f) / kSize;
    const float up = radians(48.0f) + std::atan(above * std::tan(radians(30.0f)));  // over the horizon
    const float expected = shared::dielectric_reflectance(std::sin(up), 1.0f / kGlassIndex);
    const float seen = image[static_cast<std::size_t>(row * kSize + kSize / 2)].x;
    EXPECT_NEAR(seen, expected, 2e-3f + 2e-2f * expected * (1.0f - expected)) << row;
    total += std::cos(up) > 1.0f / kGlassIndex ? 1 : 0;
    if (std::cos(up) > 1.0f / kGlassIndex + 1e-3f) {
      EXPECT_NEAR(seen, 1.0f, 1e-4f) << row;
    }
  }
  EXPECT_GT(total, kSize / 4);
  EXPECT_LT(total, 3 * kSize / 4);
}

// A plate between the camera and a wall that glows: with R its reflectance and a what one crossing leaves, the series
// of its inner reflections lets (1 - R)^2 a / (1 - R^2 a^2) through.
TEST_F(GlassStatistics, APlateLetsThroughWhatItsInnerReflectionsLeave) {
  for (const std::uint32_t flags : {0u, std::uint32_t{scene::kMaterialAlphaTest}}) {
    scene::FrameSnapshot snapshot;
    auto assets = std::make_shared<scene::Assets>();
    scene::Material wall;
    wall.emission = vec3(1.0f);
    wall.emission_kind = scene::EmissionKind::kConstant;
    assets->materials.push_back(wall);
    scene::Mesh quad;
    scene::add_quad(quad, {300, 4000, -4000}, {0, -8000, 0}, {0, 0, 8000}, 0);
    scene::finish_mesh(quad);
    assets->meshes.push_back(quad);
    snapshot.assets = assets;
    snapshot.instances.emplace_back();
    const vec3 absorption(0.05f, 0.01f, 0.0f);
    add_body(snapshot, box({50, -5000, -5000}, {60, 5000, 5000}),
             {kGlassIndex, absorption, scene::kMaterialDielectric | flags, 0.2f});  // its alpha counts for nothing
    const float angle = radians(50.0f);
    look_from(snapshot, {0, 0, 0}, 50, 1);
    RenderSettings s = plain_settings("pt", 0);
    s.accumulate = 1;
    auto renderer = make_renderer(s, 64, 64);
    for (int frame = 0; frame < 16; ++frame) renderer->render(snapshot, nullptr, s);
    vec3 mean(0.0f);
    for (const vec4& p : renderer->read().linear()) mean += vec3(p) / (64.0f * 64.0f);
    const float cosine = std::cos(angle), r = shared::dielectric_reflectance(cosine, kGlassIndex);
    const float way = 10.0f / shared::dielectric_cosine_beyond(cosine, kGlassIndex);
    for (int c = 0; c < 3; ++c) {
      const float a = std::exp(-absorption[c] * way);
      EXPECT_NEAR(mean[c], (1 - r) * (1 - r) * a / (1 - r * r * a * a), 3e-3f) << c;
    }
  }
}

// A block that is of what surrounds it cannot be seen: at its faces nothing is bent or reflected, and behind it one is
// in water again.
TEST_F(GlassStatistics, AGlassBlockOfWaterInWaterIsNotSeen) {
  const vec3 absorption(0.01f, 0.002f, 0.004f);
  std::vector<vec4> images[2];
  for (const bool within : {false, true}) {
    scene::FrameSnapshot snapshot = scene::furnace(0.0f, 1.0f);
    look_from(snapshot, {-100, 0, -10}, 5, 60);
    const Body liquid{1.33f, absorption, scene::kMaterialDielectric | scene::kMaterialLiquid};
    snapshot.camera_liquid = add_body(snapshot, box({-140, -140, -140}, {140, 140, 120}), liquid);
    if (within) add_body(snapshot, ring, {1.33f, absorption});
    RenderSettings s = plain_settings("pt", 1);
    s.water = 1;
    auto renderer = make_renderer(s, 33, 33);
    renderer->render(snapshot, nullptr, s);
    images[within ? 1 : 0] = renderer->read().linear();
  }
  for (std::size_t i = 0; i < images[0].size(); ++i)
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(images[1][i][c], images[0][i][c], 2e-3f) << i << ' ' << c;
}

// With r_glass 0 a surface is as if no text named it, whatever r_water says.
TEST_F(GlassStatistics, IsASurfaceLikeAnyOtherWithoutIt) {
  std::uint64_t hashes[3];
  for (int kind = 0; kind < 3; ++kind) {
    scene::FrameSnapshot snapshot = scene::cornell_box();
    Body body;
    if (kind == 0) body.flags = 0;
    add_body(snapshot, box({-60, -60, 20}, {60, 60, 80}), body);
    RenderSettings s = plain_settings("nee", 2);
    s.glass = 0;
    s.water = kind == 2 ? 1 : 0;
    auto renderer = make_renderer(s, 48, 48);
    for (int frame = 0; frame < 2; ++frame) renderer->render(snapshot, nullptr, s);
    hashes[kind] = image_hash(*renderer);
  }
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
}

}  // namespace
}  // namespace fb::render
