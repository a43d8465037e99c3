// Client and server joined: a game on LibreQuake's maps under the rules of testdemos/rules, played by a script. Skipped
// where the data or the compiler of QuakeC is absent.
#include "host/game/engine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <algorithm>

#include "base/librequake.h"
#include "base/log.h"
#include "fs/file.h"
#include "server/simulation/test_rules.h"

namespace fb::host {
namespace {

using testing::HasSubstr;
namespace stdfs = std::filesystem;

constexpr double kFrame = 0.05;

// Walks, turns, jumps and fires; `wait` is a frame.
constexpr const char* kWalk =
    "alias w2 \"wait;wait\"\nalias w8 \"w2;w2;w2;w2\"\nalias w32 \"w8;w8;w8;w8\"\n"
    "w32\n+forward\nw32\n+left\nw8\n-left\n+jump\nw2\n-jump\nw32\nimpulse 2\n+attack\nw8\n-attack\n+moveright\nw32\n"
    "-moveright\n-forward\nw8\nwalk_done\n";

class EngineTest : public testing::Test {
 protected:
  void SetUp() override {
    data = librequake_folder();
    if (const std::string lacks = librequake_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
    folder = stdfs::path(testing::TempDir()) /
             ("engine_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    stdfs::remove_all(folder);
    stdfs::create_directories(folder / "id1");
    std::ofstream(folder / "id1" / "walk.cfg") << kWalk;
    static const Bytes progs = sv::testing::compile_rules("");
    if (progs.empty()) GTEST_SKIP() << "fteqcc is not installed (Linux/install-deps.sh test)";
    ASSERT_TRUE(fs::write_file_atomically(folder / "id1" / "progs.dat", progs).ok());
    listener = add_log_listener([this](LogLevel, std::string_view line) { log += std::string(line) + "\n"; });
  }
  void TearDown() override {
    if (listener != 0) remove_log_listener(listener);
    stdfs::remove_all(folder);
  }
  std::unique_ptr<Engine> make(EngineOptions options = {}) {
    options.seed = 7;
    auto engine = Engine::create({"-basedir", data.string(), "-userdir", folder.string()}, options);
    EXPECT_TRUE(engine.ok()) << engine.error().message;
    return engine.ok() ? std::move(*engine) : nullptr;
  }
  // Frames until `done` or so many.
  template <typename Done>
  int run(Engine& engine, int most, Done done) {
    FrameTimer timer;
    for (int i = 0; i < most; ++i) {
      now += kFrame;
      engine.execute_commands(now);
      engine.frame(timer.plan(kFrame, read_time_settings(engine.console())), vec2(0.0f), now);
      if (done()) return i + 1;
    }
    return most;
  }
  struct Walk {
    std::vector<vec3> positions, angles;
    std::string state;
  };
  Walk walk(const std::string& begin) {
    Walk result;
    auto engine = make();
    if (!engine) return result;
    bool done = false;
    engine->console().add_command("walk_done", "the script's end", [&](const con::Args&) { done = true; });
    engine->console().append("host_framerate 0.05\n" + begin + "\nexec walk\n");
    run(*engine, 400, [&] {
      if (engine->client().active()) {
        result.positions.push_back(engine->client().player_origin());
        result.angles.push_back(engine->client().view_angles());
      }
      return done;
    });
    EXPECT_TRUE(done) << log;
    result.state = engine->server().dump();
    return result;
  }

  stdfs::path data, folder;
  std::string log;
  int listener = 0;
  double now = 10.0;
};

TEST_F(EngineTest, AScriptedWalkRepeats) {
  const Walk first = walk("map start"), second = walk("map start");
  ASSERT_GT(first.positions.size(), 100u);
  EXPECT_GT(glm::length(first.positions.back() - first.positions.front()), 100.0f) << "it went somewhere";
  EXPECT_EQ(first.positions, second.positions);
  EXPECT_EQ(first.angles, second.angles);
  EXPECT_FALSE(first.state.empty());
  EXPECT_EQ(first.state, second.state) << "every field of every edict";
}

TEST_F(EngineTest, ItsDemoShowsTheSameWalk) {
  const Walk played = walk("record walk start");
  ASSERT_GT(played.positions.size(), 100u);
  ASSERT_TRUE(stdfs::exists(folder / "id1" / "walk.dem")) << "the recording ends with the game";
  auto engine = make({.server = false});
  ASSERT_TRUE(engine);
  engine->console().append("timedemo walk\n");
  std::vector<vec3> shown;
  run(*engine, 1000, [&] {
    if (engine->client().playing() && engine->client().active()) shown.push_back(engine->client().player_origin());
    return !engine->client().playing();
  });
  EXPECT_FALSE(engine->client().last_error().has_value());
  ASSERT_GE(shown.size(), played.positions.size() - 2);
  // A demo's first frame reads two moments of the game.
  const auto count = static_cast<std::ptrdiff_t>(std::min(shown.size(), played.positions.size())) - 2;
  EXPECT_EQ(std::vector<vec3>(shown.end() - count, shown.end()),
            std::vector<vec3>(played.positions.end() - count, played.positions.end()));
}

TEST_F(EngineTest, ConfigurationsComeInQuakesOrder) {
  std::ofstream(folder / "id1" / "quake.rc")
      << "exec default.cfg\nexec config.cfg\nexec autoexec.cfg\nstuffcmds\nstartdemos demo1 demo2\n";
  std::ofstream(folder / "id1" / "default.cfg") << "set order d\n";
  std::ofstream(folder / "id1" / "config.cfg") << "set order \"$order c\"\necho config\n";
  std::ofstream(folder / "id1" / "autoexec.cfg") << "echo autoexec\n";
  auto engine = make();
  ASSERT_TRUE(engine);
  GameOptions options;
  options.arguments = {"+echo", "command line", "+map", "start"};
  engine->queue_configuration(options);
  run(*engine, 3, [] { return false; });
  const std::size_t config = log.find("config\n"), autoexec = log.find("autoexec\n"), line = log.find("command line\n");
  ASSERT_NE(line, std::string::npos) << log;
  EXPECT_LT(config, autoexec);
  EXPECT_LT(autoexec, line);
  EXPECT_TRUE(engine->client().connected());
  EXPECT_FALSE(engine->client().playing()) << "startdemos keeps out of a game";
}

TEST_F(EngineTest, WhatCannotBeginIsASentenceAndTheProgramGoesOn) {
  auto engine = make();
  ASSERT_TRUE(engine);
  engine->console().append("map nowhere\n");
  run(*engine, 3, [] { return false; });
  EXPECT_THAT(log, HasSubstr("nowhere"));
  EXPECT_FALSE(engine->busy());
  engine->console().append("map start\n");
  run(*engine, 40, [&] { return engine->client().active(); });
  EXPECT_TRUE(engine->client().active());
  engine->console().append("map nowhere\n");
  run(*engine, 3, [] { return false; });
  EXPECT_TRUE(engine->client().active()) << "what runs goes on";
  engine->console().append("disconnect\n");
  run(*engine, 3, [] { return false; });
  EXPECT_FALSE(engine->server().active());
  EXPECT_FALSE(engine->busy());
}

TEST_F(EngineTest, HighFrameRatesDoNotChangeThePhysics) {
  // The same three seconds of falling and walking at 60, 144 and 250 frames a second.
  std::vector<float> distances;
  for (const double fps : {60.0, 144.0, 250.0}) {
    auto engine = make();
    ASSERT_TRUE(engine);
    engine->console().append("host_maxfps 250\nmap start\n");
    FrameTimer timer;
    const auto frames = [&](double seconds) {
      for (int i = 0; i < static_cast<int>(seconds * fps); ++i) {
        now += 1.0 / fps;
        engine->execute_commands(now);
        engine->frame(timer.plan(1.0 / fps, read_time_settings(engine->console())), vec2(0.0f), now);
      }
    };
    frames(1.0);
    ASSERT_TRUE(engine->client().active());
    const vec3 start = engine->client().player_origin();
    engine->console().append("+forward\n");
    frames(0.8);
    distances.push_back(glm::length(engine->client().player_origin() - start));
  }
  EXPECT_GT(distances[0], 50.0f);
  // Within two ticks' walk.
  EXPECT_NEAR(distances[1], distances[0], 2 * 320.0f / 72.0f);
  EXPECT_NEAR(distances[2], distances[0], 2 * 320.0f / 72.0f);
}

TEST_F(EngineTest, TheCommandLinesProtocolIsTheServers) {
  for (const int protocol : {15, 999}) {
    auto engine = make({.protocol = protocol});
    ASSERT_TRUE(engine);
    engine->console().append("map start\n");
    run(*engine, 40, [&] { return engine->client().active(); });
    EXPECT_TRUE(engine->client().active()) << log;
    EXPECT_EQ(engine->server().clients().protocol().version, protocol);
  }
}

TEST_F(EngineTest, TheConsolesLogIsAFile) {
  auto engine = make({.console_log = true});
  ASSERT_TRUE(engine);
  engine->console().append("map start\necho a word\n");
  run(*engine, 3, [] { return false; });
  const auto bytes = fs::read_whole_file(folder / "id1" / "qconsole.log");
  ASSERT_TRUE(bytes.ok());
  const std::string text(bytes->begin(), bytes->end());
  EXPECT_THAT(text, HasSubstr("Server spawned: start\n"));
  EXPECT_THAT(text, HasSubstr("\na word\n"));
}

TEST_F(EngineTest, WithoutANetworkGamesAreAlone) {
  const net::NetworkOptions off{.ipv4 = false, .ipv6 = false};
  auto server = make({.client = false, .dedicated = true, .max_clients = 2, .network = off});
  ASSERT_TRUE(server) << "a launcher's -nolan is no reason to end";
  EXPECT_THAT(log, HasSubstr("Nobody can join"));
  auto engine = make({.network = off});
  ASSERT_TRUE(engine);
  engine->console().append("connect 127.0.0.1\n");
  run(*engine, 3, [] { return false; });
  EXPECT_THAT(log, HasSubstr("switched off by the command line"));
  engine->console().append("map start\n");
  run(*engine, 40, [&] { return engine->client().active(); });
  EXPECT_TRUE(engine->client().active()) << log;
}

TEST_F(EngineTest, OthersJoinOverTheNetwork) {
  auto server = make({.client = false, .dedicated = true, .max_clients = 2, .port = 26977});
  auto player = make({.server = false});
  if (!server || !player) GTEST_SKIP() << "port 26977 is taken";
  server->console().append("map start\n");
  player->console().append("connect 127.0.0.1:26977\n");
  FrameTimer timer;
  for (int i = 0; i < 400 && !player->client().active(); ++i) {
    now += kFrame;
    for (Engine* engine : {server.get(), player.get()}) {
      engine->execute_commands(now);
      engine->frame(timer.plan(kFrame, {kFrame, 0.0, 72.0}), vec2(0.0f), now);
    }
  }
  EXPECT_TRUE(player->client().active()) << log;
  EXPECT_EQ(server->server().clients().active_count(), 1);
  EXPECT_TRUE(server->console().cvar("deathmatch").on());
}

}  // namespace
}  // namespace fb::host
