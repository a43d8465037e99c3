// The arithmetic of input: shares of a frame, angles, moves, and the view's drift back to level.
#include "client/input/input.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "console/console.h"

namespace fb::cl {
namespace {

TEST(Button, KnowsWhichShareOfAFrameItWasDown) {
  Button b;
  EXPECT_EQ(b.share(), 0.0f);
  b.press(32);
  EXPECT_EQ(b.share(), 0.5f) << "went down";
  EXPECT_EQ(b.share(), 1.0f) << "held";
  b.release(32);
  EXPECT_EQ(b.share(), 0.0f) << "went up";
  EXPECT_EQ(b.share(), 0.0f);
  b.press(32);
  b.release(32);
  EXPECT_EQ(b.share(), 0.25f) << "a tap";
  b.press(32);
  (void)b.share();
  b.release(32);
  b.press(32);
  EXPECT_EQ(b.share(), 0.75f) << "let go and down again";
}

TEST(Button, IsHeldByTwoKeysAndRepeatsDoNotCount) {
  Button b;
  EXPECT_TRUE(b.press(1));
  EXPECT_TRUE(b.press(1));
  EXPECT_TRUE(b.press(2));
  EXPECT_FALSE(b.press(3)) << "three keys";
  b.release(3);
  b.release(1);
  EXPECT_TRUE(b.down());
  b.release(2);
  EXPECT_FALSE(b.down());
}

TEST(Button, TypedWithoutAKeyLetsGoOfEverything) {
  Button b;
  b.press(1);
  b.press(Button::kTyped);
  b.release_all();
  EXPECT_FALSE(b.down());
  EXPECT_FALSE(b.take_press()) << "as Quake: that it was pressed is forgotten, too";
  EXPECT_EQ(b.share(), 0.0f);
}

TEST(Button, ATapBetweenTwoMessagesIsSentOnce) {
  Button b;
  b.press(1);
  b.release(1);
  EXPECT_TRUE(b.take_press());
  EXPECT_FALSE(b.take_press());
}

struct Input : testing::Test {
  Buttons b;
  InputSettings s;
  vec3 angles{0.0f};
  UserMove pending;
  // Down for the whole of what follows.
  static void hold(Button& button) {
    button.press(1);
    (void)button.share();
  }
};

TEST_F(Input, KeysTurn) {
  hold(b.left);
  EXPECT_FALSE(adjust_angles(b, s, 0.1, angles)) << "yaw does not end the pitch's drift";
  EXPECT_NEAR(angles.y, 14.0f, 360.0f / 65536.0f);
  hold(b.speed);
  angles = vec3(0.0f);
  adjust_angles(b, s, 0.1, angles);
  EXPECT_NEAR(angles.y, 21.0f, 360.0f / 65536.0f);
  s.always_run = 1.0f;
  angles = vec3(0.0f);
  adjust_angles(b, s, 0.1, angles);
  EXPECT_NEAR(angles.y, 14.0f, 360.0f / 65536.0f) << "with cl_alwaysrun +speed walks";
}

TEST_F(Input, YawIsKeptInQuakesSteps) {
  angles.y = 10.003f;  // 1820.99 steps
  adjust_angles(b, s, 0.1, angles);
  EXPECT_EQ(angles.y, static_cast<float>(1820 * 360.0 / 65536.0)) << "cut, not rounded";
  angles.y = -90.0f;
  adjust_angles(b, s, 0.1, angles);
  EXPECT_EQ(angles.y, 270.0f);
  angles.y = std::numeric_limits<float>::infinity();
  adjust_angles(b, s, 0.1, angles);
  EXPECT_EQ(angles.y, 0.0f);
}

TEST_F(Input, LookingEndsWhereTheCvarsSay) {
  hold(b.look_down);
  EXPECT_TRUE(adjust_angles(b, s, 0.1, angles));
  EXPECT_FLOAT_EQ(angles.x, 15.0f);
  adjust_angles(b, s, 10.0, angles);
  EXPECT_EQ(angles.x, 90.0f);
  s.max_pitch = 80.0f;
  adjust_angles(b, s, 0.0, angles);
  EXPECT_EQ(angles.x, 80.0f);
}

TEST_F(Input, KlookLooksWithTheKeysOfWalking) {
  hold(b.key_look);
  hold(b.forward);
  EXPECT_TRUE(adjust_angles(b, s, 0.1, angles));
  EXPECT_FLOAT_EQ(angles.x, -15.0f);
  EXPECT_EQ(base_move(b, s).forward, 0.0f);
}

TEST_F(Input, StrafeMakesTurnsSteps) {
  hold(b.strafe);
  hold(b.right);
  adjust_angles(b, s, 0.1, angles);
  EXPECT_EQ(angles.y, 0.0f);
  EXPECT_EQ(base_move(b, s).side, 350.0f);
}

TEST_F(Input, MovesAddUp) {
  hold(b.forward);
  hold(b.move_left);
  hold(b.move_up);
  hold(b.speed);
  const UserMove move = base_move(b, s);
  EXPECT_EQ(move.forward, 400.0f);
  EXPECT_EQ(move.side, -700.0f);
  EXPECT_EQ(move.up, 400.0f);
  hold(b.back);
  EXPECT_EQ(base_move(b, s).forward, 0.0f);
}

TEST_F(Input, TheMouseTurnsAndWithMlookLooks) {
  EXPECT_FALSE(apply_mouse(b, s, {10, 20}, angles, pending));
  EXPECT_FLOAT_EQ(angles.y, -10 * 3 * 0.022f);
  EXPECT_EQ(angles.x, 0.0f);
  EXPECT_FLOAT_EQ(pending.forward, -60.0f) << "without +mlook it walks";
  hold(b.mouse_look);
  pending = {};
  EXPECT_TRUE(apply_mouse(b, s, {0, 20}, angles, pending));
  EXPECT_FLOAT_EQ(angles.x, 20 * 3 * 0.022f);
  EXPECT_EQ(pending.forward, 0.0f);
  s.mouse_pitch = -0.022f;
  apply_mouse(b, s, {0, 20}, angles, pending);
  EXPECT_NEAR(angles.x, 0.0f, 1e-6f) << "inverted";
  EXPECT_FALSE(apply_mouse(b, s, {0, 0}, angles, pending)) << "a mouse that rests looks nowhere";
}

TEST_F(Input, TheMouseStepsAsideWithStrafeOrLookstrafe) {
  hold(b.strafe);
  apply_mouse(b, s, {10, 0}, angles, pending);
  EXPECT_FLOAT_EQ(pending.side, 24.0f);
  EXPECT_EQ(angles.y, 0.0f);
  b.strafe.release_all();
  hold(b.mouse_look);
  s.look_strafe = 1.0f;
  apply_mouse(b, s, {10, 0}, angles, pending);
  EXPECT_FLOAT_EQ(pending.side, 48.0f);
}

TEST_F(Input, AMoveSaysEverythingOnce) {
  b.attack.press(1);
  b.jump.press(2);
  b.jump.release(2);
  b.impulse = 7;
  hold(b.forward);
  pending.forward = 0.9f;
  net::clc::Move move = make_move(b, s, pending, {1, 2, 3}, 5.5);
  EXPECT_EQ(move.time, 5.5f);
  EXPECT_EQ(move.view_angles, vec3(1, 2, 3));
  EXPECT_EQ(move.forward, 200) << "cut, as C casts";
  EXPECT_EQ(move.buttons, 3);
  EXPECT_EQ(move.impulse, 7);
  move = make_move(b, s, {}, {1, 2, 3}, 5.6);
  EXPECT_EQ(move.buttons, 1) << "attack is still held, the jump was a tap";
  EXPECT_EQ(move.impulse, 0);
  s.forward_speed = 1e9f;
  EXPECT_EQ(make_move(b, s, {}, {}, 0.0).forward, 32767);
  s.forward_speed = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(make_move(b, s, {}, {}, 0.0).forward, 0);
}

TEST_F(Input, ThePitchDriftsToTheSlopeUntilSomebodySteers) {
  PitchDrift drift;
  PitchDrift::Moment moment{0.05, 1.0, true, 0.0f, -10.0f};
  float pitch = 0.0f, before = 0.0f;
  for (int i = 0; i < 20; ++i) {
    before = pitch;
    drift.advance(moment, s, pitch);
    EXPECT_LE(pitch, before);
  }
  EXPECT_EQ(pitch, -10.0f);
  pitch = 30.0f;
  drift.stop(1.0);
  for (int i = 0; i < 20; ++i) drift.advance(moment, s, pitch);
  EXPECT_EQ(pitch, 30.0f);
  drift.start(1.0, s);
  drift.advance(moment, s, pitch);
  EXPECT_EQ(pitch, 30.0f) << "not at the very moment in which it was steered";
  drift.start(2.0, s);
  drift.advance(moment, s, pitch);
  EXPECT_FLOAT_EQ(pitch, 30.0f - 0.05f * 500.0f);
  moment.on_ground = false;
  drift.advance(moment, s, pitch);
  moment.on_ground = true;
  before = pitch;
  drift.advance(moment, s, pitch);
  EXPECT_EQ(pitch, before) << "in the air it stands still, and begins anew from rest";
}

TEST_F(Input, LookspringLevelsWhoWalks) {
  PitchDrift drift;
  PitchDrift::Moment walking{0.05, 3.0, true, 200.0f, 0.0f};
  float pitch = 20.0f;
  drift.stop(1.0);
  for (int i = 0; i < 40; ++i) drift.advance(walking, s, pitch);
  EXPECT_EQ(pitch, 20.0f) << "only with lookspring";
  s.look_spring = 1.0f;
  for (int i = 0; i < 40; ++i) drift.advance(walking, s, pitch);
  EXPECT_EQ(pitch, 0.0f);
}

TEST(InputSettings, AreReadFromTheirCvars) {
  con::Console console;
  register_input_cvars(console);
  const InputSettings initial = read_input_settings(console);
  EXPECT_EQ(initial.forward_speed, 200.0f);
  EXPECT_EQ(initial.mouse_yaw, 0.022f);
  console.execute("cl_forwardspeed 400; m_pitch -0.022");
  EXPECT_EQ(read_input_settings(console).forward_speed, 400.0f);
  EXPECT_EQ(read_input_settings(console).mouse_pitch, -0.022f);
}

}  // namespace
}  // namespace fb::cl
