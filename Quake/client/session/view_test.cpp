#include "client/session/view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "client/session/test_session.h"

namespace fb::cl {
namespace {

using test::ToldSession;
using test::update;
namespace svc = net::svc;

// A living player at the origin who looks along x.
struct Player : ToldSession {
  Player() {
    svc::ClientData d;
    d.health = 100;
    d.on_ground = true;
    tell({svc::Time{1.0f}, d, update(1, 3, vec3(0.0f))});
    state.time = 1.0;
    entity(1).origin = vec3(0.0f);
    settings.cl_bob = 0.0f;
  }
  View look(double seconds = 0.05) { return calculate_view(*this, memory, nullptr, seconds); }
  ViewMemory memory;
};

TEST(View, EyesAreAtViewHeight) {
  Player p;
  const View v = p.look();
  EXPECT_NEAR(v.origin.x, 1.0f / 32, 1e-5f);
  EXPECT_NEAR(v.origin.z, 22.0f + 1.0f / 32, 1e-5f);
  EXPECT_EQ(v.angles, vec3(0.0f));
  EXPECT_TRUE(v.show_weapon);
  EXPECT_EQ(v.weapon_origin, vec3(0, 0, 22));
  EXPECT_EQ(p.entity(1).angles, vec3(-0.0f, 0, 0));
}

TEST(View, BodyAndWeaponFaceWhereTheEyesLook) {
  Player p;
  p.state.view_angles = {20, 135, 0};
  const View v = p.look();
  EXPECT_EQ(v.angles, vec3(20, 135, 0));
  EXPECT_EQ(p.entity(1).angles, vec3(-20, 135, 0)) << "an entity's pitch is backwards";
  EXPECT_EQ(v.weapon_angles, vec3(-20, 135, 0));
}

TEST(View, Bob) {
  Settings s;
  const vec3 running(300, 400, 999);
  // A quarter of the cycle: the sine's top, cut at 4.
  EXPECT_FLOAT_EQ(calculate_bob(s, running, 0.15), 4.0f);
  s.cl_bob = 0.001f;
  EXPECT_NEAR(calculate_bob(s, running, 0.15), 0.5f, 1e-5f);  // 500 * 0.001 * (0.3 + 0.7)
  EXPECT_NEAR(calculate_bob(s, running, 0.0), 0.15f, 1e-5f);
  EXPECT_NEAR(calculate_bob(s, running, 0.45), -0.2f, 1e-5f);  // 0.5 * (0.3 - 0.7)
  s.cl_bobcycle = 0.0f;
  EXPECT_EQ(calculate_bob(s, running, 0.45), 0.0f);
}

TEST(View, RollsWithSidewaysSpeed) {
  Settings s;
  EXPECT_NEAR(calculate_roll(s, vec3(0.0f), {0, -100, 0}), 1.0f, 1e-5f);  // right is -y
  EXPECT_NEAR(calculate_roll(s, vec3(0.0f), {0, 100, 0}), -1.0f, 1e-5f);
  EXPECT_NEAR(calculate_roll(s, vec3(0.0f), {0, -500, 0}), 2.0f, 1e-5f);
  EXPECT_NEAR(calculate_roll(s, vec3(0.0f), {320, 0, 0}), 0.0f, 1e-4f);
}

TEST(View, DeadPlayersLieDown) {
  Player p;
  p.state.hud.stats[net::kStatHealth] = 0;
  const View v = p.look();
  EXPECT_EQ(v.angles.z, 80.0f);
  EXPECT_FALSE(v.show_weapon);
}

TEST(View, DamageTiltsAndFades) {
  Player p;
  p.tell({svc::Damage{0, 40, {100, 0, 0}}});
  p.state.hud.stats[net::kStatHealth] = 50;
  EXPECT_NEAR(p.look(0.25).angles.x, 12.0f, 1e-4f);
  EXPECT_NEAR(p.look(0.25).angles.x, 6.0f, 1e-4f);
  EXPECT_NEAR(p.look(0.25).angles.x, 0.0f, 1e-4f);
}

TEST(View, GunKicks) {
  Player p;
  svc::ClientData d;
  d.health = 100;
  d.punch = {-4, 0, 0};
  p.tell({d});
  EXPECT_EQ(p.look().angles.x, -4.0f);
  p.settings.v_gunkick = 0.0f;
  EXPECT_EQ(p.look().angles.x, 0.0f);
  p.settings.v_gunkick = 2.0f;
  EXPECT_NEAR(p.look(0.05).angles.x, -2.0f, 1e-5f);
  EXPECT_NEAR(p.look(0.05).angles.x, -4.0f, 1e-5f);
  EXPECT_NEAR(p.look(0.05).angles.x, -4.0f, 1e-5f);
}

TEST(View, StairsAreClimbedSmoothly) {
  Player p;
  p.look();
  p.entity(1).origin.z = 16.0f;
  p.state.old_time = 1.0;
  p.state.time = 1.05;
  const View v = p.look();  // 5 of the 16 units in 0.05 s
  EXPECT_NEAR(v.origin.z, 16.0f + 22.0f + 1.0f / 32 - 11.0f, 1e-3f);
  EXPECT_NEAR(v.weapon_origin.z, 16.0f + 22.0f - 11.0f, 1e-3f);
  p.state.old_time = 1.05;
  p.state.time = 1.25;
  EXPECT_NEAR(p.look().origin.z, 16.0f + 22.0f + 1.0f / 32, 1e-3f);
  p.entity(1).origin.z = 80.0f;  // higher than a stair
  p.state.old_time = p.state.time;
  EXPECT_NEAR(p.look().origin.z, 80.0f + 22.0f + 1.0f / 32 - 24.0f, 1e-3f);
  p.state.on_ground = false;
  EXPECT_NEAR(p.look().origin.z, 80.0f + 22.0f + 1.0f / 32, 1e-3f);
}

TEST(View, IntermissionLooksFromTheCameraEntity) {
  Player p;
  p.state.hud.intermission = Intermission::kLevel;
  p.entity(1).origin = {100, 200, 300};
  p.entity(1).angles = {10, 20, 0};
  p.state.time = 0.0;  // no sway
  const View v = p.look();
  EXPECT_EQ(v.origin, vec3(100, 200, 300));
  EXPECT_EQ(v.angles, vec3(10, 20, 0));
  EXPECT_FALSE(v.show_weapon);
  p.state.time = 0.5;
  EXPECT_NEAR(p.look().angles.y, 20.0f + 0.3f * std::sin(1.0f), 1e-4f);
}

TEST(View, FieldOfViewAdaptsToTheWidth) {
  EXPECT_FLOAT_EQ(adapted_fov(90, true, 640, 480), 90.0f);
  EXPECT_NEAR(adapted_fov(90, true, 1920, 1080), 106.2602f, 1e-3f);  // 2 atan(16/9 * 3/4)
  EXPECT_FLOAT_EQ(adapted_fov(90, false, 1920, 1080), 90.0f);
  EXPECT_FLOAT_EQ(adapted_fov(500, false, 640, 480), 170.0f);
  EXPECT_FLOAT_EQ(adapted_fov(90, true, 640, 0), 90.0f);
}

TEST(View, ShiftsBlend) {
  ClientState state;
  Settings s;
  EXPECT_EQ(blend_shifts(state, s), vec4(0.0f));
  state.shifts[kShiftDamage] = {vec3(255, 0, 0), 127.5f};
  vec4 v = blend_shifts(state, s);
  EXPECT_NEAR(v.w, 0.5f, 1e-5f);
  EXPECT_NEAR(v.x, 1.0f, 1e-5f);
  state.shifts[kShiftBonus] = {vec3(0, 255, 0), 127.5f};
  v = blend_shifts(state, s);
  EXPECT_NEAR(v.w, 0.75f, 1e-5f);
  EXPECT_NEAR(v.x, 1.0f / 3, 1e-5f);
  EXPECT_NEAR(v.y, 2.0f / 3, 1e-5f);
  s.gl_cshiftpercent_damage = 0.0f;
  EXPECT_NEAR(blend_shifts(state, s).x, 0.0f, 1e-5f);
  s.gl_cshiftpercent = 0.0f;
  EXPECT_EQ(blend_shifts(state, s).w, 0.0f);
}

TEST(View, PowersAndFlashesColourThePicture) {
  Player p;
  p.state.hud.items = static_cast<std::int32_t>(kItemQuad);
  EXPECT_NEAR(p.look().tint.z, 1.0f, 1e-5f);
  p.state.hud.items = 0;
  bonus_flash(p.state);
  EXPECT_NEAR(p.look(0.25).tint.w, 50.0f / 255, 1e-5f);
  EXPECT_NEAR(p.look(0.25).tint.w, 25.0f / 255, 1e-5f);
  EXPECT_EQ(p.look(0.25).tint.w, 0.0f);
}

TEST(View, LiquidsColourThePicture) {
  Player p;
  formats::Bsp room = formats::testing::box_room(formats::BspVersion::kBsp29);
  EXPECT_EQ(calculate_view(p, p.memory, &room, 0.05).tint.w, 0.0f);
  room.leafs[1].contents = formats::kContentsLava;
  const View v = calculate_view(p, p.memory, &room, 0.05);
  EXPECT_NEAR(v.tint.w, 150.0f / 255, 1e-5f);
  EXPECT_NEAR(v.tint.y, 80.0f / 255, 1e-5f);
  EXPECT_EQ(v.tint_without_contents.w, 0.0f);
  p.state.hud.items = kItemSuit;
  EXPECT_NEAR(calculate_view(p, p.memory, &room, 0.05).tint_without_contents.w, 20.0f / 255, 1e-5f);
}

TEST(View, VolumesOfBrushModelsColourThePicture) {
  Player p;
  formats::Bsp room = formats::testing::box_room(formats::BspVersion::kBsp29);
  room.models.push_back(room.models[0]);
  p.state.model_names.resize(9);
  p.state.model_names[8] = "*2";
  p.state.entities.resize(3);
  Entity& volume = p.entity(2);
  volume.model = 8;
  volume.message_time = p.state.message_times[0];
  volume.origin = vec3(4000.0f, 0, 0);  // so that the eye is in what is solid of it
  volume.skin = 253;                    // -3, water, as a byte
  EXPECT_NEAR(calculate_view(p, p.memory, &room, 0.05).tint.w, 128.0f / 255, 1e-5f);
  volume.skin = 251;
  EXPECT_NEAR(calculate_view(p, p.memory, &room, 0.05).tint.w, 150.0f / 255, 1e-5f);
  volume.skin = 3;
  EXPECT_EQ(calculate_view(p, p.memory, &room, 0.05).tint.w, 0.0f);
  volume.skin = 253;
  volume.origin = vec3(0.0f);  // in its open part
  EXPECT_EQ(calculate_view(p, p.memory, &room, 0.05).tint.w, 0.0f);
  volume.origin = vec3(4000.0f, 0, 0);
  volume.message_time = 0.0;  // no longer told of
  EXPECT_EQ(calculate_view(p, p.memory, &room, 0.05).tint.w, 0.0f);
}

TEST(View, ChaseCameraStaysInTheRoom) {
  Player p;
  p.settings.chase_active = 1.0f;
  View v = p.look();
  EXPECT_NEAR(v.origin.x, -100.0f, 0.1f);
  EXPECT_NEAR(v.origin.z, 38.0f, 0.1f);
  EXPECT_FALSE(v.show_weapon);
  const formats::Bsp room = formats::testing::box_room(formats::BspVersion::kBsp29);
  p.entity(1).origin.x = -80.0f;
  v = calculate_view(p, p.memory, &room, 0.05);
  EXPECT_GT(v.origin.x, -128.0f);
}

}  // namespace
}  // namespace fb::cl
