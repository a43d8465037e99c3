#include "client/input/sticks.h"

#include <gtest/gtest.h>

#include "console/console.h"

namespace fb::cl {
namespace {

TEST(Sticks, DeadZonesAndExponent) {
  EXPECT_EQ(shape_stick({0.17f, 0.0f}, 0.175f, 0.02f, 2.0f), vec2(0.0f));
  EXPECT_EQ(shape_stick(vec2(0.0f), 0.0f, 0.0f, 2.0f), vec2(0.0f));
  EXPECT_NEAR(glm::length(shape_stick({0.99f, 0.0f}, 0.175f, 0.02f, 2.0f)), 1.0f, 1e-6f) << "the outer threshold";
  EXPECT_NEAR(glm::length(shape_stick({1.0f, 1.0f}, 0.175f, 0.02f, 2.0f)), 1.0f, 1e-6f) << "corners are no faster";
  // Half way between the dead zone and the rim: a quarter, by the square.
  EXPECT_NEAR(shape_stick({0.0f, 0.6f}, 0.2f, 0.0f, 2.0f).y, 0.25f, 1e-5f);
  const vec2 slanted = shape_stick({0.4f, -0.4f}, 0.1f, 0.0f, 1.5f);
  EXPECT_FLOAT_EQ(slanted.x, -slanted.y) << "the direction stays";
}

TEST(Sticks, LookTurnsByTime) {
  const StickSettings settings;
  const InputSettings input;
  Sticks sticks;
  sticks.right = {1.0f, 0.0f};
  vec3 angles(0.0f);
  EXPECT_FALSE(apply_look_stick(sticks, settings, input, 0.5, angles));
  EXPECT_FLOAT_EQ(angles.y, -120.0f) << "to the right, 240 degrees a second";
  sticks.right = {0.0f, 1.0f};
  EXPECT_TRUE(apply_look_stick(sticks, settings, input, 0.5, angles));
  EXPECT_FLOAT_EQ(angles.x, 65.0f) << "towards the player looks down";
  apply_look_stick(sticks, settings, input, 5.0, angles);
  EXPECT_FLOAT_EQ(angles.x, 90.0f) << "cl_maxpitch";
  StickSettings inverted;
  inverted.invert = inverted.swap = 1.0f;
  angles = vec3(0.0f);
  EXPECT_FALSE(apply_look_stick(sticks, inverted, input, 0.5, angles)) << "the left stick looks now";
  sticks.left = {0.0f, 1.0f};
  EXPECT_TRUE(apply_look_stick(sticks, inverted, input, 0.5, angles));
  EXPECT_FLOAT_EQ(angles.x, -65.0f);
}

TEST(Sticks, MoveWalksAndRuns) {
  const StickSettings settings;
  const InputSettings input;
  Sticks sticks;
  sticks.left = {0.0f, -1.0f};
  EXPECT_FLOAT_EQ(stick_move(sticks, settings, input, false).forward, 200.0f);
  EXPECT_FLOAT_EQ(stick_move(sticks, settings, input, true).forward, 400.0f);
  sticks.left = {1.0f, 0.0f};
  EXPECT_FLOAT_EQ(stick_move(sticks, settings, input, false).side, 225.0f);
  StickSettings off;
  off.enable = 0.0f;
  EXPECT_EQ(stick_move(sticks, off, input, true).side, 0.0f);
}

TEST(Sticks, CvarsAreQuakeSpasms) {
  con::Console console;
  register_stick_cvars(console);
  console.execute("joy_sensitivity_yaw 100; joy_deadzone_move 7");
  EXPECT_EQ(read_stick_settings(console).yaw_speed, 100.0f);
  EXPECT_EQ(read_stick_settings(console).dead_move, 0.9f);
}

TEST(Gyro, TurnsTheViewAsFarAsItWasTurnedItself) {
  StickSettings settings;
  const InputSettings input;
  Sticks sticks;
  sticks.turned = {4.0f, 10.0f, -2.0f};
  vec3 angles(0.0f);
  EXPECT_TRUE(apply_gyro(sticks, settings, input, false, 0.1, angles));
  EXPECT_EQ(angles, vec3(-10.0f, 25.0f, 0.0f)) << "up and to the left, 2.5 times";
  settings.gyro_axis = 1.0f;
  angles = vec3(0.0f);
  apply_gyro(sticks, settings, input, false, 0.1, angles);
  EXPECT_EQ(angles.y, -5.0f) << "leaning over to the right turns";
  sticks.turned = {0.1f, 0.1f, 0.0f};
  angles = vec3(0.0f);
  EXPECT_FALSE(apply_gyro(sticks, settings, input, false, 0.1, angles));
  EXPECT_EQ(angles, vec3(0.0f)) << "1.4 degrees a second are noise";
}

TEST(Gyro, CountsAsItsActionSays) {
  StickSettings settings;
  Sticks sticks;
  sticks.turned = {0.0f, 1.0f, 0.0f};
  const auto turns = [&](float mode, bool action) {
    vec3 angles(0.0f);
    settings.gyro_mode = mode;
    apply_gyro(sticks, settings, InputSettings(), action, 0.1, angles);
    return angles.y != 0.0f;
  };
  EXPECT_TRUE(turns(0.0f, false) && turns(0.0f, true));
  EXPECT_TRUE(!turns(1.0f, false) && turns(1.0f, true));
  EXPECT_TRUE(turns(2.0f, false) && !turns(2.0f, true));
  settings.gyro = 0.0f;
  EXPECT_FALSE(turns(0.0f, false));
}

}  // namespace
}  // namespace fb::cl
