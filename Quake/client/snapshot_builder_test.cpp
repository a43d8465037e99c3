// Stable ids, the past of everything that moves, and what stands for what.
#include "client/snapshot_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "client/session/interpolate.h"
#include "client/session/test_session.h"
#include "formats/test_bsp.h"
#include "scene/authored/authored_map.h"
#include "scene/authored/displayed_fog.h"
#include "scene/library/test_lit_room.h"

namespace fb::cl {
namespace {

using test::ToldSession;
using test::update;
namespace svc = net::svc;

struct Scene : ToldSession {
  Scene() : ToldSession({666, 0}), library(nullptr) {
    known[3].kind = scene::ModelKind::kSprite;
    known[3].sprite_frames = {{{7}, {}, 20}, {{8, 9}, {0.1f, 0.2f}, 30}};
    known[1].kind = scene::ModelKind::kBrush;
    known[1].mesh = 3;
    svc::ClientData data;
    data.health = 100;
    data.weapon = 3;
    tell({svc::Time{1.0f}, data, update(1, 3, {0, 0, 24})});
  }
  // Lets a moment pass and builds.
  void pass(double time) {
    ++frame;
    state.old_time = state.time;
    state.time = time;
    relink(*this, true, false);
    view = calculate_view(*this, memory, nullptr, 0.05);
    const scene::Model* weapon = state.model(state.hud.stats[net::kStatWeapon]);
    if (weapon) animate_entity(state.view_model, *weapon, state.time, true);
    place_entities(*this);
  }
  const scene::FrameSnapshot& build() {
    builder.build({*this, view, library, nullptr, camera, 640, 480, true, {}}, snapshot);
    return snapshot;
  }
  const scene::Instance* find(std::uint32_t id) const {
    for (const auto& i : snapshot.instances)
      if (i.id == id) return &i;
    return nullptr;
  }
  scene::ModelLibrary library;
  SnapshotBuilder builder;
  View view;
  ViewMemory memory;
  std::optional<scene::Camera> camera;
  scene::FrameSnapshot snapshot;
};

TEST(Snapshot, EverythingKeepsItsIdAndItsPast) {
  Scene s;
  net::EntityState torch;
  torch.model = 3;
  s.tell({svc::SpawnStatic{torch, true}, svc::Time{1.1f}, update(1, 3, {5, 0, 24}), update(2, 2, {0, 0, 0}),
          update(3, 3, {100, 0, 0})});
  s.effects.particles.trail({0, 0, 50}, {9, 0, 50}, Trail::kBlood, 1.0);
  s.effects.particles.run(1.05, 0.05);
  s.pass(1.05);
  s.build();
  EXPECT_TRUE(s.snapshot.cut);
  std::map<std::uint32_t, scene::Instance> before;
  for (const auto& i : s.snapshot.instances) {
    EXPECT_TRUE(before.emplace(i.id, i).second) << "id " << i.id << " twice";
    EXPECT_TRUE(i.flags & scene::kInstanceNew) << i.id;
  }
  EXPECT_EQ(before.count(scene::kIdEntity + 1), 1u);
  EXPECT_EQ(before.count(scene::kIdEntity + 2), 1u);
  EXPECT_EQ(before.count(scene::kIdStatic), 1u);
  EXPECT_EQ(before.count(scene::kIdViewModel), 1u);

  const scene::Camera old_camera = s.snapshot.camera;
  s.entity(3).frame = 1;
  s.effects.particles.run(1.05, 0.05);
  s.tell({svc::Time{1.2f}, update(1, 3, {10, 0, 24}), update(2, 2, {10, 0, 0}),
          update(3, 3, {110, 0, 0}, {0, 45, 0}, net::kUpdateFrame)});
  s.pass(1.15);
  s.build();
  EXPECT_FALSE(s.snapshot.cut);
  EXPECT_EQ(s.snapshot.prev_camera.position, old_camera.position);
  EXPECT_EQ(s.snapshot.prev_time, 1.05);
  EXPECT_EQ(s.snapshot.time, 1.15);
  int moved = 0;
  for (const auto& i : s.snapshot.instances) {
    const auto past = before.find(i.id);
    ASSERT_NE(past, before.end()) << i.id;
    EXPECT_FALSE(i.flags & scene::kInstanceNew) << i.id;
    EXPECT_EQ(i.prev_transform, past->second.transform) << i.id;
    EXPECT_EQ(i.prev_pose, past->second.pose) << i.id;
    moved += i.transform != i.prev_transform;
  }
  EXPECT_GE(moved, 7) << "player, door, monster, weapon, particles";
}

TEST(Snapshot, BuildingTwiceGivesTheSame) {
  Scene s;
  s.pass(1.0);
  s.build();
  s.tell({svc::Time{1.1f}, update(1, 3, {5, 0, 24})});
  s.pass(1.05);
  const scene::FrameSnapshot first = s.build();
  const scene::FrameSnapshot& second = s.build();
  EXPECT_EQ(first.frame, second.frame);
  ASSERT_EQ(first.instances.size(), second.instances.size());
  for (std::size_t i = 0; i < first.instances.size(); ++i) {
    EXPECT_EQ(first.instances[i].prev_transform, second.instances[i].prev_transform);
    EXPECT_EQ(first.instances[i].flags, second.instances[i].flags);
  }
  EXPECT_EQ(first.prev_camera.position, second.prev_camera.position);
}

TEST(Snapshot, NewcomersAndTeleportsHaveNoPast) {
  Scene s;
  s.tell({svc::Time{1.1f}, update(1, 3, {0, 0, 24}), update(2, 2, {0, 0, 0})});
  s.pass(1.1);
  s.build();
  s.tell({svc::Time{1.2f}, update(1, 3, {0, 0, 24}), update(2, 2, {500, 0, 0}), update(4, 3, {7, 7, 7})});
  s.pass(1.2);
  s.build();
  EXPECT_TRUE(s.find(scene::kIdEntity + 2)->flags & scene::kInstanceNew);
  EXPECT_EQ(s.find(scene::kIdEntity + 2)->prev_transform, s.find(scene::kIdEntity + 2)->transform);
  EXPECT_TRUE(s.find(scene::kIdEntity + 4)->flags & scene::kInstanceNew);
  EXPECT_FALSE(s.find(scene::kIdEntity + 1)->flags & scene::kInstanceNew);
  EXPECT_FALSE(s.snapshot.cut);
  // The player's own teleport is a cut.
  s.tell({svc::Time{1.3f}, update(1, 3, {900, 0, 24}), update(2, 2, {500, 0, 0})});
  s.pass(1.3);
  s.build();
  EXPECT_TRUE(s.snapshot.cut);
  EXPECT_EQ(s.snapshot.prev_camera.position, s.snapshot.camera.position);
  s.pass(1.3);
  EXPECT_FALSE(s.build().cut);
}

TEST(Snapshot, TheBodyIsForIndirectRaysTheWeaponForTheCamera) {
  Scene s;
  s.pass(1.0);
  s.build();
  ASSERT_NE(s.find(scene::kIdEntity + 1), nullptr);
  EXPECT_EQ(s.find(scene::kIdEntity + 1)->visibility, static_cast<std::uint32_t>(scene::kSeenByIndirect));
  ASSERT_NE(s.find(scene::kIdViewModel), nullptr);
  EXPECT_EQ(s.find(scene::kIdViewModel)->visibility, static_cast<std::uint32_t>(scene::kSeenByCamera));
  EXPECT_TRUE(s.find(scene::kIdViewModel)->flags & scene::kInstanceViewModel);
  s.camera = scene::Camera{{1, 2, 3}, {0, 90, 0}, 0.0f, 0.0f};
  s.build();
  EXPECT_EQ(s.snapshot.camera.position, vec3(1, 2, 3));
  EXPECT_FLOAT_EQ(s.snapshot.camera.fov_x, 90.0f);
  EXPECT_EQ(s.find(scene::kIdEntity + 1)->visibility, static_cast<std::uint32_t>(scene::kSeenByAll));
  EXPECT_EQ(s.find(scene::kIdViewModel), nullptr);
}

TEST(Snapshot, AliasModelsPitchBackwardsBrushModelsDoNot) {
  Scene s;
  s.tell({svc::Time{1.1f}, update(1, 3, {0, 0, 24}), update(2, 2, {0, 0, 0}, {45, 0, 0}),
          update(3, 3, {0, 0, 0}, {45, 0, 0})});
  s.pass(1.1);
  s.build();
  EXPECT_NEAR(s.find(scene::kIdEntity + 2)->transform[0].z, -std::sqrt(0.5f), 1e-4f) << "looks down";
  EXPECT_NEAR(s.find(scene::kIdEntity + 3)->transform[0].z, std::sqrt(0.5f), 1e-4f);
}

TEST(Snapshot, AlphaScaleSkinAndAlternateTextures) {
  Scene s;
  auto ghost = update(2, 3, {0, 0, 0}, vec3(0.0f), net::kUpdateAlpha | net::kUpdateScale | net::kUpdateSkin);
  ghost.alpha = net::encode_alpha(0.5f);
  ghost.scale = 32;
  ghost.skin = 1;
  auto gone = update(3, 3, {0, 0, 0}, vec3(0.0f), net::kUpdateAlpha);
  gone.alpha = net::kAlphaZero;
  auto pressed = update(4, 2, {0, 0, 0}, vec3(0.0f), net::kUpdateFrame);
  pressed.frame = 1;
  s.tell({svc::Time{1.1f}, update(1, 3, {0, 0, 24}), ghost, gone, pressed});
  s.pass(1.1);
  s.build();
  const scene::Instance* g = s.find(scene::kIdEntity + 2);
  ASSERT_NE(g, nullptr);
  EXPECT_NEAR(g->alpha, 0.5f, 0.01f);
  EXPECT_NEAR(glm::length(g->transform[0]), 2.0f, 1e-4f);
  EXPECT_EQ(g->material_base, 6u);
  EXPECT_EQ(s.find(scene::kIdEntity + 3), nullptr);
  EXPECT_TRUE(s.find(scene::kIdEntity + 4)->flags & scene::kInstanceAlternate);
}

TEST(Snapshot, FogScattersAsItsCvarsSay) {
  Scene s;
  s.state.fog.now = s.state.fog.before = {0.1f, vec3(0.5f)};
  s.pass(2.0);
  ASSERT_TRUE(s.build().medium.scatters());
  EXPECT_EQ(s.snapshot.medium.g, 0.4f);
  EXPECT_EQ(s.snapshot.medium.alpha, 0.0f);
  EXPECT_EQ(s.snapshot.medium.sky, 0.5f);
  s.settings.r_fog_g = 0.7f;
  s.settings.r_fog_alpha = 1.0f;
  s.settings.r_skyfog = 0.25f;
  EXPECT_EQ(s.build().medium.g, 0.7f);
  EXPECT_EQ(s.snapshot.medium.alpha, 1.0f);
  EXPECT_EQ(s.snapshot.medium.sky, 0.75f);
  EXPECT_EQ(s.snapshot.medium.before_sky, 0.5f);
  for (const float covers : {0.5f, 0.75f, 2.0f}) {
    s.settings.r_skyfog = covers;
    EXPECT_EQ(s.build().medium.before_sky, 1.0f) << covers;
  }
  s.settings.r_skyfog = 0.0f;
  EXPECT_EQ(s.build().medium.before_sky, 0.0f);
}

// What the map says counts until the player says something else.
TEST(Snapshot, TheMapSaysHowMuchFogCoversTheSky) {
  Scene s;
  s.state.fog.now = s.state.fog.before = {0.1f, vec3(0.5f)};
  s.settings.r_skyfog = 0.25f;
  s.state.sky_fog = {0.0f, 0.25f};
  s.pass(2.0);
  EXPECT_EQ(s.build().medium.sky, 1.0f);
  s.state.sky_fog = {1.0f, 0.25f};
  EXPECT_EQ(s.build().medium.sky, 0.0f);
  s.settings.r_skyfog = 0.75f;
  EXPECT_EQ(s.build().medium.sky, 0.25f);
}

TEST(Snapshot, SpritesPlayTheirGroups) {
  Scene s;
  s.tell({svc::Time{1.1f}, update(1, 3, {0, 0, 24}), update(2, 4, {50, 0, 0})});
  s.pass(1.1);
  s.build();
  EXPECT_EQ(s.find(scene::kIdEntity + 2)->mesh, 7u);
  EXPECT_EQ(s.find(scene::kIdEntity + 2)->material_base, 20u);
  auto grouped = update(2, 4, {60, 0, 0}, vec3(0.0f), net::kUpdateFrame);
  grouped.frame = 1;
  s.tell({svc::Time{1.2f}, update(1, 3, {0, 0, 24}), grouped});
  s.entity(2).sync_base = 0.0f;
  s.pass(1.15);  // 0.15 of 0.2: the second image
  s.build();
  const scene::Instance* i = s.find(scene::kIdEntity + 2);
  EXPECT_EQ(i->mesh, 9u);
  EXPECT_EQ(i->material_base, 31u);
  EXPECT_FALSE(i->flags & scene::kInstanceNew) << "another image of the same sprite goes on";
}

TEST(Snapshot, SpriteOrientations) {
  using formats::SpriteOrientation;
  scene::Camera camera;
  camera.angles = {30, 90, 0};  // looks along +y and down
  const vec3 at(10, 20, 30);
  const auto made = [&](SpriteOrientation o, const vec3& angles = vec3(0.0f)) {
    return sprite_transform(o, at, angles, 2.0f, camera);
  };
  const AxisVectors eye = angle_vectors(camera.angles);
  const mat4x3 parallel = made(SpriteOrientation::kParallel);
  EXPECT_NEAR(glm::length(parallel[0] + 2.0f * eye.forward), 0.0f, 1e-4f) << "towards the viewer";
  EXPECT_NEAR(glm::length(parallel[1] - 2.0f * eye.right), 0.0f, 1e-4f);
  EXPECT_NEAR(glm::length(parallel[2] - 2.0f * eye.up), 0.0f, 1e-4f);
  EXPECT_EQ(parallel[3], at);
  const mat4x3 upright = made(SpriteOrientation::kParallelUpright);
  EXPECT_NEAR(upright[2].z, 2.0f, 1e-5f);
  EXPECT_NEAR(upright[0].y, -2.0f, 1e-4f);
  const mat4x3 facing = made(SpriteOrientation::kFacingUpright);
  EXPECT_NEAR(facing[2].z, 2.0f, 1e-5f);
  EXPECT_NEAR(glm::dot(facing[0], vec3(at.x, at.y, 0)), -2.0f * std::sqrt(500.0f), 1e-3f);
  const AxisVectors own = angle_vectors({0, 45, 0});
  const mat4x3 oriented = made(SpriteOrientation::kOriented, {0, 45, 0});
  EXPECT_NEAR(glm::length(oriented[0] + 2.0f * own.forward), 0.0f, 1e-4f);
  const mat4x3 rolled = made(SpriteOrientation::kParallelOriented, {0, 0, 90});
  EXPECT_NEAR(glm::length(rolled[1] - 2.0f * eye.up), 0.0f, 1e-4f);
  EXPECT_NEAR(glm::length(rolled[0] + 2.0f * eye.forward), 0.0f, 1e-4f);
  for (const mat4x3& m : {parallel, upright, facing, oriented, rolled})
    EXPECT_GT(glm::dot(glm::cross(m[0], m[1]), m[2]), 0.0f) << "right-handed";
  camera.position = at;  // in its very place
  for (float f : {made(SpriteOrientation::kFacingUpright)[0].x, made(SpriteOrientation::kFacingUpright)[1].y})
    EXPECT_TRUE(std::isfinite(f));
}

TEST(Snapshot, ParticlesAndLightsAreInstances) {
  Scene s;
  s.effects.particles.explosion({0, 0, 100}, 1.0);
  s.effects.particles.effect({0, 0, 100}, vec3(0.0f), 50, 1, 1.0);
  DynamicLight& light = s.effects.lights.allocate(0, 1.0);
  light.radius = 200.0f;
  light.die = 2.0;
  light.origin = {1, 2, 3};
  s.pass(1.0);
  s.build();
  int particles = 0, glowing = 0;
  for (const auto& i : s.snapshot.instances) {
    if (i.id < scene::kIdParticle || i.id >= scene::kIdDynamicLight) continue;
    ++particles;
    glowing += i.emission != vec3(0.0f);
    EXPECT_TRUE(i.flags & scene::kInstanceColor);
    const float volume = glm::dot(glm::cross(i.transform[0], i.transform[1]), i.transform[2]);
    EXPECT_NEAR(volume, std::pow(glm::length(i.transform[0]), 3.0f), 1e-3f) << "turned and scaled, nothing else";
  }
  EXPECT_EQ(particles, 1025);
  EXPECT_EQ(glowing, 1024);
  const scene::Instance* l = s.find(scene::kIdDynamicLight);
  ASSERT_NE(l, nullptr);
  EXPECT_EQ(l->visibility, static_cast<std::uint32_t>(scene::kSeenByIndirect));
  EXPECT_FLOAT_EQ(l->transform[0].x, 10.0f);
  EXPECT_EQ(l->transform[3], vec3(1, 2, 3));
  EXPECT_FLOAT_EQ(l->emission.x, light_sphere(200.0f).radiance);
  light.key = s.state.view_entity;
  s.build();
  EXPECT_FLOAT_EQ(s.find(scene::kIdDynamicLight)->emission.x, light_sphere(200.0f, true).radiance)
      << "the player's own";
  s.settings.r_particles = 0.0f;
  s.settings.r_dynamic = 0.0f;
  s.build();
  EXPECT_EQ(s.find(scene::kIdDynamicLight), nullptr);
  for (const auto& i : s.snapshot.instances) EXPECT_LT(i.id, static_cast<std::uint32_t>(scene::kIdParticle));
}

// Quake's exp(-(density z / 64)^2) is 1/2 at z = 64 sqrt(ln 2) / density; ours, exp(-extinction z), is so there, too.
TEST(Snapshot, FogLeavesHalfWhereQuakesDoes) {
  Scene s;
  for (const float density : {0.02f, 0.1f, 1.0f, 3.0f}) {
    s.state.fog.now.density = density;
    const float half = 64.0f * std::sqrt(std::log(2.0f)) / density;
    EXPECT_NEAR(std::exp(-(density * half / 64.0f) * (density * half / 64.0f)), 0.5f, 1e-6f) << density;
    s.pass(1.1);
    EXPECT_NEAR(std::exp(-s.build().medium.extinction * half), 0.5f, 1e-6f) << density;
    s.settings.r_fog = 2.0f;  // a factor on the density
    EXPECT_NEAR(std::exp(-s.build().medium.extinction * half), 0.25f, 1e-6f) << density;
    s.settings.r_fog = 1.0f;
  }
}

TEST(Snapshot, FogIsAsInQuakeWhereItsAuthorSawItSo) {
  scene::Medium medium;
  scene::show_as_in_quake(medium, 0.1f, vec3(0.5f, 0.2f, 0.1f), 0.25f);
  // The power that stands for the display's, by how bright the fog is there.
  const auto shown = [](float linear) { return 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f; };
  const float rate = 1.07f - 0.32f * (0.2126f * shown(0.5f) + 0.7152f * shown(0.2f) + 0.0722f * shown(0.1f));
  const float near = 100.0f, depth = 0.1f * near / 64.0f;
  EXPECT_NEAR(std::exp(-medium.square * near * near), std::pow(std::exp(-depth * depth), 1.4f * rate), 1e-6f);
  EXPECT_EQ(medium.glow, vec3(0.5f, 0.2f, 0.1f));
  EXPECT_NEAR(medium.sky, std::pow(0.75f, 1.4f), 1e-6f);
  EXPECT_NEAR(medium.glow_before_sky, std::pow(0.25f, 1.4f), 1e-6f);
  scene::show_as_in_quake(medium, 1e30f, vec3(1.0f), 1.0f);
  EXPECT_TRUE(std::isfinite(medium.square)) << "whatever a server sends";
}

// A room with lightmaps that one lamp made.
scene::ModelLibrary baked_library() {
  namespace st = scene::test;
  formats::Bsp bsp = st::lit_room().bsp;
  const scene::EntityLight lamp = st::lit_lamp(vec3(256, 256, 300), 20000);
  st::bake(bsp, [&](const vec3& p, const vec3& n) { return st::lamp_light(lamp, p, n); });
  bsp.entities = R"({"classname" "worldspawn"}{"classname" "light" "origin" "256 256 300"})";
  st::TestFiles files;
  files.add_palette();
  files.files["maps/a.bsp"] = formats::testing::write_bsp(bsp);
  scene::ModelLibrary library([files](std::string_view path) { return files.loader()(path); });
  EXPECT_TRUE(library.load_map("maps/a.bsp").ok());
  return library;
}

TEST(Snapshot, WhereBakedLightCountsTorchesAndSomeDoorsAreForTheCameraAlone) {
  Scene s;
  s.library = baked_library();
  scene::AuthoredMap authored(s.library);
  authored.wait();
  ASSERT_NE(authored.light(), nullptr);
  s.known[2].glows = true;
  net::EntityState torch;
  torch.model = 3;
  s.tell({svc::SpawnStatic{torch, true}, svc::Time{1.1f}, update(2, 2, {0, 0, 0}), update(3, 3, {100, 0, 0})});
  s.pass(1.05);
  const auto seen_by_light = [&](std::uint32_t id) {
    s.builder.build({s, s.view, s.library, nullptr, s.camera, 640, 480, true, {}, &authored}, s.snapshot);
    const scene::Instance* instance = s.find(id);
    EXPECT_NE(instance, nullptr) << id;
    return instance != nullptr && (instance->visibility & scene::kSeenByIndirect) != 0;
  };
  EXPECT_FALSE(seen_by_light(scene::kIdStatic)) << "its light is its lamp's";
  EXPECT_TRUE(seen_by_light(scene::kIdEntity + 3)) << "what moves is no torch";
  EXPECT_TRUE(seen_by_light(scene::kIdEntity + 2)) << "a door";
  s.known[1].shadowless = true;
  EXPECT_FALSE(seen_by_light(scene::kIdEntity + 2));
  s.settings.r_authored = 0.0f;
  EXPECT_TRUE(seen_by_light(scene::kIdEntity + 2));
  EXPECT_TRUE(seen_by_light(scene::kIdStatic));
}

TEST(Snapshot, FogScattersItsColourInLinearLight) {
  Scene s;
  s.state.fog.now = {0.1f, vec3(0.0f, 0.5f, 1.0f)};
  s.pass(1.1);
  const scene::Medium& medium = s.build().medium;
  EXPECT_FLOAT_EQ(medium.albedo.x, 0.0f);
  EXPECT_NEAR(medium.albedo.y, std::pow((0.5 + 0.055) / 1.055, 2.4), 1e-6);  // sRGB's 0.5 is 0.214 of the light
  EXPECT_FLOAT_EQ(medium.albedo.z, 1.0f);
  EXPECT_FLOAT_EQ(medium.g, s.settings.r_fog_g);
  EXPECT_FLOAT_EQ(medium.alpha, 0.0f);
  EXPECT_FLOAT_EQ(medium.sky, 0.5f) << "r_skyfog 0.5";
}

TEST(Snapshot, FogStaysWithinItsLimits) {
  Scene s;
  s.pass(1.1);
  EXPECT_FALSE(s.build().medium.scatters()) << "none";
  s.state.fog.now.density = 0.1f;
  for (const float none : {0.0f, -1.0f}) {
    s.settings.r_fog = none;
    EXPECT_FALSE(s.build().medium.scatters()) << "r_fog " << none;
  }
  s.settings.r_fog = 1e30f;
  EXPECT_FLOAT_EQ(s.build().medium.extinction, 10.0f);
  s.settings.r_fog = 1.0f;
  for (const float density : {1000.0f, 1e30f}) {
    s.state.fog.now.density = density;
    EXPECT_FLOAT_EQ(s.build().medium.extinction, 10.0f) << density;
  }
  s.state.fog.now.density = 0.1f;
  s.settings.r_skyfog = -1.0f;
  EXPECT_FLOAT_EQ(s.build().medium.sky, 1.0f);
  s.settings.r_skyfog = 2.0f;
  EXPECT_FLOAT_EQ(s.build().medium.sky, 0.0f);
}

TEST(Snapshot, LiquidsAreAsOpaqueAsThePlayerWants) {
  Scene s;
  s.pass(1.1);
  EXPECT_EQ(s.build().liquid_opacity, scene::LiquidOpacity()) << "as it stands, nothing is changed";
  struct Case {
    float water, slime;
    scene::LiquidOpacity expected;
    float lava = 0.0f, teleport = 0.0f;
  };
  for (const Case& c : {Case{0.5f, 0.0f, {0.5f, 0.5f}},
                        {1.0f, 0.0f, {1.0f, 1.0f, 0.25f, 0.75f}, 0.25f, 0.75f},
                        {0.5f, 0.0f, {0.5f, 0.5f, 1.0f, 1.0f}, NAN, 2.0f},
                        {0.5f, 0.25f, {0.5f, 0.25f}},
                        {0.0f, 0.0f, {0.0f, 0.0f}},
                        {-1.0f, -1.0f, {0.0f, 0.0f}},
                        {2.0f, 3.0f, {1.0f, 1.0f}},
                        {NAN, NAN, {0.0f, 0.0f}}}) {
    s.settings.r_wateralpha = c.water;
    s.settings.r_slimealpha = c.slime;
    s.settings.r_lavaalpha = c.lava;
    s.settings.r_telealpha = c.teleport;
    EXPECT_EQ(s.build().liquid_opacity, c.expected) << c.water << " " << c.slime;
  }
}

}  // namespace
}  // namespace fb::cl
