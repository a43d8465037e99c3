// Thinks, and the movetypes that are neither players nor pushers.
#include "server/simulation/physics.h"

#include <limits>

#include "server/simulation/physics_moves.h"
#include "server/simulation/test_level.h"
#include "server/simulation/test_things.h"

namespace fb::sv {
namespace {

using testing::LevelTest;
using testing::MapBuilder;

constexpr float kGap = 1.0f / 32.0f;  // before what a move hits

MapBuilder room() { return MapBuilder(vec3(-1024, -1024, 0), vec3(1024, 1024, 2048)); }

constexpr const char* kThing = R"(
entity thing;
entity(float kind, vector org) make = { return make_box(kind, org, '-8 -8 -8', '8 8 8'); };
)";

class PhysicsTest : public LevelTest {
 protected:
  void start_with(const std::string& source) { start_with(source, room()); }
  void start_with(const std::string& source, const MapBuilder& map) {
    start_level(testing::kThingsSource + (kThing + source), map);
  }
};

TEST(ClipVelocity, LessThanATenthOfAUnitASecondIsNone) {
  const vec3 up(0, 0, 1);
  EXPECT_EQ(clip_velocity(vec3(0.099f, -0.099f, -50.0f), up, 1.0f), vec3(0.0f));
  EXPECT_EQ(clip_velocity(vec3(0.101f, -0.101f, -50.0f), up, 1.0f), vec3(0.101f, -0.101f, 0.0f));
  EXPECT_EQ(clip_velocity(vec3(0.0f, 0.0f, -50.0f), up, 1.5f), vec3(0, 0, 25));
}

// --- frames and thinks ---

TEST_F(PhysicsTest, AFrameIsStartFrameThenEdictsInOrderThenTime) {
  start_with(R"(
void() say = { pute(self); put(time); };
void() StartFrame = { puts("frame"); put(time); };
void(float at) thinker = { local entity e; e = make(MOVETYPE_NONE, '0 0 100'); e.think = say; e.nextthink = at; };
void() main = { thinker(1.0625); thinker(1.03125); thinker(1.125); };)");
  tick(0.0625);
  EXPECT_EQ(output(), "[frame] 1 e2 1.0625 e3 1.03125");
  EXPECT_EQ(level().time, 1.0625);
  clear_output();
  tick(0.0625);
  EXPECT_EQ(output(), "[frame] 1.0625 e4 1.125");
}

TEST_F(PhysicsTest, ThinksAreNeverInThePastAndAreAskedForAnew) {
  start_with(R"(
void() say = { put(time); put(self.nextthink); };
void() main = { thing = make(MOVETYPE_NONE, '0 0 100'); thing.think = say; thing.nextthink = 0.5; };)");
  tick(0.1);
  EXPECT_EQ(output(), "1 0");
  clear_output();
  tick(0.1, 5);
  EXPECT_EQ(output(), "");
}

TEST_F(PhysicsTest, OneThinkAFrame) {
  start_with(R"(
void() again = { put(time); self.nextthink = time + 0.0078125; };
void() main = { thing = make(MOVETYPE_NONE, '0 0 100'); thing.think = again; thing.nextthink = 1.0078125; };)");
  tick(0.125);
  EXPECT_EQ(output(), "1.0078125");
  clear_output();
  tick(0.125);
  EXPECT_EQ(output(), "1.125");
}

TEST_F(PhysicsTest, WhatIsSpawnedInAFrameMovesFromTheNextOn) {
  start_with(R"(
entity late, early, hole;
void() launch = {
  late = spawn();
  late.movetype = MOVETYPE_NOCLIP;
  late.velocity = '100 0 0';
};
void() main = {
  thing = make(MOVETYPE_NONE, '0 0 100');
  thing.think = launch;
  thing.nextthink = 1.05;
};)");
  tick(0.1);
  EXPECT_EQ(origin("late").x, 0.0f);
  tick(0.1);
  EXPECT_FLOAT_EQ(origin("late").x, 10.0f);
}

TEST_F(PhysicsTest, WhatTakesAFreedPlaceMovesAtOnce) {
  start_with(R"(
entity late, hole;
void() launch = { late = spawn(); late.movetype = MOVETYPE_NOCLIP; late.velocity = '100 0 0'; };
void() main = {
  thing = make(MOVETYPE_NONE, '0 0 100');
  thing.think = launch;
  thing.nextthink = 1.05;
  hole = spawn();
  remove(hole);
};)");
  tick(0.1);
  EXPECT_EQ(named("late").id(), named("hole").id());
  EXPECT_FLOAT_EQ(origin("late").x, 10.0f);
}

TEST_F(PhysicsTest, ForceRetouchTouchesTriggersThatNothingMovesIn) {
  start_with(R"(
void() say = { puts("touched"); };
void() main = {
  local entity e;
  thing = make(MOVETYPE_NONE, '0 0 100');
  e = make(MOVETYPE_NONE, '0 0 100');
  e.solid = SOLID_TRIGGER;
  e.touch = say;
  setorigin(e, '0 0 100');
  force_retouch = 2;
};)");
  for (const char* said : {"[touched]", "[touched]", ""}) {
    clear_output();
    tick();
    EXPECT_EQ(output(), said);
  }
}

TEST_F(PhysicsTest, ThinksOtherThanATenthApartAreMarkedForTheClients) {
  start_with(R"(
void() slow = { self.frame = self.frame + 1; self.nextthink = time + 0.3; };
void() tenth = { self.frame = self.frame + 1; self.nextthink = time + 0.1; };
entity a, b;
void() main = {
  a = make(MOVETYPE_NONE, '0 0 100'); a.think = slow; a.nextthink = 1.05;
  b = make(MOVETYPE_NONE, '0 0 100'); b.think = tenth; b.nextthink = 1.05;
};)");
  tick();
  EXPECT_TRUE(level().extra(named("a").id()).send_interval);
  EXPECT_FALSE(level().extra(named("b").id()).send_interval);
}

TEST_F(PhysicsTest, FreezingNonclientsStopsEverythingAndTime) {
  start_with("void() main = { thing = make(MOVETYPE_NOCLIP, '0 0 100'); thing.velocity = '100 0 0'; };");
  console_.execute("sv_freezenonclients 1");
  tick(0.1, 3);
  EXPECT_EQ(origin("thing").x, 0.0f);
  EXPECT_EQ(level().time, 1.0);
}

TEST_F(PhysicsTest, AMovetypeThatIsNoneEndsTheLevelWithASentence) {
  start_with("void() main = { thing = make(2, '0 0 100'); };");
  may_fail_ = true;
  tick();
  ASSERT_TRUE(level().failed());
  EXPECT_EQ(level().error()->message, "edict 2 ( at 0 0 100) has movetype 2, which it cannot have");
  EXPECT_EQ(level().time, 1.1);  // the frame has ended all the same
}

TEST_F(PhysicsTest, AnErrorInAThinkEndsTheFrame) {
  start_with(R"(
void() fail = { error("broken"); };
void() say = { puts("never"); };
void() main = {
  thing = make(MOVETYPE_NONE, '0 0 100'); thing.think = fail; thing.nextthink = 1.01;
  thing = make(MOVETYPE_NONE, '0 0 100'); thing.think = say; thing.nextthink = 1.01;
};)");
  may_fail_ = true;
  tick();
  EXPECT_TRUE(level().failed());
  EXPECT_EQ(output(), "");
}

// --- what flies and falls ---

TEST_F(PhysicsTest, NoclipGoesThroughWallsAndTurns) {
  start_with(R"(
void() main = { thing = make(MOVETYPE_NOCLIP, '0 0 100'); thing.velocity = '0 0 -1000'; thing.avelocity = '0 90 0'; };)");
  tick(0.5, 2);
  EXPECT_EQ(origin("thing"), vec3(0, 0, -900));
  EXPECT_EQ(named("thing").get(fields::angles), vec3(0, 90, 0));
}

// Gravity first, then the way: after n frames of dt, z = z0 - g dt^2 n (n + 1) / 2.
TEST_F(PhysicsTest, TossFallsByTheDiscreteFormula) {
  start_with(R"(
.float gravity;
entity light;
void() main = {
  thing = make(MOVETYPE_TOSS, '0 0 1500');
  light = make(MOVETYPE_TOSS, '100 0 1500');
  light.gravity = 0.25;
};)");
  constexpr int kFrames = 20;
  constexpr float kDt = 0.0625f;
  tick(kDt, kFrames);
  const float fallen = 800.0f * kDt * kDt * kFrames * (kFrames + 1) / 2;
  EXPECT_FLOAT_EQ(origin("thing").z, 1500.0f - fallen);
  EXPECT_FLOAT_EQ(origin("light").z, 1500.0f - 0.25f * fallen);
  EXPECT_FLOAT_EQ(velocity("thing").z, -800.0f * kDt * kFrames);
}

TEST_F(PhysicsTest, TossLandsAndStaysAndTouches) {
  start_with(R"(
void() say = { puts("touch"); pute(other); };
void() main = {
  thing = make(MOVETYPE_TOSS, '0 0 100');
  thing.velocity = '50 0 0';
  thing.avelocity = '10 10 10';
  thing.touch = say;
};)");
  tick(0.1, 20);
  EXPECT_FLOAT_EQ(origin("thing").z, 8.0f + kGap);
  EXPECT_EQ(velocity("thing"), vec3(0.0f));
  EXPECT_EQ(named("thing").get(fields::avelocity), vec3(0.0f));
  EXPECT_TRUE(on_ground("thing"));
  EXPECT_EQ(named("thing").get(fields::groundentity), EdictId::kWorld);
  EXPECT_EQ(output(), "[touch] e0");
}

TEST_F(PhysicsTest, BounceKeepsHalfOfItsSpeedUntilItIsSlow) {
  start_with(R"(
void() main = {
  thing = make(MOVETYPE_BOUNCE, '0 0 124');
  setsize(thing, '0 0 0', '0 0 0');
  thing.velocity = '100 0 -500';
};)");
  tick(0.25);
  // It arrived with 500 + 800 / 4 and goes up by half of that: overbounce 1.5.
  EXPECT_FLOAT_EQ(velocity("thing").z, 350.0f);
  EXPECT_FLOAT_EQ(velocity("thing").x, 100.0f);
  EXPECT_FALSE(on_ground("thing"));
  tick(0.05, 200);
  EXPECT_TRUE(on_ground("thing"));
  EXPECT_EQ(velocity("thing"), vec3(0.0f));
}

TEST_F(PhysicsTest, GibsFallAsTossDoes) {
  start_with("void() main = { thing = make(MOVETYPE_GIB, '0 0 100'); };");
  tick(0.1, 20);
  EXPECT_TRUE(on_ground("thing"));
}

TEST_F(PhysicsTest, FlyKeepsItsHeightAndMissilesHitWide) {
  start_with(R"(
entity flier, missile, monster;
void() gone = { remove(self); };
void() main = {
  flier = make(MOVETYPE_FLY, '28 0 100');
  missile = make(MOVETYPE_FLYMISSILE, '-28 0 100');
  setsize(flier, '0 0 0', '0 0 0');
  setsize(missile, '0 0 0', '0 0 0');
  flier.velocity = missile.velocity = '0 1000 0';
  missile.touch = gone;
  monster = make(MOVETYPE_NONE, '0 100 100');
  setsize(monster, '-16 -16 -24', '16 16 40');
  monster.flags = FL_MONSTER;
};)");
  tick(0.1, 3);
  EXPECT_EQ(origin("flier"), vec3(28, 300, 100));
  EXPECT_TRUE(named("missile").is_free());
}

TEST_F(PhysicsTest, WhatIsNotSolidFallsThroughBoxesOntoTheMap) {
  start_with(R"(
entity table;
void() main = {
  table = make(MOVETYPE_NONE, '0 0 50');
  thing = make(MOVETYPE_TOSS, '0 0 100');
  thing.solid = SOLID_NOT;
  setsize(thing, '0 0 0', '0 0 0');
};)");
  tick(0.1, 20);
  EXPECT_FLOAT_EQ(origin("thing").z, kGap);
}

TEST_F(PhysicsTest, BothSidesAreToldOfATouchFirstTheMover) {
  start_with(R"(
entity wall;
void() say = { pute(self); pute(other); };
void() main = {
  wall = make(MOVETYPE_NONE, '100 0 100');
  thing = make(MOVETYPE_FLY, '0 0 100');
  thing.velocity = '2000 0 0';
  thing.touch = wall.touch = say;
};)");
  tick(0.05);
  EXPECT_EQ(output(), "e3 e2 e2 e3");
}

TEST_F(PhysicsTest, SpeedsAreBoundAndWhatIsNoNumberIsZero) {
  start_with(R"(
void() main = { thing = make(MOVETYPE_FLY, '0 0 1000'); };)");
  named("thing").set(fields::velocity, vec3(5000.0f, -5000.0f, std::numeric_limits<float>::quiet_NaN()));
  tick(0.125);
  EXPECT_EQ(origin("thing"), vec3(250, -250, 1000));
  EXPECT_EQ(velocity("thing"), vec3(2000, -2000, 0));
}

// --- monsters between steps ---

TEST_F(PhysicsTest, StepFallsAndThudsWhereItWasFast) {
  start_with(R"(
entity low;
void() main = {
  thing = make(MOVETYPE_STEP, '0 0 324');
  low = make(MOVETYPE_STEP, '100 0 24.5');
};)");
  tick(0.1, 20);
  EXPECT_TRUE(on_ground("thing"));
  EXPECT_TRUE(on_ground("low"));
  ASSERT_EQ(sounds_.size(), 1u);
  EXPECT_EQ(sounds_[0].source, named("thing").id());
  EXPECT_EQ(sounds_[0].sample, "demon/dland2.wav");
  EXPECT_EQ(sounds_[0].volume, 1.0f);
}

TEST_F(PhysicsTest, SwimmersAndFliersDoNotFall) {
  start_with(R"(
entity fish;
void() main = {
  thing = make(MOVETYPE_STEP, '0 0 324'); thing.flags = FL_FLY;
  fish = make(MOVETYPE_STEP, '100 0 324'); fish.flags = FL_SWIM;
};)");
  tick(0.1, 5);
  EXPECT_EQ(origin("thing").z, 324.0f);
  EXPECT_EQ(origin("fish").z, 324.0f);
}

TEST_F(PhysicsTest, CrossingTheWatersSurfaceSplashes) {
  MapBuilder map = room();
  map.box(vec3(-1024, -1024, 0), vec3(1024, 1024, 200), formats::kContentsWater);
  start_with("void() main = { thing = make(MOVETYPE_STEP, '0 0 300'); thing.flags = FL_FLY; };", map);
  tick();
  EXPECT_EQ(named("thing").get(fields::watertype), -1.0f);
  EXPECT_TRUE(sounds_.empty());
  named("thing").set(fields::origin, vec3(0, 0, 100));
  tick(0.1, 2);
  EXPECT_EQ(named("thing").get(fields::watertype), -3.0f);
  EXPECT_EQ(named("thing").get(fields::waterlevel), 1.0f);
  ASSERT_EQ(sounds_.size(), 1u);
  EXPECT_EQ(sounds_[0].sample, "misc/h2ohit1.wav");
  named("thing").set(fields::origin, vec3(0, 0, 300));
  tick(0.1, 2);
  EXPECT_EQ(sounds_.size(), 2u);
  EXPECT_EQ(named("thing").get(fields::waterlevel), -1.0f);  // the contents: so Quake has it
}

// Slides along a wall, and in a corner of two walls stops dead.
TEST_F(PhysicsTest, FallingThingsSlideAlongWalls) {
  MapBuilder map = room();
  map.box(vec3(100, -1024, 0), vec3(1024, 1024, 2048));
  map.box(vec3(-1024, 300, 0), vec3(1024, 1024, 2048));
  start_with("void() main = { thing = make(MOVETYPE_STEP, '0 0 1500'); thing.velocity = '400 400 0'; };", map);
  tick(0.25);
  // A box of 16 moves as the player's of 32 that has its lower corner: 24 to the right of the middle.
  EXPECT_FLOAT_EQ(origin("thing").x, 76.0f - kGap);
  EXPECT_FLOAT_EQ(origin("thing").y, 100.0f);
  EXPECT_EQ(velocity("thing").x, 0.0f);
  EXPECT_FLOAT_EQ(velocity("thing").y, 400.0f);
  tick(0.25, 3);
  EXPECT_FLOAT_EQ(origin("thing").y, 276.0f - kGap);
  EXPECT_EQ(velocity("thing").y, 0.0f);
}

}  // namespace
}  // namespace fb::sv
