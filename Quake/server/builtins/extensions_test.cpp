// Extensions that change how a level behaves: turning pushers, brush models that hold something, commands that QuakeC
// hears first. Each of them only where the mod has asked.
#include "server/simulation/skin_contents.h"
#include "server/simulation/test_level.h"
#include "server/simulation/test_things.h"
#include "server/simulation/user.h"
#include "server/test_server.h"

namespace fb::sv {
namespace {

using testing::LevelTest;
using testing::MapBuilder;

constexpr const char* kThings = R"(
entity arm, rider, volume;
)";

// "*1" is a bar of 384 by 64 units, 16 high, about its middle; "*2" a box of 128 units.
class ExtensionsTest : public LevelTest {
 protected:
  void start_with(const std::string& source) {
    MapBuilder map(vec3(-512, -512, 0), vec3(512, 512, 512));
    map.model(vec3(-192, -32, 0), vec3(192, 32, 16));
    map.model(vec3(-64, -64, 0), vec3(64, 64, 128));
    start_level(testing::kThingsSource + (kThings + source), map);
  }
  void ask() { level().asked = {.rotating_pushers = true, .skin_contents = true}; }
  // How far a point gets.
  MoveTrace line(const vec3& from, const vec3& to) {
    return sv_move(level(), {from, vec3(0.0f), vec3(0.0f), to}, MoveKind::kNormal, std::nullopt);
  }
};

TEST_F(ExtensionsTest, WhatIsTurnedBlocksAsItLooksIfTheModHasAsked) {
  start_with(
      "void() main = { arm = make_pusher(\"*1\", '0 0 100'); arm.angles = '0 90 0'; setorigin(arm, '0 0 100'); };");
  EXPECT_NEAR(line(vec3(150, 0, 200), vec3(150, 0, 50)).end_pos.z, 116.0f, 0.1f) << "as QuakeSpasm: never turned";
  EXPECT_FLOAT_EQ(line(vec3(0, 150, 200), vec3(0, 150, 50)).fraction, 1.0f);
  ask();
  link_edict(level(), named("arm").id());
  EXPECT_FLOAT_EQ(line(vec3(150, 0, 200), vec3(150, 0, 50)).fraction, 1.0f);
  const MoveTrace onto = line(vec3(0, 150, 200), vec3(0, 150, 50));
  EXPECT_NEAR(onto.end_pos.z, 116.0f, 0.1f);
  EXPECT_NEAR(onto.plane.normal.z, 1.0f, 1e-5f);
  const MoveTrace side = line(vec3(200, 150, 108), vec3(-200, 150, 108));
  EXPECT_NEAR(side.end_pos.x, 32.0f, 0.1f);
  EXPECT_NEAR(side.plane.normal.x, 1.0f, 1e-5f);
  EXPECT_EQ(side.edict, named("arm").id());
  // Pitch is as models of maps are drawn: the end of the x axis goes down.
  named("arm").set(fields::angles, vec3(30, 0, 0));
  link_edict(level(), named("arm").id());
  const mat4x3 drawn = entity_transform(vec3(0, 0, 100), vec3(30, 0, 0));
  const vec3 top = transform_point(drawn, vec3(150, 0, 16));
  const MoveTrace slope = line(vec3(top.x, 0, 300), vec3(top.x, 0, 2));
  EXPECT_NEAR(slope.end_pos.z, top.z, 0.1f);
  EXPECT_NEAR(slope.plane.normal.x, transform_vector(drawn, vec3(0, 0, 1)).x, 1e-5f);
}

TEST_F(ExtensionsTest, PushersTurnByAvelocityAndCarryWhoStandsOnThem) {
  const char* source = R"(void() main = {
    arm = make_pusher("*1", '0 0 100'); arm.avelocity = '0 90 0';
    rider = make_man(MOVETYPE_STEP, '100 0 141'); self = rider; droptofloor(); self = world; };)";
  start_with(source);
  tick(0.05, 20);
  EXPECT_EQ(named("arm").get(fields::angles), vec3(0.0f)) << "not asked for: as QuakeSpasm";
  EXPECT_NEAR(origin("rider").x, 100.0f, 0.01f);
  start_with(source);
  ask();
  tick(0.05, 20);
  EXPECT_NEAR(named("arm").get(fields::angles).y, 90.0f, 0.01f);
  EXPECT_FLOAT_EQ(named("arm").get(fields::ltime), 1.0f);
  EXPECT_NEAR(origin("rider").x, 0.0f, 0.5f);
  EXPECT_NEAR(origin("rider").y, 100.0f, 0.5f);
  EXPECT_NEAR(origin("rider").z, 140.0f, 0.5f);
  EXPECT_NEAR(named("rider").get(fields::angles).y, 90.0f, 0.01f);
  EXPECT_EQ(output(), "");
}

TEST_F(ExtensionsTest, TurningPushersPushAndAreBlocked) {
  start_with(R"(void() main = {
    arm = make_pusher("*1", '0 0 24'); arm.avelocity = '0 90 0';
    rider = make_man(MOVETYPE_STEP, '150 80 24.03125'); rider.flags = FL_ONGROUND; };)");
  ask();
  tick(0.05, 10);
  EXPECT_NEAR(named("arm").get(fields::angles).y, 45.0f, 0.01f);
  EXPECT_GT(origin("rider").y, 90.0f) << "swept along";
  EXPECT_FALSE(in_solid(level(), named("rider").id()));
  // One that cannot give way stops it, and everything is as it was.
  start_with(R"(void() main = {
    arm = make_pusher("*1", '0 0 24'); arm.avelocity = '0 90 0';
    rider = make_man(MOVETYPE_NONE, '150 110 24.03125'); setsize(rider, '-200 -16 -24', '200 16 32'); setorigin(rider, rider.origin);
    rider = make_man(MOVETYPE_STEP, '150 60 24.03125'); rider.flags = FL_ONGROUND; };)");
  ask();
  tick(0.05, 40);
  EXPECT_NE(output().find("blocked"), std::string::npos);
  EXPECT_LT(named("arm").get(fields::angles).y, 30.0f);
  EXPECT_FLOAT_EQ(named("arm").get(fields::ltime) * 90.0f, named("arm").get(fields::angles).y) << "its clock waits";
  EXPECT_LT(origin("rider").y, 80.0f);
  EXPECT_FALSE(in_solid(level(), named("rider").id()));
}

TEST_F(ExtensionsTest, SkinsMakeWaterOfBrushModels) {
  start_with(
      R"(void() main = { volume = make_pusher("*2", '100 0 0'); volume.skin = -3; make_player('100 0 24.03125'); };)");
  EXPECT_EQ(point_contents(level(), vec3(100, 0, 50)), formats::kContentsEmpty);
  EXPECT_LT(line(vec3(0, 50, 50), vec3(200, 50, 50)).fraction, 1.0f) << "not asked for: solid";
  ask();
  EXPECT_EQ(point_contents(level(), vec3(100, 0, 50)), formats::kContentsWater);
  EXPECT_EQ(point_contents(level(), vec3(100, 0, 140)), formats::kContentsEmpty);
  EXPECT_EQ(point_contents(level(), vec3(20, 0, 50)), formats::kContentsEmpty);
  EXPECT_EQ(point_contents(level(), vec3(100, 0, -10)), formats::kContentsSolid) << "the map comes first";
  EXPECT_FLOAT_EQ(line(vec3(0, 50, 50), vec3(200, 50, 50)).fraction, 1.0f);
  tick(0.05);
  EXPECT_EQ(named("player").get(fields::waterlevel), 3.0f);
  EXPECT_EQ(named("player").get(fields::watertype), -3.0f);
  named("volume").set(fields::skin, -5.0f);
  tick(0.05);
  EXPECT_EQ(named("player").get(fields::watertype), -5.0f);
  for (const float solid : {-2.0f, -8.0f, 0.0f, 1.0f}) {
    named("volume").set(fields::skin, solid);
    EXPECT_LT(line(vec3(0, 50, 50), vec3(200, 50, 50)).fraction, 1.0f) << solid;
    EXPECT_EQ(point_contents(level(), vec3(100, 0, 50)) == formats::kContentsEmpty, solid >= 0.0f) << solid;
  }
}

TEST_F(ExtensionsTest, LaddersAreClimbedAndHungOn) {
  start_with(R"(void() main = { volume = spawn(); volume.solid = SOLID_TRIGGER; volume.skin = -16;
    setsize(volume, '-32 -32 0', '32 32 200'); setorigin(volume, '100 0 0'); make_player('100 0 24.03125'); };)");
  const EdictId id = named("player").id();
  const auto climb = [&](float forward, float pitch, int ticks) {
    named("player").set(fields::v_angle, vec3(pitch, 0, 0));
    for (int i = 0; i < ticks; ++i) {
      client_think(level(), id, {.forward_move = forward});
      tick(0.05);
    }
  };
  EXPECT_FALSE(on_ladder(level(), id));
  ask();
  EXPECT_TRUE(on_ladder(level(), id));
  EXPECT_EQ(point_contents(level(), vec3(100, 0, 50)), formats::kContentsEmpty) << "a ladder is no liquid";
  named("volume").set(fields::absmax, vec3(1000, 32, 200));  // wide: climbing goes forward as well
  climb(400, 0, 10);
  const float up = origin("player").z;
  EXPECT_GT(up, 60.0f);
  climb(0, 0, 10);
  EXPECT_FLOAT_EQ(origin("player").z, up) << "hangs on";
  climb(400, 60, 5);
  EXPECT_LT(origin("player").z, up - 20.0f) << "down";
  climb(400, -20, 60);
  EXPECT_LT(origin("player").z, 260.0f) << "no higher than its top";
  named("volume").set(fields::skin, 0.0f);
  climb(0, 0, 40);
  EXPECT_LT(origin("player").z, 30.0f) << "falls without one";
}

class ExtensionBuiltinsTest : public testing::ServerTest {};

TEST_F(ExtensionBuiltinsTest, AskingChangesTheLevel) {
  EXPECT_EQ(says("saysf(checkextension(\"FRIK_FILE\")); saysf(checkextension(\"DP_SV_NONESUCH\"));"), "1 0 ");
  EXPECT_FALSE(level().asked.rotating_pushers || level().asked.skin_contents);
  EXPECT_EQ(says("saysf(checkextension(\"DP_SV_ROTATINGBMODEL\"));"), "1 ");
  EXPECT_TRUE(level().asked.rotating_pushers && !level().asked.skin_contents);
  EXPECT_EQ(says("saysf(checkextension(\"FTE_ENT_SKIN_CONTENTS\"));"), "1 ");
  EXPECT_TRUE(!level().asked.rotating_pushers && level().asked.skin_contents);
}

TEST_F(ExtensionBuiltinsTest, TraceToss) {
  EXPECT_EQ(says(R"(setorigin(self, '0 0 100'); self.velocity = '100 0 0'; tracetoss(self, world);
    sayse(trace_ent); saysf(rint(trace_endpos_z)); saysf(trace_endpos_x > 40 && trace_endpos_x < 60);
    saysv(self.origin); saysv(self.velocity); saysv(trace_plane_normal);)",
                 "void(entity e, entity ignore) tracetoss = #64;"),
            "e0 0 1 (0 0 100) (100 0 0) (0 0 1) ");
  // What is not to count is passed by; who never comes to anything is somewhere after ten seconds.
  EXPECT_EQ(says(R"(local entity e; e = spawn(); e.solid = SOLID_BBOX; setorigin(e, '0 0 50');
    setsize(e, '-10 -10 -10', '10 10 10'); setorigin(self, '0 0 100'); tracetoss(self, world); sayse(trace_ent);
    self.gravity = -0.0001; self.velocity = '0 0 0'; tracetoss(self, e); sayse(trace_ent); saysf(trace_fraction);)",
                 "void(entity e, entity ignore) tracetoss = #64; .float gravity;"),
            "e3 e0 1 ");
}

TEST_F(ExtensionBuiltinsTest, QuakeCHearsCommandsFirst) {
  start(R"(
void(entity e, string s) clientcommand = #440;
float kills;
void() ClientKill = { kills = kills + 1; };
void() PutClientInServer = { self.health = 100; };
void(string s) SV_ParseClientCommand = { says(s); if (s != "kill") clientcommand(self, s); };
void() go = { clientcommand(world, "kill"); clientcommand(edict_num(1), "kill"); };
)");
  Player player = join();
  EXPECT_EQ(said(), "") << "not on the way in";
  tell(player, "name bob");
  frames(2);
  EXPECT_EQ(said(), "name bob ");
  EXPECT_EQ(text(edict(1).get(fields::netname)), "bob");
  tell(player, "kill");
  frames(2);
  EXPECT_EQ(said(), "name bob kill ");
  EXPECT_EQ(level().vm->get(global<float>("kills")), 0.0f) << "kept from the engine";
  ASSERT_TRUE(level().run(level().vm->program().find_function("go"), EdictId::kWorld));
  EXPECT_EQ(level().vm->get(global<float>("kills")), 1.0f) << "the world is no player";
  EXPECT_EQ(said(), "name bob kill ") << "what QuakeC says itself does not come back to it";
  console_.set("pr_checkextension", "0");
  tell(player, "kill");
  frames(2);
  EXPECT_EQ(level().vm->get(global<float>("kills")), 2.0f);
}

}  // namespace
}  // namespace fb::sv
