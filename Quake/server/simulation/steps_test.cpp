// Monsters' steps: stairs, edges, height of what flies and swims, and the ways around.
#include "server/simulation/steps.h"

#include <cmath>

#include "server/simulation/test_level.h"
#include "server/simulation/test_things.h"

namespace fb::sv {
namespace {

using testing::LevelTest;
using testing::MapBuilder;

constexpr const char* kMonster = R"(
entity ogre, goal;
entity(vector org, float how) make = {
  local entity e;
  e = make_man(MOVETYPE_STEP, org);
  e.solid = SOLID_SLIDEBOX;
  e.flags = FL_MONSTER + how;
  e.yaw_speed = 20;
  return e;
};
)";

class StepsTest : public LevelTest {
 protected:
  static MapBuilder room() { return MapBuilder(vec3(-1024, -1024, 0), vec3(1024, 1024, 512)); }
  void start_in(const MapBuilder& map, const std::string& main = "ogre = make('0 0 24.03125', FL_ONGROUND);") {
    start_level(testing::kThingsSource + (kMonster + fmt::format("void() main = {{ {} }};", main)), map);
  }
  EdictId ogre() { return named("ogre").id(); }
  bool walk(float yaw, float distance) { return walkmove(level(), ogre(), yaw, distance); }
  void put(const vec3& where) {
    named("ogre").set(fields::origin, where);
    link_edict(level(), ogre());
  }
};

TEST_F(StepsTest, WalkmoveGoesItsDistanceAlongItsYaw) {
  start_in(room());
  EXPECT_TRUE(walk(30, 10));
  EXPECT_NEAR(origin("ogre").x, 10.0 * std::cos(0.523598775), 1e-5);
  EXPECT_NEAR(origin("ogre").y, 5.0, 1e-5);
  EXPECT_FLOAT_EQ(origin("ogre").z, 24.03125f);
  EXPECT_EQ(named("ogre").get(fields::groundentity), EdictId::kWorld);
  named("ogre").remove_flag(fields::flags, kFlagOnGround);
  EXPECT_FALSE(walk(30, 10));  // it falls
}

TEST_F(StepsTest, StairsOfEighteenAreClimbedAndNearlyAsMuchGoneDown) {
  for (const float height : {17.0f, 18.0f, 19.0f}) {
    MapBuilder map = room();
    map.box(vec3(40, -1024, 0), vec3(1024, 1024, height));
    start_in(map);
    EXPECT_EQ(walk(0, 30), height <= 18.0f) << height;
    EXPECT_NEAR(origin("ogre").z, height <= 18.0f ? 24.03125f + height : 24.03125f, 1e-4f);
    // Downwards the 1/32 that monsters hover counts.
    put(vec3(100, 0, 24.03125f + height));
    EXPECT_EQ(walk(180, 100), height < 18.0f) << height;
  }
}

TEST_F(StepsTest, EdgesAreNotStepped) {
  MapBuilder map = room();
  map.box(vec3(-1024, -1024, 0), vec3(0, 1024, 64));
  start_in(map, "ogre = make('-40 0 88.03125', FL_ONGROUND);");
  EXPECT_TRUE(check_bottom(level(), ogre()));
  EXPECT_TRUE(walk(0, 20));
  EXPECT_FALSE(walk(0, 20));  // a corner would be above the drop
  EXPECT_EQ(origin("ogre").x, -20.0f);
  put(vec3(10, 0, 88.03125f));
  EXPECT_FALSE(check_bottom(level(), ogre()));
  // Whose ground was taken may go there, and falls where there is none.
  put(vec3(-20, 0, 88.03125f));
  named("ogre").add_flag(fields::flags, kFlagPartialGround);
  EXPECT_TRUE(walk(0, 20));
  EXPECT_TRUE(walk(0, 40));
  EXPECT_FALSE(on_ground("ogre"));
}

TEST_F(StepsTest, AStepWithinTheBoxIsFloorEnough) {
  MapBuilder map = room();
  map.box(vec3(0, -1024, 0), vec3(1024, 1024, 12));
  start_in(map, "ogre = make('0 0 36.03125', FL_ONGROUND);");
  EXPECT_TRUE(check_bottom(level(), ogre()));
}

TEST_F(StepsTest, UnderALowCeilingThePlaceItselfIsTried) {
  MapBuilder map = room();
  map.box(vec3(20, -1024, 60), vec3(1024, 1024, 512));
  start_in(map);
  EXPECT_TRUE(walk(0, 30));
  EXPECT_FLOAT_EQ(origin("ogre").x, 30.0f);
}

TEST_F(StepsTest, WallsAndOthersBlock) {
  start_in(room(), "ogre = make('0 0 24.03125', FL_ONGROUND); goal = make('60 0 24.03125', FL_ONGROUND);");
  EXPECT_FALSE(walk(0, 40));
  EXPECT_TRUE(walk(90, 40));
}

TEST_F(StepsTest, FliersGoTowardsTheirEnemysHeight) {
  start_in(room(), R"(
    ogre = make('0 0 300', FL_FLY);
    goal = make('400 0 100', 0);
    ogre.enemy = goal;)");
  EXPECT_TRUE(walk(0, 10));
  EXPECT_EQ(origin("ogre"), vec3(10, 0, 292));
  named("goal").set(fields::origin, vec3(400, 0, 400));
  EXPECT_TRUE(walk(0, 10));
  EXPECT_EQ(origin("ogre"), vec3(20, 0, 300));
  named("goal").set(fields::origin, vec3(400, 0, 265));  // 35 below: high enough
  EXPECT_TRUE(walk(0, 10));
  EXPECT_EQ(origin("ogre"), vec3(30, 0, 300));
  // At the ceiling it goes on level.
  put(vec3(30, 0, 479));
  named("goal").set(fields::origin, vec3(400, 0, 480));
  EXPECT_TRUE(walk(0, 10));
  EXPECT_EQ(origin("ogre"), vec3(40, 0, 479));
}

TEST_F(StepsTest, SwimmersStayInTheWater) {
  MapBuilder map = room();
  map.box(vec3(-1024, -1024, 0), vec3(20, 1024, 200), formats::kContentsWater);
  start_in(map, "ogre = make('0 0 100', FL_SWIM);");
  EXPECT_TRUE(walk(0, 15));
  EXPECT_FALSE(walk(0, 15));
  EXPECT_EQ(origin("ogre").x, 15.0f);
}

// To the left of its ideal yaw it waits; to the right it walks sideways, as the difference is negative there.
TEST_F(StepsTest, AStepWaitsForTheTurnOnOneSide) {
  start_in(room());
  named("ogre").set(fields::angles, vec3(0, 200, 0));
  EXPECT_TRUE(step_direction(level(), ogre(), 90.0f, 10.0f));
  EXPECT_EQ(origin("ogre").y, 0.0f);
  EXPECT_NEAR(named("ogre").get(fields::angles).y, 180.0f, 0.01f);
  named("ogre").set(fields::angles, vec3(0, 0, 0));
  EXPECT_TRUE(step_direction(level(), ogre(), 90.0f, 10.0f));
  EXPECT_NEAR(origin("ogre").y, 10.0f, 1e-4f);
  EXPECT_NEAR(named("ogre").get(fields::angles).y, 20.0f, 0.01f);
}

TEST_F(StepsTest, ChaseTriesTheDiagonalFirst) {
  const std::pair<vec3, float> cases[] = {{vec3(200, 200, 0), 45.0f},   {vec3(200, -200, 0), 315.0f},
                                          {vec3(-200, 200, 0), 135.0f}, {vec3(-200, -200, 0), 215.0f},  // Quake's slip
                                          {vec3(200, 5, 0), 0.0f},      {vec3(5, -200, 0), 270.0f}};
  for (const auto& [to, yaw] : cases) {
    start_in(room(), "ogre = make('0 0 24.03125', FL_ONGROUND); goal = spawn();");
    named("goal").set(fields::origin, to);
    // Neither the diagonal nor the straight way is a turning back.
    named("ogre").set(fields::ideal_yaw, yaw);
    new_chase_dir(level(), ogre(), named("goal").id(), 10.0f);
    EXPECT_EQ(named("ogre").get(fields::ideal_yaw), yaw);
  }
}

TEST_F(StepsTest, WhoCannotGoAnywhereMayFall) {
  MapBuilder map = room();
  map.box(vec3(-8, -8, 0), vec3(8, 8, 64));  // a pillar too thin to stand on
  start_in(map, "ogre = make('0 0 88.03125', FL_ONGROUND); goal = spawn();");
  named("goal").set(fields::origin, vec3(200, 200, 0));
  named("ogre").set(fields::ideal_yaw, 100.0f);
  new_chase_dir(level(), ogre(), named("goal").id(), 2.0f);
  EXPECT_FLOAT_EQ(named("ogre").get(fields::ideal_yaw), 90.0f);
  EXPECT_TRUE(named("ogre").has_flag(fields::flags, kFlagPartialGround));
}

TEST_F(StepsTest, MovetogoalArrivesAroundAWallAndStops) {
  MapBuilder map = room();
  map.box(vec3(100, -60, 0), vec3(120, 60, 128));
  start_in(map, R"(
    ogre = make('0 0 24.03125', FL_ONGROUND);
    goal = make('300 0 24.03125', FL_ONGROUND);
    ogre.goalentity = ogre.enemy = goal;)");
  int steps = 0;
  const auto distance = [&] { return glm::length(origin("ogre") - origin("goal")); };
  while (distance() > 70.0f && steps < 500) {
    move_to_goal(level(), ogre(), 8.0f);
    ++steps;
  }
  EXPECT_LT(steps, 500);
  for (int i = 0; i < 100; ++i) move_to_goal(level(), ogre(), 8.0f);
  const vec3 there = origin("ogre");
  for (int i = 0; i < 100; ++i) move_to_goal(level(), ogre(), 8.0f);
  EXPECT_EQ(origin("ogre"), there);
  EXPECT_LE(distance(), 60.0f);
}

TEST_F(StepsTest, ChanceIsOfTheLevelsNumbers) {
  const auto way = [&](std::uint64_t seed) {
    rng_ = Rng(seed);
    start_in(room(), R"(
      ogre = make('0 0 24.03125', FL_ONGROUND);
      goal = make('300 123 24.03125', FL_ONGROUND);
      ogre.goalentity = goal;)");
    std::vector<float> path;
    for (int i = 0; i < 30; ++i) {
      move_to_goal(level(), ogre(), 8.0f);
      path.push_back(origin("ogre").x);
    }
    return path;
  };
  const auto first = way(1);
  EXPECT_EQ(first, way(1));
  EXPECT_NE(first, way(2));
}

TEST_F(StepsTest, DropToFloorReachesTwoHundredAndFiftySix) {
  start_in(room(), "ogre = make('0 0 270', 0); goal = make('100 0 300', 0);");
  EXPECT_TRUE(drop_to_floor(level(), ogre()));
  EXPECT_FLOAT_EQ(origin("ogre").z, 24.03125f);
  EXPECT_TRUE(on_ground("ogre"));
  EXPECT_FALSE(drop_to_floor(level(), named("goal").id()));
  EXPECT_EQ(origin("goal").z, 300.0f);
}

}  // namespace
}  // namespace fb::sv
