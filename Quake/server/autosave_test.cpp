// When a game saves itself, and what a dead player goes back to.
#include "server/autosave.h"

#include <algorithm>

#include "fs/test_log.h"
#include "server/test_server.h"

namespace fb::sv {
namespace {

namespace fields = progs::fields;
namespace globals = progs::globals;

constexpr double kTick = 0.1, kInterval = 30.0;

// A player who plays; every tick the next moment.
class Play {
 public:
  explicit Play(bool loaded = false) : autosave_(loaded) {}
  Autosave::Moment now{1.0, 100.0f, 0.0f, 0.0f, false, true};
  // Plays on; when it saved itself first, seconds after the call. Negative: never.
  double until_save(double seconds, double interval = kInterval) {
    const double start = now.time;
    for (double passed = 0.0; passed < seconds; passed += kTick) {
      now.time = start + passed;
      if (!autosave_.due(now, interval)) continue;
      autosave_.saved(now.time);
      return passed;
    }
    return -1.0;
  }
  Autosave& autosave() { return autosave_; }

 private:
  Autosave autosave_;
};

TEST(Autosave, SavesWhenALevelBeginsAndThenInIntervals) {
  Play play;
  EXPECT_DOUBLE_EQ(play.until_save(1.0), 0.0);
  EXPECT_NEAR(play.until_save(100.0), kInterval, 2 * kTick);
  EXPECT_NEAR(play.until_save(100.0), kInterval, 2 * kTick);
  EXPECT_LT(play.until_save(1000.0, 0.0), 0.0) << "an interval of 0";
}

TEST(Autosave, WaitsUntilThePlayerStands) {
  Play play;
  play.now.safe = false;
  EXPECT_LT(play.until_save(5.0), 0.0);
  play.now.safe = true;
  EXPECT_DOUBLE_EQ(play.until_save(5.0), 0.0);
}

TEST(Autosave, NotInAFight) {
  for (const char* what : {"hurt", "armour", "attacks"}) {
    Play play;
    play.now.armor = 50.0f;
    play.until_save(1.0);
    EXPECT_LT(play.until_save(kInterval - 1.0), 0.0);
    for (int i = 0; i < 40; ++i) {  // a second each
      if (what == std::string_view("hurt")) play.now.health -= 1.0f;
      if (what == std::string_view("armour")) play.now.armor -= 1.0f;
      if (what == std::string_view("attacks")) play.now.attacks = true;
      EXPECT_LT(play.until_save(1.0), 0.0) << what << " " << i;
    }
    play.now.attacks = false;
    EXPECT_NEAR(play.until_save(30.0), 3.1, 2.0) << what << ": four seconds of peace";
  }
}

TEST(Autosave, ASecretIsSavedSoon) {
  Play play;
  play.until_save(1.0);
  EXPECT_LT(play.until_save(10.0), 0.0);
  play.now.secrets = 1.0f;
  EXPECT_DOUBLE_EQ(play.until_save(10.0), 0.0);
  EXPECT_LT(play.until_save(10.0), 0.0) << "once";
  play.now.secrets = 2.0f;
  play.now.attacks = true;
  EXPECT_LT(play.until_save(10.0), 0.0);
  play.now.attacks = false;
  EXPECT_NEAR(play.until_save(10.0), 1.0, 2 * kTick);
}

TEST(Autosave, AfterLoadingAndAfterTheOwnSaveOfThePlayerTheIntervalBeginsAnew) {
  Play play(true);
  EXPECT_NEAR(play.until_save(100.0), kInterval, 2 * kTick);
  EXPECT_LT(play.until_save(20.0), 0.0);
  play.autosave().saved(play.now.time);
  EXPECT_NEAR(play.until_save(100.0), kInterval, 2 * kTick);
}

constexpr const char* kGame = R"(
void() thing = { };
void() PutClientInServer = { self.health = 100; self.movetype = 3; self.solid = 3; setsize(self, '-16 -16 -24', '16 16 32'); setorigin(self, '0 0 50'); };
float intermission_running;
)";

class AutosaveGame : public testing::ServerTest {
 protected:
  void start_game(const ServerOptions& options = {.autosaves = true}) {
    start(kGame, "", options);
    if (!HasFatalFailure()) player_ = join();
  }
  bool saved() const { return files_.contains("autosave/test.sav"); }
  void play(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kTick); ++i) {
      frames(1);
      hear(player_);
    }
  }
  // Another player in the place of the former one.
  void join_again() {
    player_ = {};
    frames(1);
    player_ = join();
  }
  void die() { edict(1).set(fields::health, 0.0f); }
  float health() { return edict(1).get(fields::health); }
  Player player_;
};

TEST_F(AutosaveGame, WritesTheMapsAutosave) {
  std::string told;
  start_game();
  server_->set_saved([&](const std::string& name) { told = name; });
  play(3.0);
  ASSERT_TRUE(saved());
  files_.erase("autosave/test.sav");
  play(20.0);
  EXPECT_FALSE(saved());
  play(11.0);
  EXPECT_TRUE(saved());
  EXPECT_EQ(told, "autosave/test");
  EXPECT_TRUE(server_->load("autosave/test").ok());
}

TEST_F(AutosaveGame, NotWhereItShouldNot) {
  start_game({});
  play(40.0);
  EXPECT_FALSE(saved()) << "a server that does not ask for it";
  make_server({.autosaves = true});
  ASSERT_TRUE(server_->map("test").ok());
  console_.set("sv_autosave", "0");
  player_ = join();
  play(40.0);
  EXPECT_FALSE(saved()) << "sv_autosave 0";
  die();
  console_.set("sv_autosave", "1");
  play(5.0);
  EXPECT_FALSE(saved()) << "dead";
  edict(1).set(fields::health, 100.0f);
  level().vm->set(global<float>("intermission_running"), 1.0f);
  play(40.0);
  EXPECT_FALSE(saved()) << "intermission";
  level().vm->set(global<float>("intermission_running"), 0.0f);
  server_->hold(true);
  play(40.0);
  EXPECT_FALSE(saved()) << "time stands";
  server_->hold(false);
  edict(1).set(fields::movetype, 8.0f);
  play(40.0);
  EXPECT_FALSE(saved()) << "noclip";
  edict(1).set(fields::movetype, 3.0f);
  play(40.0);
  EXPECT_TRUE(saved());
  files_.erase("autosave/test.sav");
  server_->shutdown();
  ASSERT_TRUE(server_->set_max_clients(2).ok());
  ASSERT_TRUE(server_->map("test").ok());
  player_ = join();
  play(40.0);
  EXPECT_FALSE(saved()) << "several players";
}

TEST_F(AutosaveGame, WhatCannotBeWrittenIsToldOnce) {
  start_game();
  server_.reset();
  ServerServices services;
  services.read_file = [this](std::string_view name) -> std::optional<Bytes> {
    const auto found = files_.find(std::string(name));
    return found == files_.end() ? std::nullopt : std::optional(found->second);
  };
  services.write_file = [](std::string_view name, ByteView) {
    return Status(Error{std::string(name) + ": disk full"});
  };
  server_ = std::make_unique<Server>(console_, services, ServerOptions{.autosaves = true});
  server_->clients().add_listener(listener_);
  ASSERT_TRUE(server_->map("test").ok());
  const fs::LogLines log;
  player_ = join();
  play(100.0);
  EXPECT_EQ(std::ranges::count(log.lines, "autosave/test.sav: disk full"), 1);
  EXPECT_TRUE(server_->active());
}

TEST_F(AutosaveGame, ADeadPlayerGoesBackToTheLastSave) {
  start_game();
  play(3.0);
  ASSERT_TRUE(saved());
  die();
  EXPECT_EQ(server_->save_after_death(), "autosave/test");
  console_.set("sv_autosave", "0");
  edict(1).set(fields::health, 42.0f);
  ASSERT_TRUE(server_->save("mine").ok());
  console_.execute("restart");
  EXPECT_FALSE(level().loaded) << "alive: the level starts over";
  join_again();
  die();
  EXPECT_EQ(server_->save_after_death(), "mine");
  console_.execute("restart");
  EXPECT_TRUE(level().loaded);
  console_.execute("restart");
  EXPECT_TRUE(level().loaded) << "QuakeC says it in every tick, of which a slow frame has several";
  join_again();
  EXPECT_EQ(health(), 42.0f);
  edict(1).set(fields::deadflag, 2.0f);
  EXPECT_EQ(server_->save_after_death(), "mine") << "kill";
  edict(1).set(fields::deadflag, 0.0f);
  EXPECT_EQ(server_->save_after_death(), "");
  die();
  console_.execute("restart level");
  EXPECT_FALSE(level().loaded);
  join_again();
  die();
  console_.set("sv_autoload", "0");
  console_.execute("restart");
  EXPECT_FALSE(level().loaded);
  join_again();
  die();
  std::string offered;
  server_->set_offer_load([&](const std::string& name) { offered = name; });
  console_.set("sv_autoload", "1");
  console_.execute("restart");
  EXPECT_EQ(offered, "mine");
  console_.set("sv_autoload", "2");
  files_.erase("mine.sav");
  console_.execute("restart");
  EXPECT_TRUE(server_->active());
  EXPECT_FALSE(level().loaded) << "a save that is gone";
  ASSERT_TRUE(server_->map("test").ok());
  join_again();
  die();
  EXPECT_EQ(server_->save_after_death(), "") << "of another game";
}

}  // namespace
}  // namespace fb::sv
