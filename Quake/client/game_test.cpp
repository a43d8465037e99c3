// The client on a server: signing on, moving, commands, what goes wrong; and demos that it records.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/log.h"
#include "base/stop.h"
#include "client/client.h"
#include "client/demo_recorder.h"
#include "client/test_server.h"
#include "console/console.h"
#include "formats/dem.h"
#include "fs/held_file.h"

namespace fb::cl {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
namespace svc = net::svc;
namespace stdfs = std::filesystem;

Bytes read_whole(const stdfs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return Bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
}

struct Playing : testing::Test {
  explicit Playing(const net::Protocol& protocol = {})
      : server(protocol), files(test::game_files()), library(files.loader()), client(console, library, files.loader()) {
    folder = stdfs::path(testing::TempDir()) /
             ("play_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    stdfs::remove_all(folder);
    listener = add_log_listener([this](LogLevel, std::string_view line) { log += std::string(line) + "\n"; });
    client.set_clock([this] { return now; });
    client.set_local_server({[this] { return runs ? server.connect() : nullptr; }, [this] { ++shut_down; }});
    client.set_write_path([this](std::string_view name) -> Result<stdfs::path> { return folder / name; });
    console.add_command("map", "map", [this](const con::Args&) { EXPECT_TRUE(client.connect("local").ok()); });
  }
  ~Playing() override {
    remove_log_listener(listener);
    stdfs::remove_all(folder);
  }
  // One turn of the host's loop.
  void frame(double seconds = 0.05, vec2 mouse = vec2(0.0f)) {
    now += seconds;
    console.execute();
    client.look(seconds, mouse);
    client.send();
    server.frame(seconds, now);
    client.advance(seconds);
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) frame();
  }
  void join() {
    ASSERT_TRUE(client.connect("local").ok());
    for (int i = 0; i < 20 && !client.active(); ++i) frame();
    ASSERT_TRUE(client.active()) << log;
  }
  // Where the player is when the demo shows each of its moments.
  std::vector<float> positions(const std::string& name) {
    std::vector<float> xs;
    EXPECT_TRUE(client.start_demo(read_whole(folder / name), name, DemoMode::kTime).ok());
    for (int i = 0; i < 1000 && client.playing(); ++i) {
      now += 0.05;
      client.advance(0.05);
      if (client.playing()) xs.push_back(client.player_origin().y);
    }
    EXPECT_FALSE(client.last_error().has_value()) << client.last_error()->message;
    return xs;
  }

  test::FakeServer server;
  scene::test::TestFiles files;
  con::Console console;
  scene::ModelLibrary library;
  Client client;
  std::string log;
  stdfs::path folder;
  int listener = 0, shut_down = 0;
  bool runs = true;
  double now = 100.0;
};

struct PlayingFitz : Playing {
  PlayingFitz() : Playing({net::kProtocolFitzQuake, 0}) {}
};

TEST_F(Playing, SignsOnStageByStage) {
  console.execute("name \"Ann Other\"; color 4 11");
  join();
  EXPECT_THAT(server.commands, ElementsAre("prespawn", "name \"Ann Other\"", "color 4 11", "spawn", "begin"));
  EXPECT_TRUE(client.connected());
  EXPECT_FALSE(client.playing()) << "no demo";
  EXPECT_EQ(client.hud().level_name, "A test");
  EXPECT_EQ(client.view_angles().y, 90.0f) << "svc_setangle";
  scene::FrameSnapshot snapshot;
  client.build_snapshot(snapshot);
  EXPECT_FALSE(snapshot.instances.empty());
}

TEST_F(Playing, MovesGoEveryFrameButALevelsFirstTwo) {
  join();
  console.append("+forward\n");
  const std::size_t before = server.moves.size();
  frames(6);
  ASSERT_EQ(server.moves.size(), before + 6 - (before == 0 ? 2 : 0));
  EXPECT_EQ(server.moves.back().forward, 200);
  EXPECT_EQ(server.moves.back().view_angles.y, 90.0f);
  EXPECT_GT(client.player_origin().y, 20.0f);
  EXPECT_NEAR(server.moves.back().time, server.time, 0.051) << "of the last message, for ping";
  console.append("-forward\nimpulse 3\n");
  frame();
  EXPECT_EQ(server.moves.back().forward, 0);
  EXPECT_EQ(server.moves.back().impulse, 3);
  frame();
  EXPECT_EQ(server.moves.back().impulse, 0);
}

TEST_F(PlayingFitz, AnglesAreFineInProtocol666) {
  join();
  console.append("+mlook\n");
  frames(3);
  frame(0.05, {7, 3});
  frame();
  EXPECT_NEAR(server.moves.back().view_angles.x, 3 * 3 * 0.022f, 0.006f);
  EXPECT_NEAR(server.moves.back().view_angles.y, 90.0f - 7 * 3 * 0.022f, 0.012f);
}

TEST_F(Playing, SeveralTicksAFrameSendTheImpulseOnce) {
  join();
  frames(4);
  console.append("impulse 9\n+attack 200\n-attack 200\n");
  console.execute();
  client.send();
  client.send();
  server.frame(0.05, now);
  ASSERT_GE(server.moves.size(), 2u);
  EXPECT_EQ(server.moves[server.moves.size() - 2].impulse, 9);
  EXPECT_EQ(server.moves[server.moves.size() - 2].buttons, 1);
  EXPECT_EQ(server.moves.back().impulse, 0);
  EXPECT_EQ(server.moves.back().buttons, 0);
}

TEST_F(Playing, CommandsOfTheGameGoToTheServer) {
  console.execute("god");
  EXPECT_THAT(log, HasSubstr("Can't \"god\", not connected"));
  join();
  server.commands.clear();
  console.append("god\ngive s 100\nsay \"hello there\"\ncmd anything at all\nname Bob\n");
  frames(2);
  EXPECT_THAT(server.commands,
              ElementsAre("god", "give s 100", "say \"hello there\"", "anything at all", "name \"Bob\""));
}

TEST_F(Playing, KeepalivesAreNoMessages) {
  join();
  console.append("record keep\n");
  frame();
  server.say_raw({net::svc::Nop::kCommand.number});
  frames(2);
  console.execute("stop");
  const Bytes demo = read_whole(folder / "keep.dem");
  auto reader = formats::DemReader::open(demo, "keep");
  ASSERT_TRUE(reader.ok());
  while (!reader->at_end()) {
    auto message = reader->next();
    ASSERT_TRUE(message.ok());
    EXPECT_FALSE(message->data.size() == 1 && message->data[0] == 1);
  }
}

TEST_F(Playing, ANewLevelIsSignedOnAnew) {
  join();
  console.append("+forward\n");
  frames(5);
  server.commands.clear();
  server.change_level();
  server.moves.clear();
  for (int i = 0; i < 20 && !server.spawned; ++i) frame();
  frame();
  EXPECT_TRUE(client.active()) << log;
  EXPECT_THAT(server.commands, ElementsAre("prespawn", "name \"player\"", "color 0 0", "spawn", "begin"));
  EXPECT_FALSE(client.last_error().has_value());
  EXPECT_EQ(shut_down, 0);
}

TEST_F(Playing, LeavingSaysGoodbyeAndShutsTheLocalServerDown) {
  join();
  console.execute("disconnect");
  server.frame(0.05, now);
  EXPECT_TRUE(server.said_goodbye);
  EXPECT_EQ(shut_down, 1);
  EXPECT_FALSE(client.connected());
  EXPECT_FALSE(client.active());
  console.execute("disconnect");
  EXPECT_EQ(shut_down, 1);
}

TEST_F(Playing, AnotherGameDoesNotShutTheServerDown) {
  join();
  ASSERT_TRUE(client.connect("local").ok()) << "as after a new map";
  EXPECT_EQ(shut_down, 0);
  for (int i = 0; i < 20 && !client.active(); ++i) frame();
  EXPECT_TRUE(client.active());
}

TEST_F(Playing, ADemoEndsTheGame) {
  join();
  test::DemoBuilder demo;
  demo.moment(1.0f, 0.0f).moment(1.1f, 0.0f);
  ASSERT_TRUE(client.start_demo(demo.bytes(), "x.dem", DemoMode::kPlay).ok());
  EXPECT_FALSE(client.connected());
  EXPECT_EQ(shut_down, 1);
  join();
  EXPECT_FALSE(client.playing()) << "and a game ends the demo";
}

TEST_F(Playing, WhatEndsTheGameIsSaidInASentence) {
  join();
  server.say({svc::Disconnect{}});
  frames(2);
  EXPECT_FALSE(client.connected());
  EXPECT_THAT(log, HasSubstr("Server disconnected"));
  EXPECT_FALSE(client.last_error().has_value()) << "the server wanted it";

  join();
  server.hang_up();
  frame();
  EXPECT_FALSE(client.connected());
  ASSERT_TRUE(client.last_error().has_value());
  EXPECT_EQ(client.last_error()->message, "Lost the connection to local: closed by the other side");

  join();
  EXPECT_FALSE(client.last_error().has_value());
  server.say_raw({99});
  frames(2);
  ASSERT_TRUE(client.last_error().has_value());
  EXPECT_THAT(client.last_error()->message, HasSubstr("command 99 is unknown"));
  EXPECT_EQ(shut_down, 1);
  EXPECT_FALSE(client.connected());

  runs = false;
  console.execute("connect local");
  EXPECT_THAT(log, HasSubstr("no game runs here"));
}

TEST_F(Playing, OnlyTheOwnServerCommandsTheConsole) {
  join();
  console.execute("alias stuffed \"echo heard it\"");
  server.say({svc::StuffText{"stuffed\n"}});
  frames(3);
  EXPECT_THAT(log, HasSubstr("heard it"));
}

TEST_F(Playing, InStepTheLatestMessageIsShown) {
  join();
  client.set_in_step(true);
  console.append("+forward\n");
  frames(6);
  EXPECT_EQ(client.time(), static_cast<double>(static_cast<float>(server.time)));
  EXPECT_NEAR(client.player_origin().y, server.origin.y, 1.0f / 8);
  // Two frames a tick: half of them are between two messages.
  client.set_in_step(false);
  frames(3);
  now += 0.025;
  client.send();
  server.frame(0.05, now);
  client.advance(0.025);
  EXPECT_LT(client.time(), server.time - 0.02);
  EXPECT_LT(client.player_origin().y, server.origin.y - 2.0f);
}

TEST_F(Playing, ARecordedDemoShowsTheSamePositions) {
  console.append("record walk anywhere 5\n");
  frames(8);
  ASSERT_TRUE(client.recording()) << log;
  EXPECT_FALSE(stdfs::exists(folder / "walk.dem")) << "only whole demos have their name";
  client.set_in_step(true);
  console.append("+forward\n");
  std::vector<float> walked;
  for (int i = 0; i < 20; ++i) {
    frame(0.05, {i < 10 ? 4.0f : 0.0f, 0.0f});
    walked.push_back(client.player_origin().y);
  }
  const vec3 looking = client.view_angles();
  console.execute("stop");
  EXPECT_FALSE(stdfs::exists(folder / "walk.dem.part"));
  console.execute("disconnect");

  const Bytes demo = read_whole(folder / "walk.dem");
  ASSERT_EQ(std::string(demo.begin(), demo.begin() + 2), "5\n") << "the CD track";
  EXPECT_EQ(demo.back(), net::svc::Disconnect::kCommand.number);
  const std::vector<float> shown = positions("walk.dem");
  ASSERT_GE(shown.size(), walked.size());
  EXPECT_EQ(std::vector<float>(shown.end() - static_cast<std::ptrdiff_t>(walked.size()), shown.end()), walked);
  EXPECT_EQ(client.view_angles(), looking);
}

TEST_F(Playing, RecordingMayBeginInTheMidstOfAGame) {
  join();
  client.set_in_step(true);
  console.append("+forward\n");
  frames(10);
  console.append("record late\n");
  frame();
  std::vector<float> walked;
  for (int i = 0; i < 10; ++i) {
    frame();
    walked.push_back(client.player_origin().y);
  }
  console.execute("disconnect");
  EXPECT_THAT(log, HasSubstr("Completed demo")) << "leaving ends the recording";
  const std::vector<float> shown = positions("late.dem");
  ASSERT_GE(shown.size(), walked.size());
  EXPECT_EQ(std::vector<float>(shown.end() - static_cast<std::ptrdiff_t>(walked.size()), shown.end()), walked);
  EXPECT_EQ(client.hud().scores.at(0).name, "tester") << "what was said before is in it";
}

TEST_F(Playing, ARecordingFromTheMidstKnowsWhatWasPrecachedLate) {
  join();
  server.say({svc::StuffText{"//precache model 40 \"progs/thing.mdl\"\n//precache sound 9 \"late.wav\"\n"}});
  frames(3);
  console.append("record late\n");
  frames(3);
  console.execute("stop; disconnect");
  const Bytes demo = read_whole(folder / "late.dem");
  const std::string text(demo.begin(), demo.end());
  EXPECT_THAT(text, HasSubstr("//precache model 40 \"progs/thing.mdl\"\n"));
  EXPECT_THAT(text, HasSubstr("//precache sound 9 \"late.wav\"\n"));
  EXPECT_THAT(log, Not(HasSubstr("precache"))) << "nothing for the console";
  EXPECT_GE(positions("late.dem").size(), 2u);
}

TEST_F(Playing, RecordingsBeginAfterALevelChangeWithTheNewLevel) {
  join();
  frames(3);
  server.change_level();
  for (int i = 0; i < 20 && !server.spawned; ++i) frame();
  frames(3);
  console.append("record second\n");
  frames(4);
  console.execute("stop; disconnect");
  EXPECT_GE(positions("second.dem").size(), 3u);
}

TEST_F(Playing, RecordingSpoilsNothing) {
  stdfs::create_directories(folder);
  std::ofstream(folder / "old.dem") << "the old one";
  std::ofstream(folder / "old.dem.part") << "-1\ncut short";
  join();
  console.append("record old\n");
  frame();
  EXPECT_EQ(read_whole(folder / "old.dem").size(), 11u) << "still there";
  EXPECT_THAT(log, HasSubstr("which will be replaced"));
  EXPECT_EQ(read_whole(folder / "old_cut1.dem").size(), 12u) << "what was left over is kept";
  console.execute("stop");
  EXPECT_GT(read_whole(folder / "old.dem").size(), 100u);
  console.execute("stop");
  EXPECT_THAT(log, HasSubstr("Not recording a demo."));
  console.execute("record");
  EXPECT_THAT(log, HasSubstr("record <demo> [<map> [cd track]]"));
}

TEST_F(Playing, AnotherProgramsRecordingIsLeftAlone) {
  stdfs::create_directories(folder);
  const auto held = fs::HeldFile::take(folder / "same.dem.part");
  ASSERT_TRUE(held.ok() && held->append(Bytes{1, 2, 3}));
  join();
  console.append("record same\n");
  frame();
  EXPECT_FALSE(client.recording());
  EXPECT_THAT(log, HasSubstr("same.dem.part: another program is writing it"));
  EXPECT_EQ(read_whole(folder / "same.dem.part").size(), 3u);
  EXPECT_FALSE(stdfs::exists(folder / "same_cut1.dem"));
}

TEST_F(Playing, AMapThatCannotBeginIsNotRecorded) {
  join();
  console.remove_command("map");
  console.add_command("map", "map", [](const con::Args&) { log_error("no such map"); });
  console.execute("record x nowhere");
  EXPECT_FALSE(client.recording()) << "of the game that goes on nothing was asked";
  EXPECT_TRUE(client.connected());
}

TEST_F(Playing, RecordingWhereNothingCanBeWrittenIsASentence) {
  std::ofstream(folder) << "a file in the way";
  join();
  console.execute("record x");
  EXPECT_THAT(log, HasSubstr("x.dem: its directory cannot be made: Not a directory"));
  EXPECT_FALSE(client.recording());
  EXPECT_TRUE(console.failed());
  frames(2);
  EXPECT_TRUE(client.connected());
}

// The process's files may not grow beyond a size, as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(std::uintmax_t bytes) {
    survive_failed_writes();  // as both programs do
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
};

void expect_whole(const stdfs::path& path) {
  const Bytes bytes = read_whole(path);
  auto demo = formats::DemReader::open(bytes, path.string());
  ASSERT_TRUE(demo.ok()) << demo.error().message;
  Bytes last;
  while (!demo->at_end()) {
    const auto message = demo->next();
    ASSERT_TRUE(message.ok()) << message.error().message;
    last.assign(message->data.begin(), message->data.end());
  }
  EXPECT_THAT(last, ElementsAre(net::svc::Disconnect::kCommand.number)) << path;
}

TEST_F(Playing, AFullDiskEndsTheRecordingAloneAndSpoilsNothing) {
  stdfs::create_directories(folder);
  std::ofstream(folder / "x.dem") << "the old one";
  join();
  console.append("record x\n");
  frames(3);
  ASSERT_TRUE(client.recording());
  const auto recorded = stdfs::file_size(folder / "x.dem.part");
  {
    const FullDisk full(recorded);
    frames(2);
  }
  const stdfs::path kept = folder / "x_cut1.dem";
  EXPECT_THAT(log,
              HasSubstr("x.dem.part: cannot be written: File too large; the recording ends here, as " + kept.string()));
  EXPECT_TRUE(console.failed());
  EXPECT_FALSE(client.recording());
  EXPECT_TRUE(client.connected());
  EXPECT_EQ(read_whole(folder / "x.dem").size(), 11u) << "the old one";
  EXPECT_FALSE(stdfs::exists(folder / "x.dem.part"));
  expect_whole(kept);
  EXPECT_LE(stdfs::file_size(kept), recorded);
}

// Whichever byte is the first that does not fit, be it of the demo's end.
TEST_F(Playing, ARecordingIsWholeWhereverTheDiskIsFull) {
  join();
  console.append("record whole\n");
  frames(3);
  console.execute("stop");
  const auto bytes = stdfs::file_size(folder / "whole.dem");
  for (std::uintmax_t room = bytes - 40; room < bytes; ++room) {
    console.append("record y\n");
    {
      const FullDisk full(room);
      frames(3);
      console.execute("stop");
    }
    EXPECT_FALSE(client.recording());
    ASSERT_FALSE(stdfs::exists(folder / "y.dem.part")) << room;
    expect_whole(folder / "y.dem");
    stdfs::remove(folder / "y.dem");
  }
}

}  // namespace
}  // namespace fb::cl
