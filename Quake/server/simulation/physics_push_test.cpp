// Doors and lifts: whom they carry, push and crush, and what stops them.
#include "server/simulation/test_level.h"
#include "server/simulation/test_things.h"

namespace fb::sv {
namespace {

using testing::LevelTest;
using testing::MapBuilder;

constexpr const char* kPushers = R"(
entity lift, rider, thing;
entity(vector org, vector speed) make_lift = {
  local entity e;
  e = make_pusher("*1", org);
  e.velocity = speed;
  return e;
};
entity(float kind, vector org) make = { return make_man(kind, org); };
)";

class PushTest : public LevelTest {
 protected:
  // A room with a lift, "*1", of 128 by 128 units and 16 high, that stands on z = 0.
  void start_with(const std::string& source) {
    MapBuilder map(vec3(-512, -512, 0), vec3(512, 512, 512));
    map.model(vec3(-64, -64, 0), vec3(64, 64, 16));
    start_level(testing::kThingsSource + (kPushers + source), map);
  }
};

TEST_F(PushTest, LiftsCarryWhoStandsOnThem) {
  start_with(R"(
void() main = {
  lift = make_lift('0 0 0', '0 0 40');
  rider = make(MOVETYPE_STEP, '0 0 60');
  drop(rider);
  thing = make(MOVETYPE_TOSS, '48 48 60');
  drop(thing);
  make_player('-40 -40 40.03125');
};)");
  EXPECT_EQ(named("rider").get(fields::groundentity), named("lift").id());
  tick(0.1, 10);
  EXPECT_FLOAT_EQ(origin("lift").z, 40.0f);
  for (const char* who : {"rider", "thing", "player"}) {
    EXPECT_NEAR(origin(who).z, 80.0f, 0.1f) << who;
    EXPECT_TRUE(on_ground(who)) << who;
    EXPECT_EQ(named(who).get(fields::groundentity), named("lift").id()) << who;
  }
  named("lift").set(fields::velocity, vec3(0, 0, -40));
  tick(0.1, 10);
  for (const char* who : {"rider", "thing", "player"}) EXPECT_NEAR(origin(who).z, 40.0f, 0.1f) << who;
  EXPECT_EQ(output(), "");
}

TEST_F(PushTest, TrainsCarrySideways) {
  start_with(R"(
void() main = {
  lift = make_lift('0 0 0', '50 0 0');
  rider = make(MOVETYPE_STEP, '10 20 60');
  drop(rider);
};)");
  tick(0.1, 10);
  EXPECT_NEAR(origin("rider").x, 60.0f, 0.01f);
  EXPECT_NEAR(origin("rider").y, 20.0f, 0.01f);
}

TEST_F(PushTest, WhatIsInTheWayIsPushedAndTouched) {
  start_with(R"(
void() say = { pute(self); pute(other); };
void() main = {
  lift = make_lift('0 0 0', '50 0 0');
  thing = make(MOVETYPE_STEP, '81 0 24.03125');
  thing.flags = FL_ONGROUND;
};)");
  tick(0.1, 10);
  EXPECT_FLOAT_EQ(origin("lift").x, 50.0f);
  EXPECT_GE(origin("thing").x, 130.0f);
  EXPECT_LT(origin("thing").x, 136.0f);
  // Those that do not move are not asked.
  named("thing").set(fields::movetype, static_cast<float>(kMoveNone));
  const float stays = origin("thing").x;
  tick(0.1, 10);
  EXPECT_EQ(origin("thing").x, stays);
  EXPECT_EQ(output(), "");
}

TEST_F(PushTest, WhatCannotGiveWayBlocksAndNothingHasMoved) {
  start_with(R"(
void() main = {
  lift = make_lift('400 0 0', '100 0 0');
  rider = make(MOVETYPE_TOSS, '400 0 60');
  drop(rider);
  thing = make(MOVETYPE_STEP, '490 0 24.03125');
};)");
  const vec3 rider_before = origin("rider");
  tick(0.1, 3);
  EXPECT_EQ(output(), "[blocked] e2 e4 [blocked] e2 e4");  // after the first frame it stood 6 away
  EXPECT_FLOAT_EQ(origin("lift").x, 410.0f);
  EXPECT_FLOAT_EQ(origin("rider").x, rider_before.x + 10.0f);
  EXPECT_NEAR(origin("thing").x, 490.0f, 6.1f);
  EXPECT_FLOAT_EQ(named("lift").get(fields::ltime), 0.1f);  // its clock stands
}

TEST_F(PushTest, CorpsesAreFlattenedAndPointsIgnored) {
  start_with(R"(
entity point;
void() main = {
  lift = make_lift('400 0 0', '100 0 0');
  thing = make(MOVETYPE_STEP, '490 0 24.03125');
  thing.solid = SOLID_NOT;
  point = make(MOVETYPE_STEP, '495 40 8');
  setsize(point, '0 0 0', '0 0 0');
};)");
  tick(0.1, 4);
  EXPECT_EQ(output(), "");
  EXPECT_FLOAT_EQ(origin("lift").x, 440.0f);
  EXPECT_EQ(named("thing").get(fields::mins), vec3(0, 0, -24));
  EXPECT_EQ(named("thing").get(fields::maxs), vec3(0, 0, -24));
}

// Movements end exactly at nextthink, which is by the pusher's own clock.
TEST_F(PushTest, ThinksGoByItsOwnClock) {
  start_with(R"(
void() stop = { puts("think"); put(time); put(self.ltime); self.velocity = '0 0 0'; };
void() main = {
  lift = make_lift('0 0 0', '100 0 0');
  lift.nextthink = 0.3125;
  lift.think = stop;
};)");
  tick(0.125, 2);
  EXPECT_EQ(output(), "");
  tick(0.125, 3);
  EXPECT_EQ(output(), "[think] 1.25 0.3125");  // time is the frame's, not the think's
  EXPECT_EQ(origin("lift").x, 31.25f);
  EXPECT_EQ(named("lift").get(fields::nextthink), 0.0f);
}

TEST_F(PushTest, ABlockedPusherThinksLater) {
  start_with(R"(
void() late = { puts("think"); };
void() wait = {};
void() main = {
  lift = make_lift('400 0 0', '100 0 0');
  lift.blocked = wait;
  lift.nextthink = 0.25;
  lift.think = late;
  thing = make(MOVETYPE_STEP, '490 0 24.03125');
};
)");
  tick(0.125, 8);
  EXPECT_EQ(output(), "");
  named("thing").set(fields::solid, static_cast<float>(kSolidNot));
  tick(0.125, 2);
  EXPECT_EQ(output(), "[think]");
}

}  // namespace
}  // namespace fb::sv
