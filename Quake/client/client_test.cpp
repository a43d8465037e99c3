// The client as its users see it: demos from files, the console's commands, snapshots.
#include "client/client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/log.h"
#include "client/sources/demo.h"
#include "client/test_demo.h"
#include "client/test_game.h"
#include "console/console.h"

namespace fb::cl {
namespace {

using test::DemoBuilder;
using test::Game;
using test::walk;
using testing::HasSubstr;
namespace svc = net::svc;

TEST_F(Game, TimedemoCountsAsQuakeDoes) {
  // The first moment ends the signon stages and is read with them, and with it, in the same frame, the second. Then one
  // a frame: 8 frames for the other 8 of 10, and one more that finds the end. Neither the first nor the last counts.
  put("walk.dem", walk(10));
  ASSERT_TRUE(client.start_demo("walk", DemoMode::kTime).ok());
  int frames = 0;
  while (client.playing()) {
    frame();
    ASSERT_LT(++frames, 100);
  }
  EXPECT_EQ(frames, 10);
  ASSERT_TRUE(client.last_time_demo().has_value());
  EXPECT_EQ(client.last_time_demo()->frames, 8);
  EXPECT_NEAR(client.last_time_demo()->seconds, 0.08, 1e-9) << "from the second frame to the last";
  EXPECT_THAT(log, HasSubstr("8 frames   0.1 seconds 100.0 fps"));
  EXPECT_FALSE(client.last_error().has_value());
}

TEST_F(Game, ADisconnectEndsItAsTheEndDoes) {
  DemoBuilder demo = walk(10);
  demo.add({svc::Disconnect{}}).add({svc::Print{"never read"}});
  put("walk.dem", demo);
  ASSERT_TRUE(client.start_demo("walk.dem", DemoMode::kTime).ok());
  for (int i = 0; i < 50; ++i) frame();
  EXPECT_EQ(client.last_time_demo()->frames, 8);
  EXPECT_THAT(log, Not(HasSubstr("never read")));
}

// What stands in a demo, and the frames that timedemo of QuakeSpasm 0.95.1 counts for LibreQuake's demo1 and demo2 cut
// and joined in this way (host/tests/timedemo_test.py asks it anew): a demo's signon is of three messages there, too.
struct Counted {
  const char* name;
  std::function<void(DemoBuilder&)> fill;
  int frames;
};

DemoBuilder& moments(DemoBuilder& demo, int count) {
  for (int i = 0; i < count; ++i) demo.moment(1.0f + 0.1f * static_cast<float>(i), 0.0f);
  return demo;
}
DemoBuilder& reconnect(DemoBuilder& demo) { return demo.add({svc::StuffText{"reconnect\n"}}); }
DemoBuilder& end(DemoBuilder& demo) { return demo.add({svc::Disconnect{}}); }

const std::vector<Counted>& counted_demos() {
  static const std::vector<Counted> demos = {
      {"a level", [](auto& d) { end(moments(d, 57)); }, 55},
      {"without an end", [](auto& d) { moments(d, 57); }, 55},
      {"a restart", [](auto& d) { end(moments(reconnect(moments(d, 57)).level(), 47)); }, 103},
      {"two changes of level",
       [](auto& d) {
         moments(reconnect(moments(d, 57)).level(), 47);
         end(moments(reconnect(d).level(), 37));
       },
       141},
      {"two changes that nothing announces",
       [](auto& d) {
         moments(moments(d, 57).level(), 47);
         end(moments(d.level(), 37));
       },
       139},
      {"a change in the message that announces it",
       [](auto& d) { end(moments(moments(d, 27).level({svc::StuffText{"reconnect\n"}}), 27)); }, 52},
      {"a level that never begins",
       [](auto& d) { end(moments(reconnect(reconnect(moments(d, 27)).level()).level(), 27)); }, 53},
      {"an end in the middle", [](auto& d) { end(moments(end(moments(d, 27)), 30)); }, 25},
      {"an intermission and a finale",
       [](auto& d) {
         moments(moments(d, 27).add({svc::Intermission{}}), 10);
         end(moments(d.add({svc::Finale{"The end"}}), 10));
       },
       47},
      {"an intermission and the next level",
       [](auto& d) {
         moments(moments(d, 27).add({svc::Intermission{}}), 10);
         end(moments(reconnect(d).level(), 27));
       },
       64},
      {"two moments", [](auto& d) { end(moments(d, 2)); }, 0},
      // QuakeSpasm counts -1.
      {"one moment", [](auto& d) { end(moments(d, 1)); }, 0},
      {"none", [](auto& d) { end(d); }, 0},
  };
  return demos;
}

TEST_F(Game, TimedemoCountsChangesOfLevelAsQuakeSpasmDoes) {
  for (const net::Protocol& protocol : {net::Protocol{15, 0}, net::Protocol{666, 0}, net::Protocol{999, 2}}) {
    for (const Counted& counted : counted_demos()) {
      DemoBuilder demo(protocol);
      counted.fill(demo);
      ASSERT_TRUE(client.start_demo(demo.bytes(), "x.dem", DemoMode::kTime).ok());
      for (int i = 0; i < 300 && client.playing(); ++i) frame();
      EXPECT_FALSE(client.last_error().has_value()) << counted.name << ": " << client.last_error()->message;
      EXPECT_EQ(client.last_time_demo()->frames, counted.frames) << counted.name << ", " << protocol.version;
    }
  }
}

TEST_F(Game, TheOldLevelIsShownUntilTheNextOneBegins) {
  DemoBuilder demo = walk(4);
  reconnect(demo).level();
  put("two.dem", moments(demo, 4));
  ASSERT_TRUE(client.start_demo("two", DemoMode::kTime).ok());
  for (int i = 0; i < 9; ++i) {
    frame();
    EXPECT_EQ(client.active(), client.playing()) << i;
    if (i == 1) console.append("reconnect\n");  // nothing to a demo, as in Quake
  }
  EXPECT_EQ(client.last_time_demo()->frames, 7);
}

TEST_F(Game, WhatFollowsATimedemoOnTheCommandLineWaits) {
  put("walk.dem", walk(6));
  bool quit = false;
  console.add_command("quit", "ends the program", [&](const con::Args&) { quit = true; });
  console.append("timedemo walk\ntimedemo walk\nquit\nstartdemos walk\n");
  int frames = 0;
  while (!quit) {
    frame();
    ASSERT_LT(++frames, 100);
    if (frames == 3) {
      EXPECT_TRUE(client.timing());
    }
  }
  EXPECT_FALSE(client.playing());
  const std::size_t first = log.find("4 frames");
  ASSERT_NE(first, std::string::npos) << log;
  EXPECT_NE(log.find("4 frames", first + 1), std::string::npos) << "both were played";
}

TEST_F(Game, ATimedemoOfAListPlaysItAsOftenAsAsked) {
  put("long.dem", walk(10));
  put("short.dem", walk(6));
  std::vector<std::string> played;
  bool quit = false;
  console.add_command("quit", "ends the program", [&](const con::Args&) { quit = true; });
  console.append("scr_timedemo_runs 2\ntimedemo long nothing short\nquit\n");
  for (int frames = 0; !quit; ++frames) {
    ASSERT_LT(frames, 100);
    const bool timed = client.timing();
    frame();
    if (!timed || client.timing()) continue;
    const TimeDemoResult& result = *client.last_time_demo();
    EXPECT_TRUE(result.whole);
    EXPECT_EQ(result.of, 6);
    EXPECT_EQ(result.index, static_cast<int>((played.size() / 2) * 3 + (played.size() % 2) * 2))
        << "nothing is missing";
    played.push_back(fmt::format("{} {}", result.demo, result.frames));
  }
  EXPECT_THAT(played, testing::ElementsAre("long.dem 8", "short.dem 4", "long.dem 8", "short.dem 4"));
  EXPECT_FALSE(client.more_to_time());
}

TEST_F(Game, WhatBeginsInTheMeantimeEndsTheListOfATimedemo) {
  put("walk.dem", walk(10));
  for (const char* command : {"stopdemo", "disconnect", "playdemo walk"}) {
    console.execute("timedemo walk walk walk");
    frame();
    EXPECT_TRUE(client.more_to_time());
    console.execute(command);
    EXPECT_FALSE(client.last_time_demo()->whole);
    frame();
    EXPECT_FALSE(client.more_to_time());
    EXPECT_FALSE(client.timing()) << command;
  }
}

TEST_F(Game, AMissingDemoDoesNotHoldTheRest) {
  bool quit = false;
  console.add_command("quit", "ends the program", [&](const con::Args&) { quit = true; });
  console.append("timedemo nothing\nquit\n");
  frame();
  EXPECT_TRUE(quit);
  EXPECT_THAT(log, HasSubstr("couldn't open nothing.dem"));
  EXPECT_FALSE(client.start_demo("nothing", DemoMode::kPlay).ok());
}

TEST_F(Game, DemosPlayInTheirOwnTime) {
  put("walk.dem", walk(20));
  console.append("playdemo walk\n");
  frame(0.0);
  EXPECT_TRUE(client.playing());
  EXPECT_FALSE(client.timing());
  EXPECT_TRUE(client.active());
  EXPECT_EQ(client.protocol(), 15);
  EXPECT_EQ(client.hud().level_name, "A test");
  const double start = client.time();
  for (int i = 0; i < 50; ++i) frame(0.02);
  EXPECT_NEAR(client.time(), start + 1.0, 0.03);
  EXPECT_NEAR(static_cast<double>(client.messages_read()), 3 + 10, 1.0);
  client.build_snapshot(snapshot);
  // Two units each tenth of a second.
  EXPECT_NEAR(snapshot.camera.position.x, (client.time() - 1.0) * 20.0, 0.05);
  console.append("stopdemo\n");
  frame();
  EXPECT_FALSE(client.playing());
  EXPECT_FALSE(client.active());
  client.build_snapshot(snapshot);
  EXPECT_TRUE(snapshot.instances.empty());
}

TEST_F(Game, SnapshotsHoldTheWorldAndItsLamps) {
  put("walk.dem", walk(10).moment(2.0f, 0.0f, {svc::LightStyle{4, "z"}}));
  ASSERT_TRUE(client.start_demo("walk", DemoMode::kTime).ok());
  frame();
  client.build_snapshot(snapshot);
  ASSERT_FALSE(snapshot.instances.empty());
  EXPECT_EQ(snapshot.instances[0].id, static_cast<std::uint32_t>(scene::kIdWorld));
  EXPECT_TRUE(snapshot.cut);
  ASSERT_NE(find(scene::kIdEntityLight), nullptr);
  const vec3 normal = find(scene::kIdEntityLight)->emission;
  EXPECT_EQ(find(scene::kIdEntityLight)->visibility, static_cast<std::uint32_t>(scene::kSeenByIndirect));
  EXPECT_FLOAT_EQ(client.fog().density, 0.1f);
  for (int i = 0; i < 9; ++i) frame();
  client.build_snapshot(snapshot);
  EXPECT_NEAR(find(scene::kIdEntityLight)->emission.x, normal.x * 25.0f / 12.0f, normal.x * 1e-4f);
  console.execute("r_entlights 0");
  frame();
  client.build_snapshot(snapshot);
  EXPECT_EQ(find(scene::kIdEntityLight), nullptr);
  EXPECT_EQ(snapshot.liquid_opacity, scene::LiquidOpacity());
  console.execute("r_wateralpha 0.5");
  frame();
  client.build_snapshot(snapshot);
  EXPECT_EQ(snapshot.liquid_opacity, (scene::LiquidOpacity{0.5f, 0.5f})) << "at once";
}

TEST_F(Game, TheSameDemoGivesTheSameSnapshots) {
  DemoBuilder demo;
  for (int i = 0; i < 30; ++i) {
    svc::TempEntity boom;
    boom.type = net::TempEntityType::kExplosion;
    auto flash = test::update(2, 3, {0, 0, 0}, vec3(0.0f), net::kUpdateEffects);
    flash.effects = 2;
    demo.moment(1.0f + 0.1f * static_cast<float>(i), static_cast<float>(i), {boom, flash});
  }
  put("boom.dem", demo);
  std::vector<std::vector<scene::Instance>> runs;
  for (int run = 0; run < 2; ++run) {
    ASSERT_TRUE(client.start_demo("boom", DemoMode::kPlay).ok());
    for (int i = 0; i < 60; ++i) frame(1.0 / 60);
    client.build_snapshot(snapshot);
    runs.push_back(snapshot.instances);
    client.stop();
  }
  ASSERT_EQ(runs[0].size(), runs[1].size());
  for (std::size_t i = 0; i < runs[0].size(); ++i) {
    EXPECT_EQ(runs[0][i].id, runs[1][i].id);
    EXPECT_EQ(runs[0][i].transform, runs[1][i].transform);
    EXPECT_EQ(runs[0][i].emission, runs[1][i].emission);
  }
}

TEST_F(Game, BadDemosEndWithASentence) {
  DemoBuilder demo = walk(3);
  demo.raw({99});
  put("bad.dem", demo);
  ASSERT_TRUE(client.start_demo("bad", DemoMode::kTime).ok());
  for (int i = 0; i < 10; ++i) frame();
  EXPECT_FALSE(client.playing());
  ASSERT_TRUE(client.last_error().has_value());
  EXPECT_THAT(client.last_error()->message, HasSubstr("bad.dem, message at "));
  EXPECT_THAT(client.last_error()->message, HasSubstr("command 99 is unknown"));

  Bytes cut = walk(3).bytes();
  cut.resize(cut.size() - 5);
  ASSERT_TRUE(client.start_demo(cut, "cut.dem", DemoMode::kTime).ok());
  EXPECT_FALSE(client.last_error().has_value());
  for (int i = 0; i < 10; ++i) frame();
  ASSERT_TRUE(client.last_error().has_value());
  EXPECT_THAT(client.last_error()->message, HasSubstr("cut.dem"));

  EXPECT_FALSE(client.start_demo(Bytes{'x'}, "no.dem", DemoMode::kPlay).ok());
  EXPECT_FALSE(client.playing());
}

TEST_F(Game, AMissingMapEndsTheDemoUnlessNoWorldIsNeeded) {
  put("walk.dem", walk(5));
  files.files.erase("maps/test.bsp");
  ASSERT_TRUE(client.start_demo("walk", DemoMode::kTime).ok());
  frame();
  EXPECT_FALSE(client.playing());
  ASSERT_TRUE(client.last_error().has_value());
  EXPECT_THAT(client.last_error()->message, HasSubstr("maps/test.bsp"));
  client.set_world_required(false);
  ASSERT_TRUE(client.start_demo("walk", DemoMode::kTime).ok());
  frame();
  EXPECT_TRUE(client.active());
  client.build_snapshot(snapshot);

  EXPECT_NE(find(scene::kIdEntity + 1), nullptr);
}

TEST_F(Game, TheDemoLoopGoesRound) {
  put("a.dem", walk(2));
  put("b.dem", walk(2));
  console.append("startdemos a b\n");
  std::vector<std::string> played;
  for (int i = 0; i < 200 && played.size() < 3; ++i) {
    frame(0.1);
    if (client.playing() && (played.empty() || played.back() != client.demo_name()))
      played.push_back(client.demo_name());
  }
  EXPECT_EQ(played, (std::vector<std::string>{"a.dem", "b.dem", "a.dem"}));
}

TEST_F(Game, TheDemoLoopMayBeSwitchedOff) {
  put("a.dem", walk(2));
  console.append("cl_startdemos 0\nstartdemos a\n");
  frame(0.1);
  frame(0.1);
  EXPECT_FALSE(client.playing());
  console.append("cl_startdemos 1\nstartdemos a\n");
  frame(0.1);
  frame(0.1);
  EXPECT_TRUE(client.playing());
}

TEST(DemoPath, GetsItsExtension) {
  EXPECT_EQ(demo_path("demo1"), "demo1.dem");
  EXPECT_EQ(demo_path("demo1.dem"), "demo1.dem");
  EXPECT_EQ(demo_path("v1.0/run"), "v1.0/run.dem");
}

}  // namespace
}  // namespace fb::cl
