#include "server/server.h"

#include <csignal>

#include "base/stop.h"
#include "fs/test_log.h"
#include "server/test_server.h"

namespace fb::sv {
namespace {

using ::testing::HasSubstr;

class ServerGameTest : public testing::ServerTest {};

constexpr const char* kThing = "void() thing = { says(self.targetname); };";

std::string thing(const std::string& name, const std::string& more = "") {
  return "{ \"classname\" \"thing\" \"targetname\" \"" + name + "\" " + more + " }\n";
}

TEST_F(ServerGameTest, EntitiesSpawnInOrderBehindTheWorld) {
  start(R"(void() worldspawn = { says("world"); sayse(self); saysf(time); says(mapname); saysf(self.modelindex);
             says(self.model); saysf(self.solid); saysf(self.movetype); }; )" +
            std::string(kThing),
        thing("a") + thing("b"));
  EXPECT_EQ(said(), "world e0 1 test 1 maps/test.bsp 4 7 a b ");
  EXPECT_EQ(edict(2).get(testing::fields::classname) == StringId::kNull, false);
}

TEST_F(ServerGameTest, SkillAndDeathmatchLeaveThingsOut) {
  const std::string things = thing("easy", "\"spawnflags\" \"1536\"") + thing("medium", "\"spawnflags\" \"1280\"") +
                             thing("hard", "\"spawnflags\" \"768\"") + thing("single", "\"spawnflags\" \"2048\"") +
                             thing("all", "\"spawnflags\" \"1\"");
  put_progs(testing::kModSource + std::string(kThing));
  put_map("test", room(), things);
  make_server();
  const auto spawned_with = [&](const char* skill, const char* deathmatch) {
    console_.set("skill", skill);
    console_.set("deathmatch", deathmatch);
    EXPECT_TRUE(server_->map("test").ok());
    return said();
  };
  EXPECT_EQ(spawned_with("0", "0"), "easy single all ");
  EXPECT_EQ(spawned_with("1", "0"), "medium single all ");
  EXPECT_EQ(spawned_with("2", "0"), "hard single all ");
  EXPECT_EQ(spawned_with("3", "0"), "hard single all ");
  EXPECT_EQ(spawned_with("0.6", "0"), "medium single all ");  // rounded
  EXPECT_EQ(spawned_with("9", "0"), "hard single all ");
  EXPECT_EQ(server_->skill(), 3);
  EXPECT_EQ(spawned_with("0", "1"), "easy medium hard all ");
  EXPECT_EQ(level().vm->get(testing::globals::deathmatch), 1.0f);
  console_.set("coop", "1");
  EXPECT_EQ(spawned_with("0", "1"), "easy single all ");  // coop excludes deathmatch
  EXPECT_EQ(level().vm->get(testing::globals::coop), 1.0f);
  EXPECT_EQ(level().vm->get(testing::globals::deathmatch), 0.0f);
}

TEST_F(ServerGameTest, AMissingCvarIsToldOfOnceALevel) {
  int told = 0, others = 0;
  put_progs(std::string(testing::kModSource) +
            "void() StartFrame = { if (cvar(\"nobodys\") || cvar(\"campaign\") || cvar(\"horde\") || "
            "cvar(\"sv_cheats\")) says(\"set\"); cvar_set(\"campaign\", \"0\"); };");
  put_map("test", room());
  make_server();
  set_log_level(LogLevel::kInfo);
  const int listener = add_log_listener(
      [&](LogLevel, std::string_view line) { ++(line.find("\"nobodys\"") != std::string_view::npos ? told : others); });
  ASSERT_TRUE(server_->map("test").ok());
  others = 0;
  frames(100);
  EXPECT_EQ(told, 1);
  EXPECT_EQ(others, 0) << "the re-release's cvars are there";
  ASSERT_TRUE(server_->map("test").ok());
  frames(100);
  EXPECT_EQ(told, 2);
  EXPECT_EQ(said(), "");
  remove_log_listener(listener);
}

TEST_F(ServerGameTest, NoMonsters) {
  put_progs(testing::kModSource + std::string(kThing) + "void() monster_x = { says(\"monster\"); };");
  put_map("test", room(), thing("a") + "{ \"classname\" \"monster_x\" }");
  make_server();
  ASSERT_TRUE(server_->map("test").ok());
  EXPECT_EQ(said(), "a monster ");
  console_.set("nomonsters", "1");
  ASSERT_TRUE(server_->map("test").ok());
  EXPECT_EQ(said(), "a ");
}

TEST_F(ServerGameTest, ThingsWithoutASpawnFunctionAreFreed) {
  start(kThing, "{ \"classname\" \"nothing\" }\n{ \"targetname\" \"classless\" }\n{}\n" + thing("a"));
  EXPECT_EQ(said(), "a ");
  EXPECT_EQ(level().edicts().count(), 3u);  // the world, the player and the thing, which took the freed one's place
}

TEST_F(ServerGameTest, BadEntityTextIsASentence) {
  put_progs(std::string(testing::kModSource) + kThing);
  make_server();
  const auto error_of = [&](const std::string& entities) {
    put_map("test", room(), entities);
    const Status status = server_->map("test");
    return status.ok() ? std::string() : status.error().message;
  };
  EXPECT_THAT(error_of("thing }"), HasSubstr("maps/test.bsp: found thing where an entity's { should be"));
  EXPECT_THAT(error_of("{ \"classname\" "), HasSubstr("ends behind key"));
  EXPECT_THAT(error_of("{ \"think\" \"nowhere\" }"), HasSubstr("\"nowhere\", which there is not"));
  EXPECT_FALSE(server_->active());
  EXPECT_EQ(error_of(thing("a")), "");
}

// Two frames of a tenth of a second, before anybody comes: things fall and think; who precaches now is late.
TEST_F(ServerGameTest, SettlingFrames) {
  start(R"(void() thinks = { saysf(time); };
           void() thing = { self.think = thinks; self.nextthink = time + 0.125; };)",
        thing(""));
  EXPECT_THAT(said(), HasSubstr("1.1 "));
  EXPECT_NEAR(level().time, 1.2, 1e-9);
  const Status status = try_start(R"(void() thinks = { precache_model("progs/x.mdl"); };
           void() thing = { self.think = thinks; self.nextthink = time + 0.125; };)",
                                  thing(""));
  ASSERT_TRUE(status.ok()) << status.error().message;
  EXPECT_THAT(level().vm->warning(), HasSubstr("\"progs/x.mdl\" is precached while the level runs"));
}

TEST_F(ServerGameTest, WhatIsMissingLeavesTheGameRunning) {
  start(kThing, thing("a"));
  for (const char* name : {"nowhere", "../test", "", "/etc/passwd", "a\nb"}) {
    EXPECT_FALSE(server_->map(name).ok()) << name;
    EXPECT_FALSE(server_->changelevel(name).ok()) << name;
    EXPECT_TRUE(server_->active());
  }
  files_["maps/bad.bsp"] = Bytes(100, 7);
  EXPECT_FALSE(server_->map("bad").ok());
  files_["progs.dat"].resize(50);
  EXPECT_FALSE(server_->map("test").ok());
  EXPECT_TRUE(server_->active());
  EXPECT_FALSE(server_->map("test.bsp").ok());
  frames(3);
  EXPECT_TRUE(server_->active());
}

TEST_F(ServerGameTest, QuakeCThatGoesWrongEndsTheGameWithASentence) {
  start(R"(void() thinks = { error("enough"); };
           void() thing = { self.think = thinks; self.nextthink = time + 1; };)",
        thing(""));
  frames(20);
  EXPECT_FALSE(server_->active());
  ASSERT_TRUE(server_->last_error());
  EXPECT_THAT(server_->last_error()->message, HasSubstr("enough"));
  frames(2);  // nothing happens
  EXPECT_TRUE(server_->map("test").ok());
}

TEST_F(ServerGameTest, ServerFlagsLastUntilANewGame) {
  put_progs("void() worldspawn = { saysf(serverflags); serverflags = serverflags * 2 + 1; };");
  put_map("a", room());
  put_map("b", room());
  make_server();
  ASSERT_TRUE(server_->map("a").ok());
  EXPECT_EQ(said(), "0 ");
  ASSERT_TRUE(server_->changelevel("b").ok());
  EXPECT_EQ(said(), "1 ");
  ASSERT_TRUE(server_->restart().ok());
  EXPECT_EQ(said(), "1 ");  // as the level was come to
  ASSERT_TRUE(server_->changelevel("a").ok());
  EXPECT_EQ(said(), "3 ");
  ASSERT_TRUE(server_->map("a").ok());
  EXPECT_EQ(said(), "0 ");
}

constexpr const char* kPlayers = R"(
void() SetNewParms = { parm1 = 5; parm2 = 0; };
void() SetChangeParms = { parm1 = self.health; parm2 = self.frags + 1; };
void() ClientConnect = {};
void() PutClientInServer = { self.health = parm1; self.frags = parm2; self.classname = "player"; };
void() ClientDisconnect = {};
void() PlayerPreThink = {};
void() PlayerPostThink = {};
)";

TEST_F(ServerGameTest, PlayersTakeTheirParmsAlong) {
  put_progs(std::string(testing::kModSource) + kPlayers);
  put_map("a", room());
  put_map("b", room());
  make_server();
  ASSERT_TRUE(server_->map("a").ok());
  {
    Player player = join();
    EXPECT_EQ(edict(1).get(testing::fields::health), 5.0f);
    edict(1).set(testing::fields::health, 77.0f);
    ASSERT_TRUE(server_->changelevel("b").ok());
    const auto& parms = server_->clients()[0].spawn_parms;
    EXPECT_EQ(parms[0], 77.0f);
    EXPECT_EQ(parms[1], 1.0f);
    ASSERT_TRUE(server_->restart().ok());
    EXPECT_EQ(parms[0], 77.0f);
    EXPECT_EQ(parms[1], 1.0f);
  }
}

TEST_F(ServerGameTest, QuakeCChangesLevelBeforeTheNextFrame) {
  put_progs(R"(void() worldspawn = {}; void() thinks = { changelevel("b"); changelevel("nowhere"); };
               void() thing = { self.think = thinks; self.nextthink = time + 1; };)");
  put_map("a", room(), thing(""));
  put_map("b", room());
  make_server();
  ASSERT_TRUE(server_->map("a").ok());
  frames(8);
  EXPECT_EQ(level().map_name, "a");
  frames(3);
  ASSERT_TRUE(server_->active());
  EXPECT_EQ(level().map_name, "b");
}

// A level that is not there: one sentence, however often it is asked for, and the game goes on; also to one that is.
TEST_F(ServerGameTest, QuakeCChangesToNowhere) {
  put_map("b", room());
  start(R"(void() thinks = { if (time > 3) changelevel("b"); changelevel("../x"); self.nextthink = time + 0.1; };
           void() thing = { self.think = thinks; self.nextthink = time + 1; };)",
        thing(""));
  const fs::LogLines log;
  frames(16);
  EXPECT_TRUE(server_->active());
  EXPECT_EQ(log.lines.size(), 1u);
  frames(15);
  EXPECT_EQ(level().map_name, "b");
}

TEST_F(ServerGameTest, TimeStandsWhileHeldOrPaused) {
  start(kThing, thing("a"));
  const double before = level().time;
  server_->hold(true);
  frames(5);
  EXPECT_EQ(level().time, before);
  server_->hold(false);
  frames(5);
  EXPECT_NEAR(level().time, before + 0.5, 1e-9);
  level().paused = true;
  frames(5);
  EXPECT_NEAR(level().time, before + 0.5, 1e-9);
}

TEST_F(ServerGameTest, RunsByFixedFrames) {
  start(kThing, thing("a"));
  console_.execute("sv_run 2");
  EXPECT_NEAR(level().time, 3.2, 1e-9);
  console_.add_cvar("host_framerate", "0.05", "");
  console_.execute("sv_run 2; sv_dump state.txt");
  EXPECT_NEAR(level().time, 5.2, 1e-6);
  const Bytes& dump = files_.at("state.txt");
  EXPECT_EQ(std::string(dump.begin(), dump.end()), server_->dump());
  EXPECT_THAT(server_->dump(), HasSubstr("\"targetname\" \"a\""));
  for (const char* command : {"edict 2", "edict 77", "edict", "edict -1", "edicts", "edictcount", "profile", "map",
                              "save", "load nothing", "changelevel", "sv_run -1", "sv_run x", "maxplayers 4"})
    console_.execute(command);
  EXPECT_TRUE(server_->active());
}

TEST_F(ServerGameTest, ARunIsOfSecondsThatMakeSense) {
  start(kThing, thing("a"));
  const double before = level().time;
  for (const char* wrong : {"inf", "nan", "abc", "-5", "1e300", "\"\"", "1e9x"}) {
    console_.execute(std::string("sv_run ") + wrong);
    EXPECT_TRUE(console_.failed()) << wrong;
    EXPECT_EQ(level().time, before) << wrong;
  }
}

// As a signal does, in the midst of a run: by a cvar that QuakeC sets.
TEST_F(ServerGameTest, ARunEndsWhereTheProgramIsToldToEnd) {
  con::CvarSpec told{"told", "0", ""};
  told.on_change = [](const con::Cvar&) { want_stop(SIGTERM); };
  console_.add_cvar(std::move(told));
  start(R"(void() worldspawn = {}; void() thinks = { cvar_set("told", "1"); };
           void() thing = { self.think = thinks; self.nextthink = time + 5; };)",
        thing(""));
  console_.execute("sv_run 1000000; set behind 1");
  want_stop(0);
  EXPECT_NEAR(level().time, 6.0, 0.3);
  EXPECT_EQ(console_.find_cvar("behind"), nullptr) << "nothing is executed any more";
  EXPECT_TRUE(server_->active()) << "whoever ends the program ends the game";
}

TEST_F(ServerGameTest, ExternalEntities) {
  put_progs(std::string(testing::kModSource) + kThing);
  put_map("test", room(), thing("inside"));
  const std::string outside = "{ \"classname\" \"worldspawn\" }" + thing("outside");
  files_["maps/test.ent"] = Bytes(outside.begin(), outside.end());
  make_server();
  ASSERT_TRUE(server_->map("test").ok());
  EXPECT_EQ(said(), "outside ");
}

// As Windows' editors write them.
TEST_F(ServerGameTest, ExternalEntitiesMayBeginWithAByteOrderMark) {
  put_progs(std::string(testing::kModSource) + kThing);
  put_map("test", room(), thing("inside"));
  const std::string outside = "\xef\xbb\xbf{\r\n\"classname\" \"worldspawn\"\r\n}\r\n" + thing("outside");
  files_["maps/test.ent"] = Bytes(outside.begin(), outside.end());
  make_server();
  ASSERT_TRUE(server_->map("test").ok());
  EXPECT_EQ(said(), "outside ");
}

TEST_F(ServerGameTest, ExternalEntitiesOfAnEarlierGameDoNotCount) {
  put_progs(std::string(testing::kModSource) + kThing);
  put_map("test", room(), thing("inside"));
  const std::string outside = "{ \"classname\" \"worldspawn\" }" + thing("outside");
  files_["maps/test.ent"] = Bytes(outside.begin(), outside.end());
  game_index_of_ = [](std::string_view path) { return path.ends_with(".ent") ? 0 : 1; };
  make_server();
  ASSERT_TRUE(server_->map("test").ok());
  EXPECT_EQ(said(), "inside ");
}

TEST_F(ServerGameTest, ModsHaveTheirCvars) {
  files_["gfx/pop.lmp"] = Bytes(256);
  const std::string cvars =
      "saysf(cvar(\"registered\")); saysf(cvar(\"pr_checkextension\"));"
      "cvar_set(\"temp1\", \"7\"); saysf(cvar(\"temp1\")); saysf(cvar(\"fraglimit\"));";
  EXPECT_EQ(says(cvars), "1 1 7 0 ");
  EXPECT_TRUE(console_.cvar("saved4").archived());
  EXPECT_FALSE(console_.set("registered", "0"));
}

TEST_F(ServerGameTest, ManyEdictsAreASentence) {
  console_.execute("set max_edicts 256");
  start("void() thing = { while (1) spawn(); };");
  put_map("test", room(), thing("a"));
  const Status status = server_->map("test");
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr("no free edicts: all 256"));
}

}  // namespace
}  // namespace fb::sv
