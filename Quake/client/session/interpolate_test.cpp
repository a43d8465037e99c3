#include "client/session/interpolate.h"

#include <gtest/gtest.h>

#include "client/session/test_session.h"

namespace fb::cl {
namespace {

using test::ToldSession;
using test::update;
namespace svc = net::svc;

// Two messages a tenth of a second apart, entity 2 told of in both.
struct TwoMessages : ToldSession {
  TwoMessages(const vec3& from, const vec3& to, std::uint32_t bits = 0, const vec3& from_angles = vec3(0.0f),
              const vec3& to_angles = vec3(0.0f))
      : ToldSession({666, 0}) {
    tell({svc::Time{1.0f}, update(2, 3, from, from_angles, bits)});
    state.time = 1.0;
    next_frame();
    place_entities(*this);
    tell({svc::Time{1.1f}, update(2, 3, to, to_angles, bits)});
  }
  void next_frame() {
    ++frame;
    relink(*this, true, false);
  }
  // Goes to a time, moves, and places.
  const Entity& at(double time) {
    state.old_time = state.time;
    state.time = time;
    next_frame();
    place_entities(*this);
    return entity(2);
  }
};

TEST(Interpolate, LerpPoint) {
  ClientState s;
  s.message_times = {2.0, 1.9};
  s.time = 1.95;
  EXPECT_NEAR(lerp_point(s, false, false), 0.5f, 1e-5f);
  EXPECT_EQ(s.time, 1.95);
  EXPECT_EQ(lerp_point(s, false, true), 1.0f);
  EXPECT_EQ(lerp_point(s, true, false), 1.0f);
  EXPECT_EQ(s.time, 2.0) << "a timedemo shows the latest message";
  s.time = 5.0;
  EXPECT_EQ(lerp_point(s, false, false), 1.0f);
  EXPECT_EQ(s.time, 2.0) << "time does not run away from the messages";
  s.time = 1.0;
  EXPECT_EQ(lerp_point(s, false, false), 0.0f);
  EXPECT_EQ(s.time, 1.9);
  s.message_times = {3.0, 1.0};  // a gap
  s.time = 2.95;
  EXPECT_NEAR(lerp_point(s, false, false), 0.5f, 1e-5f);
  EXPECT_NEAR(s.message_times[1], 2.9, 1e-9);
  s.message_times = {3.0, 3.0};
  EXPECT_EQ(lerp_point(s, false, false), 1.0f);
}

TEST(Interpolate, PlacesAndAnglesGoEvenlyTheShortWay) {
  TwoMessages s({0, 0, 0}, {10, 20, -30}, 0, {0, 157.5f, 0}, {0, -157.5f, 0});
  const Entity& e = s.at(1.05);
  EXPECT_NEAR(e.drawn_origin.x, 5.0f, 1e-3f);
  EXPECT_NEAR(e.drawn_origin.y, 10.0f, 1e-3f);
  EXPECT_NEAR(e.drawn_origin.z, -15.0f, 1e-3f);
  EXPECT_NEAR(e.drawn_angles.y, 180.0f, 1e-2f);
  EXPECT_NEAR(s.at(1.1).drawn_origin.x, 10.0f, 1e-3f);
}

TEST(Interpolate, FarJumpsAreTeleports) {
  TwoMessages s({0, 0, 0}, {101, 0, 0});
  const std::uint64_t before = s.entity(2).cut_frame;
  const Entity& e = s.at(1.05);
  EXPECT_EQ(e.drawn_origin, vec3(101, 0, 0));
  EXPECT_EQ(e.cut_frame, s.frame);
  EXPECT_GT(e.cut_frame, before);
  const std::uint64_t cut = e.cut_frame;
  s.at(1.08);
  EXPECT_EQ(s.entity(2).cut_frame, cut) << "it jumped once";
  TwoMessages near({0, 0, 0}, {99, 0, 0});
  EXPECT_NEAR(near.at(1.05).drawn_origin.x, 49.5f, 0.1f);
}

// Two messages in one frame: the jump is in the first.
TEST(Interpolate, JumpsBetweenEarlierMessagesAreSeenToo) {
  TwoMessages s({0, 0, 0}, {500, 0, 0});
  s.tell({svc::Time{1.2f}, update(2, 3, {504, 0, 0})});
  EXPECT_NEAR(s.at(1.15).drawn_origin.x, 502.0f, 0.1f);
  EXPECT_EQ(s.entity(2).cut_frame, s.frame);
  s.at(1.18);
  EXPECT_LT(s.entity(2).cut_frame, s.frame);
}

TEST(Interpolate, StepsTakeATenthOfASecond) {
  TwoMessages s({0, 0, 0}, {16, 0, 0}, net::kUpdateStep);
  // The step is noticed at 1.02 and takes until 1.12.
  EXPECT_NEAR(s.at(1.02).drawn_origin.x, 0.0f, 1e-3f);
  EXPECT_NEAR(s.at(1.07).drawn_origin.x, 8.0f, 1e-3f);
  s.tell({svc::Time{1.2f}, update(2, 3, {16, 0, 0}, vec3(0.0f), net::kUpdateStep)});
  EXPECT_NEAR(s.at(1.115).drawn_origin.x, 15.2f, 1e-2f);
  EXPECT_NEAR(s.at(1.13).drawn_origin.x, 16.0f, 1e-3f);

  TwoMessages off({0, 0, 0}, {16, 0, 0}, net::kUpdateStep);
  off.settings.r_lerpmove = 0.0f;
  EXPECT_EQ(off.at(1.02).drawn_origin.x, 16.0f);
}

TEST(Interpolate, LerpFinishSaysHowLongAStepTakes) {
  ToldSession s({666, 0});
  auto told = [&](float time, float x) {
    auto u = update(2, 3, {x, 0, 0}, vec3(0.0f), net::kUpdateStep | net::kUpdateLerpFinish);
    u.lerp_finish = 51;  // 0.2 s
    s.tell({svc::Time{time}, u});
    s.state.time = time;
    ++s.frame;
    relink(s, true, false);
    place_entities(s);
  };
  told(1.0f, 0.0f);
  told(1.1f, 16.0f);  // finishes at 1.3
  s.state.time = 1.2;
  place_entity(s.entity(2), s.state.time, true);
  EXPECT_NEAR(s.entity(2).drawn_origin.x, 8.0f, 0.01f);
}

TEST(Interpolate, PosesBlend) {
  ToldSession s;
  Entity e;
  e.lerp_flags = kLerpResetAnim;
  e.frame = 0;
  const scene::Model& m = s.known[2];
  animate_entity(e, m, 1.0, true);
  EXPECT_EQ(e.drawn_pose, (scene::PoseBlend{0, 0, 0.0f}));
  e.frame = 1;
  animate_entity(e, m, 1.0, true);
  EXPECT_EQ(e.drawn_pose, (scene::PoseBlend{0, 1, 0.0f}));
  animate_entity(e, m, 1.05, true);
  EXPECT_EQ(e.drawn_pose.a, 0u);
  EXPECT_EQ(e.drawn_pose.b, 1u);
  EXPECT_NEAR(e.drawn_pose.t, 0.5f, 1e-5f);
  animate_entity(e, m, 1.05, false);
  EXPECT_EQ(e.drawn_pose, (scene::PoseBlend{1, 1, 0.0f}));
  animate_entity(e, m, 2.0, true);
  EXPECT_EQ(e.drawn_pose.t, 1.0f);
  e.frame = 2;
  e.lerp_flags |= kLerpResetAnim;
  animate_entity(e, m, 2.05, true);
  EXPECT_EQ(e.drawn_pose, (scene::PoseBlend{2, 2, 0.0f}));
  EXPECT_EQ(e.lerp_flags, 0u);
  // A flash defers blending twice.
  e.lerp_flags |= kLerpResetAnim | kLerpResetAnim2;
  e.frame = 0;
  animate_entity(e, m, 2.1, true);
  EXPECT_EQ(e.drawn_pose, (scene::PoseBlend{0, 0, 0.0f}));
  e.frame = 1;
  animate_entity(e, m, 2.2, true);
  EXPECT_EQ(e.drawn_pose, (scene::PoseBlend{1, 1, 0.0f}));
  e.frame = 2;
  animate_entity(e, m, 2.3, true);
  EXPECT_EQ(e.drawn_pose.a, 1u);
  e.frame = 77;  // no such frame: the first
  animate_entity(e, m, 2.4, true);
  EXPECT_EQ(e.drawn_pose.b, 0u);
}

TEST(Interpolate, GroupsBlendOverTheirOwnInterval) {
  ToldSession s;
  Entity e;
  e.lerp_flags = kLerpResetAnim;
  e.frame = 3;
  animate_entity(e, s.known[2], 0.1, true);
  EXPECT_EQ(e.drawn_pose, (scene::PoseBlend{3, 3, 0.0f}));
  animate_entity(e, s.known[2], 0.2001, true);
  animate_entity(e, s.known[2], 0.3001, true);
  EXPECT_EQ(e.drawn_pose.a, 3u);
  EXPECT_EQ(e.drawn_pose.b, 4u);
  EXPECT_NEAR(e.drawn_pose.t, 0.5f, 1e-4f);
}

TEST(Interpolate, NoLerpList) {
  Settings s;
  EXPECT_TRUE(animates_smoothly(s, "progs/ogre.mdl"));
  EXPECT_FALSE(animates_smoothly(s, "progs/flame2.mdl"));
  s.r_lerpmodels = 2.0f;
  EXPECT_TRUE(animates_smoothly(s, "progs/flame2.mdl"));
  s.r_lerpmodels = 0.0f;
  EXPECT_FALSE(animates_smoothly(s, "progs/ogre.mdl"));
  EXPECT_EQ(split_names("a,,b,"), (std::vector<std::string>{"a", "b"}));
}

TEST(Interpolate, WhatIsNotToldOfIsGone) {
  TwoMessages s({0, 0, 0}, {1, 0, 0});
  s.at(1.05);
  EXPECT_TRUE(s.entity(2).visible);
  s.tell({svc::Time{1.2f}, update(1, 3, {0, 0, 0})});
  s.at(1.15);
  EXPECT_FALSE(s.entity(2).visible);
  EXPECT_EQ(s.entity(2).model, 0);
  // Back again, elsewhere: it stands there at once.
  s.tell({svc::Time{1.3f}, update(2, 3, {50, 0, 0})});
  EXPECT_EQ(s.at(1.25).drawn_origin, vec3(50, 0, 0));
  EXPECT_EQ(s.entity(2).cut_frame + 1, s.frame);
}

TEST(Interpolate, ViewAnglesAndVelocity) {
  ToldSession s;
  svc::ClientData d;
  d.velocity = {10, 0, 0};
  s.tell({svc::Time{1.0f}, d});
  d.velocity = {20, 0, 0};
  s.tell({svc::Time{1.1f}, d});
  s.state.message_view_angles = {vec3(10, -170, 0), vec3(0, 170, 0)};
  s.state.time = 1.05;
  relink(s, true, false);
  EXPECT_NEAR(s.state.velocity.x, 240.0f, 0.01f);
  EXPECT_NEAR(s.state.view_angles.x, 5.0f, 1e-3f);
  EXPECT_NEAR(s.state.view_angles.y, 180.0f, 1e-3f);
}

TEST(Interpolate, ItemsTurnAndRocketsTrail) {
  TwoMessages s({0, 0, 0}, {60, 0, 0});
  s.known[2].flags = formats::kMdlRotate | formats::kMdlRocket;
  const Entity& e = s.at(1.05);
  EXPECT_NEAR(e.drawn_angles.y, 105.0f, 1e-3f);
  EXPECT_EQ(s.effects.particles.particles().size(), 10u);  // every 3 of 30 units
  EXPECT_TRUE(s.effects.lights.lights()[0].lit(1.05));
  EXPECT_EQ(s.effects.lights.lights()[0].radius, 200.0f);
  EXPECT_NEAR(s.effects.lights.lights()[0].origin.x, 30.0f, 0.01f);
}

TEST(Interpolate, EffectsMakeLights) {
  ToldSession s;
  auto u = update(2, 3, {0, 0, 0}, {0, 90, 0}, net::kUpdateEffects);
  u.effects = kEffectMuzzleFlash;
  s.tell({svc::Time{1.0f}, u});
  s.state.time = 1.0;
  relink(s, true, false);
  const DynamicLight& flash = s.effects.lights.lights()[0];
  EXPECT_NEAR(flash.origin.y, 18.0f, 1e-3f);
  EXPECT_EQ(flash.origin.z, 16.0f);
  EXPECT_GE(flash.radius, 200.0f);
  EXPECT_LE(flash.radius, 231.0f);
  EXPECT_NEAR(flash.die, 1.1, 1e-9);
  EXPECT_TRUE(s.entity(2).lerp_flags & kLerpResetAnim2);
  u.effects = kEffectBrightField;
  s.tell({svc::Time{1.1f}, u});
  relink(s, true, false);
  EXPECT_EQ(s.effects.particles.particles().size(), 162u);
}

}  // namespace
}  // namespace fb::cl
