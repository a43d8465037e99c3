// Players: running, jumping, stairs, swimming, against formulas worked out frame by frame in double.
#include <algorithm>
#include <cmath>

#include "server/simulation/test_level.h"
#include "server/simulation/test_things.h"
#include "server/simulation/user.h"

namespace fb::sv {
namespace {

using testing::LevelTest;
using testing::MapBuilder;

constexpr float kGap = 1.0f / 32.0f;

constexpr const char* kPlayer = R"(
float jump;
void() PlayerPreThink = {
  if (jump) if (self.flags - (self.flags & FL_ONGROUND) != self.flags) {
    self.flags = self.flags - FL_ONGROUND;
    self.velocity_z = self.velocity_z + 270;
    jump = 0;
  }
};
)";

class PlayerTest : public LevelTest {
 protected:
  static MapBuilder room() { return MapBuilder(vec3(-1024, -1024, 0), vec3(1024, 1024, 1024)); }
  // A player that stands at (0, 0), or at `where`.
  void start_in(const MapBuilder& map, const std::string& where = "0 0 24.03125") {
    start_level(testing::kThingsSource + (kPlayer + fmt::format("void() main = {{ make_player('{}'); }};", where)),
                map);
  }
  void frame(const UserCommand& command, double seconds) {
    level().frame_time = seconds;
    client_think(level(), EdictId{1}, command);
    tick(seconds);
  }
  void frames(const UserCommand& command, double seconds, int count) {
    for (int i = 0; i < count; ++i) frame(command, seconds);
  }
  vec3 place() { return origin("player"); }
  vec3 speed() { return velocity("player"); }
  Edict player() { return named("player"); }
  void look(float pitch, float yaw) { player().set(fields::v_angle, vec3(pitch, yaw, 0)); }
};

constexpr UserCommand kNothing{}, kForward{400, 0, 0};

// --- on the ground ---

// Frame by frame: friction of at least that of 100 units a second, then 10 times a frame's share of 320.
TEST_F(PlayerTest, RunningAndStoppingFollowTheDiscreteFormula) {
  start_in(room());
  constexpr double kDt = 1.0 / 72.0;
  frames(kNothing, kDt, 2);
  double expected = 0.0, way = 0.0;
  const auto rub = [&] { expected -= std::min(expected, kDt * std::max(expected, 100.0) * 4.0); };
  for (int i = 0; i < 100; ++i) {
    frame(kForward, kDt);
    rub();
    expected += std::min(10.0 * kDt * 320.0, 320.0 - expected);
    way += expected * kDt;
    ASSERT_NEAR(speed().x, expected, 1e-3) << i;
    ASSERT_NEAR(place().x, way, 1e-2) << i;
  }
  EXPECT_NEAR(expected, 320.0, 1e-9);
  for (int i = 0; i < 30; ++i) {
    frame(kNothing, kDt);
    rub();
    ASSERT_NEAR(speed().x, expected, 1e-2) << i;
  }
  frames(kNothing, kDt, 30);
  EXPECT_EQ(speed().x, 0.0f);
  EXPECT_FLOAT_EQ(place().z, 24.0f + kGap);
  EXPECT_TRUE(on_ground("player"));
}

TEST_F(PlayerTest, FrictionIsDoubleAtTheEdgeOfADrop) {
  MapBuilder map = room();
  map.box(vec3(-1024, -1024, 0), vec3(0, 1024, 64));
  for (const bool at_edge : {false, true}) {
    start_in(map, at_edge ? "-10 0 88.03125" : "-200 0 88.03125");
    frames(kNothing, 0.05, 2);
    player().set(fields::velocity, vec3(100, 0, 0));
    level().frame_time = 0.05;
    client_think(level(), EdictId{1}, kNothing);
    EXPECT_NEAR(speed().x, 100.0f - 0.05f * 100.0f * (at_edge ? 8.0f : 4.0f), 1e-4f);
  }
}

TEST_F(PlayerTest, MaxSpeedIsThatOfTheCvarInEveryDirection) {
  start_in(room());
  console_.execute("sv_maxspeed 200");
  look(0, 30);
  frames({400, 300, 0}, 0.05, 40);
  EXPECT_NEAR(glm::length(speed()), 200.0f, 0.1f);
}

// Gravity counts before the way: the top is after floor(270 / (800 dt)) frames, lower with long frames.
TEST_F(PlayerTest, JumpsAsHighAsTheDiscreteFormula) {
  for (const double dt : {1.0 / 72.0, 0.05, 0.1}) {
    start_in(room());
    frames(kNothing, dt, 3);
    level().vm->set(level().vm->program().global<float>("jump"), 1.0f);
    float top = 0.0f;
    for (double t = 0.0; t < 1.0; t += dt) {
      frame(kNothing, dt);
      top = std::max(top, place().z);
    }
    double expected = 24.0 + 1.0 / 32.0;
    for (double speed = 270.0 - 800.0 * dt; speed > 0.0; speed -= 800.0 * dt) expected += speed * dt;
    EXPECT_NEAR(top, expected, 1e-2) << dt;
    frames(kNothing, dt, 20);
    EXPECT_TRUE(on_ground("player"));
    EXPECT_FLOAT_EQ(place().z, 24.0f + kGap);
  }
}

TEST_F(PlayerTest, StepsUpToEighteenAreClimbed) {
  for (const float height : {8.0f, 18.0f, 19.0f}) {
    MapBuilder map = room();
    map.box(vec3(100, -1024, 0), vec3(1024, 1024, height));
    start_in(map);
    frames(kForward, 0.05, 40);
    if (height <= 18.0f) {
      EXPECT_GT(place().x, 200.0f) << height;
      EXPECT_NEAR(place().z, 24.0f + height, 0.1f) << height;
    } else {
      EXPECT_NEAR(place().x, 84.0f, 0.1f) << height;
    }
  }
}

TEST_F(PlayerTest, NoStairsWithSvNostepNorWhileFalling) {
  MapBuilder map = room();
  map.box(vec3(100, -1024, 0), vec3(1024, 1024, 16));
  start_in(map);
  console_.execute("sv_nostep 1");
  frames(kForward, 0.05, 40);
  EXPECT_NEAR(place().x, 84.0f, 0.1f);
  console_.execute("sv_nostep 0");
  start_in(map, "80 0 34");  // 10 above the floor
  player().set(fields::velocity, vec3(300, 0, 0));
  frame(kNothing, 0.05);
  EXPECT_NEAR(place().x, 84.0f, 0.1f);
}

TEST_F(PlayerTest, SlopesAreFloorsUpToANormalOfSevenTenths) {
  for (const float height : {150.0f, 250.0f}) {  // 37 and 51 degrees
    MapBuilder map = room();
    map.ramp(vec3(100, -1024, 0), vec3(300, 1024, height));
    map.box(vec3(300, -1024, 0), vec3(1024, 1024, height));
    start_in(map);
    frames(kForward, 0.05, 60);
    if (height < 200.0f) {
      EXPECT_GT(place().x, 300.0f);
      EXPECT_NEAR(place().z, 24.0f + height, 0.1f);
    } else {
      EXPECT_LT(place().z, 24.0f + 60.0f);
    }
  }
}

// Who looks at the wall keeps only what friction leaves; who looks along it keeps its speed.
TEST_F(PlayerTest, LookingAtAWallSlowsTheSlideAlongIt) {
  MapBuilder map = room();
  map.box(vec3(16, -1024, 0), vec3(1024, 1024, 512));
  float way[2] = {};
  for (const bool at_wall : {false, true}) {
    start_in(map, "-0.5 0 24.03125");
    frames(kNothing, 0.05, 2);
    look(0, at_wall ? 10.0f : 80.0f);
    player().set(fields::velocity, vec3(200, 200, 0));
    tick(0.05, 1);
    way[at_wall ? 1 : 0] = speed().y;
  }
  EXPECT_FLOAT_EQ(way[0], 200.0f);
  EXPECT_NEAR(way[1], 200.0 * (1.0 + 0.5 - std::cos(10.0 * 3.14159265358979 / 180.0)), 1e-2);
}

// --- in the air ---

TEST_F(PlayerTest, InTheAirAWishCountsForThirtyAtMost) {
  start_in(room(), "0 0 800");
  player().set(fields::velocity, vec3(300, 0, 0));
  look(0, 90);
  frames(kForward, 0.05, 10);
  EXPECT_NEAR(speed().x, 300.0f, 1e-2f);
  EXPECT_NEAR(speed().y, 30.0f, 1e-2f);
}

TEST_F(PlayerTest, FlyingKeepsItsHeightAndTakesTheWishUpwards) {
  start_in(room(), "0 0 500");
  player().set(fields::movetype, static_cast<float>(kMoveFly));
  frames(kNothing, 0.05, 4);
  EXPECT_EQ(place().z, 500.0f);
  frames({0, 0, 200}, 0.05, 4);
  EXPECT_GT(place().z, 501.0f);
}

TEST_F(PlayerTest, NoclipFliesWhereOneLooks) {
  start_in(room(), "0 0 500");
  player().set(fields::movetype, static_cast<float>(kMoveNoClip));
  look(90, 0);  // down
  frame({200, 0, 0}, 0.1);
  EXPECT_NEAR(place().z, 480.0f, 1e-2f);
  frame({0, 0, 100}, 0.1);  // doubled
  EXPECT_NEAR(place().z, 500.0f, 1e-2f);
  console_.execute("sv_altnoclip 0");
  frame({0, 0, 100}, 0.1);
  EXPECT_NEAR(place().z, 510.0f, 1e-2f);
}

// --- water ---

MapBuilder pool() {
  MapBuilder map(vec3(-1024, -1024, 0), vec3(1024, 1024, 1024));
  map.box(vec3(-1024, -1024, 0), vec3(1024, 1024, 400), formats::kContentsWater);
  return map;
}

TEST_F(PlayerTest, WaterLevelIsOfFeetWaistAndEyes) {
  start_in(pool());
  const std::pair<float, float> cases[] = {{430, 0}, {420, 1}, {396, 1}, {390, 2}, {379, 2}, {370, 3}};
  for (const auto& [z, wet] : cases) {
    player().set(fields::origin, vec3(0, 0, z));
    player().set(fields::velocity, vec3(0.0f));
    tick(0.0001);
    EXPECT_EQ(player().get(fields::waterlevel), wet) << z;
    EXPECT_EQ(player().get(fields::watertype), wet > 0 ? -3.0f : -1.0f) << z;
  }
}

// 60 units a second downwards, of which 0.7 count, after friction of the whole speed.
TEST_F(PlayerTest, WhoDoesNothingSinks) {
  start_in(pool(), "0 0 300");
  constexpr double kDt = 0.05;
  frame(kNothing, kDt);
  player().set(fields::velocity, vec3(0.0f));
  double expected = 0.0;
  for (int i = 0; i < 30; ++i) {
    frame(kNothing, kDt);
    expected -= std::min(expected, kDt * expected * 4.0);
    expected += std::min(10.0 * 42.0 * kDt, 42.0 - expected);
    ASSERT_NEAR(speed().z, -expected, 1e-3) << i;
  }
  const float deep = place().z;
  frames({0, 0, 200}, kDt, 20);
  EXPECT_GT(place().z, deep);
}

TEST_F(PlayerTest, AJumpOutOfWaterGoesItsWayUntilItsTimeIsOver) {
  start_in(pool(), "0 0 300");
  player().add_flag(fields::flags, kFlagWaterJump);
  player().set(fields::teleport_time, 1.15f);
  player().set(fields::movedir, vec3(50, -30, 0));
  player().set(fields::waterlevel, 2.0f);
  frame(kForward, 0.1);
  EXPECT_EQ(speed().x, 50.0f);
  EXPECT_EQ(speed().y, -30.0f);
  EXPECT_TRUE(player().has_flag(fields::flags, kFlagWaterJump));
  frames(kForward, 0.1, 2);
  EXPECT_FALSE(player().has_flag(fields::flags, kFlagWaterJump));
  EXPECT_EQ(player().get(fields::teleport_time), 0.0f);
}

// --- bodies and order ---

TEST_F(PlayerTest, BodiesTurnByAThirdOfThePitchAndLean) {
  start_in(room());
  look(30, 45);
  player().set(fields::velocity, vec3(0, -100, 0));  // to the right
  client_think(level(), EdictId{1}, kNothing);
  const vec3 angles = player().get(fields::angles);
  EXPECT_FLOAT_EQ(angles.x, -10.0f);
  EXPECT_FLOAT_EQ(angles.y, 45.0f);
  EXPECT_NEAR(angles.z, 4.0f * 100.0f * 2.0f / 200.0f, 1e-4f);
  player().set(fields::fixangle, 1.0f);
  look(0, 0);
  client_think(level(), EdictId{1}, kNothing);
  EXPECT_FLOAT_EQ(player().get(fields::angles).y, 45.0f);
}

TEST_F(PlayerTest, KicksOfTheViewDropByTenDegreesASecond) {
  start_in(room());
  player().set(fields::punchangle, vec3(-3, 4, 0));
  level().frame_time = 0.1;
  client_think(level(), EdictId{1}, kNothing);
  EXPECT_NEAR(glm::length(player().get(fields::punchangle)), 4.0f, 1e-5f);
  player().set(fields::health, 0.0f);
  for (int i = 0; i < 10; ++i) client_think(level(), EdictId{1}, kForward);
  EXPECT_EQ(player().get(fields::punchangle), vec3(0.0f));
  EXPECT_EQ(speed(), vec3(0.0f));  // the dead do not walk
}

TEST_F(PlayerTest, NobodyWalksBackIntoATeleporter) {
  start_in(room());
  frames(kNothing, 0.05, 2);
  player().set(fields::teleport_time, 2.0f);
  frames({-400, 0, 0}, 0.05, 4);
  EXPECT_EQ(place().x, 0.0f);
  player().set(fields::teleport_time, 0.0f);
  frames({-400, 0, 0}, 0.05, 4);
  EXPECT_LT(place().x, -1.0f);
}

TEST_F(PlayerTest, WhoIsStuckGoesBackOrUp) {
  MapBuilder map = room();
  map.box(vec3(100, -100, 0), vec3(300, 100, 200));
  start_in(map);
  tick(0.05, 2);
  player().set(fields::origin, vec3(200, 0, 50));
  tick(0.05);
  EXPECT_EQ(place().x, 0.0f);
  start_in(map);
  player().set(fields::oldorigin, vec3(200, 0, 100));
  player().set(fields::origin, vec3(0, 0, 15));  // 9 deep in the floor
  tick(0.05);
  EXPECT_EQ(place().x, -1.0f);
  EXPECT_NEAR(place().z, 25.0f, 1.1f);
}

TEST_F(PlayerTest, PreThinkThinkPostThinkAndOnlyOfThoseWhoPlay) {
  start_level(std::string(R"(
entity player;
void() PlayerPreThink = { puts("pre"); pute(self); put(time); };
void() PlayerPostThink = { puts("post"); pute(self); put(self.origin_x); };
void() say = { puts("think"); put(self.origin_x); };
void() main = {
  player = nextent(world);
  player.movetype = MOVETYPE_NOCLIP;
  player.velocity = '100 0 0';
  player.think = say;
  player.nextthink = 1.1;
};)"),
              room());
  tick(0.25);
  EXPECT_EQ(output(), "[pre] e1 1 [think] 0 [post] e1 25");
  client_is_active_ = false;
  clear_output();
  tick(0.25);
  EXPECT_EQ(output(), "");
}

TEST_F(PlayerTest, TheIdealPitchFollowsStairs) {
  MapBuilder map = room();
  for (int i = 0; i < 12; ++i) map.box(vec3(20 + i * 12, -1024, 0), vec3(1024, 1024, 4 * (i + 1)));
  start_in(map);
  tick(0.05, 2);
  set_ideal_pitch(level(), EdictId{1});
  EXPECT_FLOAT_EQ(player().get(fields::idealpitch), -4.0f * 0.8f);
  player().set(fields::angles, vec3(0, 180, 0));
  set_ideal_pitch(level(), EdictId{1});
  EXPECT_EQ(player().get(fields::idealpitch), 0.0f);
}

}  // namespace
}  // namespace fb::sv
