// Saves through a server: what is saved comes back, and what is malformed leaves the game that runs.
#include "server/test_server.h"

namespace fb::sv {
namespace {

using ::testing::HasSubstr;
namespace fields = progs::fields;
namespace globals = progs::globals;

constexpr const char* kSavedGame = R"(
float counter; string word; entity marked; vector place;
void() thinks = { counter = counter + 1; self.health = self.health + 1; self.nextthink = time + 0.1;
  if (counter == 3) remove(find(world, targetname, "victim")); };
void() thing = { setorigin(self, self.origin); setorigin(edict_num(1), '0 0 0'); self.think = thinks; self.nextthink = time + 0.1; self.health = 10; word = "a word"; marked = self;
  self.message = "two\nlines \\ back"; self.enemy = find(world, targetname, "victim"); };
void() victim = { lightstyle(5, "abc"); };
void() PutClientInServer = { self.health = 100; setorigin(self, '100 0 50'); };
)";
constexpr const char* kThings = R"({ "classname" "victim" "targetname" "victim" }
{ "classname" "thing" "targetname" "t" "origin" "1.5 2 3" "alpha" "0.5" }
)";

class ServerSavesTest : public testing::ServerTest {
 protected:
  void start_game() {
    start(kSavedGame, kThings);
    server_->clients()[0].spawn_parms = {1.5f, 2.0f};
  }
  std::string file(const std::string& name) {
    const Bytes& bytes = files_.at(name);
    return {bytes.begin(), bytes.end()};
  }
  void put_file(const std::string& name, const std::string& text) { files_[name] = Bytes(text.begin(), text.end()); }
  std::string error_of_load(const std::string& text) {
    put_file("x.sav", text);
    const Status status = server_->load("x");
    return status.ok() ? "" : status.error().message;
  }
};

TEST_F(ServerSavesTest, WhatIsSavedComesBack) {
  start_game();
  frames(10);
  ASSERT_TRUE(server_->save("first").ok());
  const std::string state = server_->dump();
  const std::string saved = file("first.sav");
  EXPECT_THAT(saved, ::testing::StartsWith("5\nTest__________________kills:__0/__0____\n1.500000\n2.000000\n"));
  frames(10);
  ASSERT_NE(server_->dump(), state);
  ASSERT_TRUE(server_->load("first").ok());
  EXPECT_EQ(server_->dump(), state);
  EXPECT_TRUE(level().paused);
  EXPECT_TRUE(level().loaded);
  EXPECT_EQ(server_->clients()[0].spawn_parms[0], 1.5f);
  EXPECT_EQ(level().light_styles.at(5), "abc");
  EXPECT_TRUE(level().edicts().is_free(EdictId{2}));
  EXPECT_EQ(level().extra(EdictId{3}).alpha, net::encode_alpha(0.5f));
  EXPECT_EQ(text(edict(3).get(fields::message)), "two\nlines \\ back");
  EXPECT_EQ(level().vm->get(global<EdictId>("marked")), EdictId{3});
  ASSERT_TRUE(server_->save("second").ok());
  EXPECT_EQ(file("second.sav"), saved);
}

// The re-release's, of the game that is played; of another nothing is loaded, and what runs goes on.
// Runes: a saved game that has them keeps them where the level starts over, and one that has none gets none.
TEST_F(ServerSavesTest, ALevelThatStartsOverHasTheFlagsOfTheSavedGame) {
  start_game();
  ASSERT_TRUE(server_->save("none").ok());
  level().vm->set(globals::serverflags, 5.0f);
  ASSERT_TRUE(server_->save("two").ok());
  level().vm->set(globals::serverflags, 0.0f);
  for (const auto& [name, flags] : {std::pair("two", 5.0f), std::pair("none", 0.0f)}) {
    ASSERT_TRUE(server_->load(name).ok());
    EXPECT_EQ(level().vm->get(globals::serverflags), flags) << name;
    ASSERT_TRUE(server_->restart().ok());
    EXPECT_EQ(level().vm->get(globals::serverflags), flags) << name;
  }
}

TEST_F(ServerSavesTest, Version6IsLoadedInItsGame) {
  start_game();
  frames(10);
  ASSERT_TRUE(server_->save("first").ok());
  const std::string state = server_->dump();
  const std::string rest = file("first.sav").substr(2);
  frames(10);
  EXPECT_EQ(error_of_load("6\nID1\n" + rest), "");
  EXPECT_EQ(server_->dump(), state);
  EXPECT_EQ(error_of_load("6\nhipnotic\n" + rest),
            "x.sav: a saved game of \"hipnotic\", and \"id1\" is played; `game hipnotic` changes that");
  EXPECT_EQ(server_->dump(), state);
}

// Two games from one save go the same way, also by way of another server.
TEST_F(ServerSavesTest, TheGameGoesOnTheSame) {
  start_game();
  frames(7);
  ASSERT_TRUE(server_->save("game").ok());
  const auto played_on = [&] {
    EXPECT_TRUE(server_->load("game").ok());
    EXPECT_TRUE(server_->run(5.0, 0.05).ok());
    return server_->dump();
  };
  const std::string once = played_on();
  EXPECT_EQ(played_on(), once);
  make_server();
  EXPECT_EQ(played_on(), once);
  EXPECT_THAT(once, HasSubstr("time 6.9"));
}

TEST_F(ServerSavesTest, APlayerFindsWhatItLeft) {
  start_game();
  {
    const Player player = join();
    edict(1).set(fields::health, 42.0f);
    ASSERT_TRUE(server_->save("game").ok());
  }
  int started = 0;
  server_->set_local_start([&] { ++started; });
  ASSERT_TRUE(server_->load("game").ok());
  EXPECT_EQ(started, 1);
  const Player player = join();
  EXPECT_EQ(edict(1).get(fields::health), 42.0f);
  EXPECT_FALSE(level().paused);
}

TEST_F(ServerSavesTest, NoMomentToSave) {
  put_progs(std::string(testing::kModSource) + kSavedGame + "float intermission_running;");
  put_map("test", room(), kThings);
  make_server();
  EXPECT_THAT(server_->save("x").error().message, HasSubstr("no game runs"));
  ASSERT_TRUE(server_->map("test").ok());
  for (const char* name : {"../x", "/x", "", "a/../../x", "c:x", "a\nb"})
    EXPECT_FALSE(server_->save(name).ok()) << name;
  EXPECT_TRUE(server_->save("folder/x").ok());
  level().vm->set(global<float>("intermission_running"), 1.0f);
  EXPECT_THAT(server_->save("x").error().message, HasSubstr("intermission"));
  level().vm->set(global<float>("intermission_running"), 0.0f);
  {
    const Player player = join();
    edict(1).set(fields::health, 0.0f);
    EXPECT_THAT(server_->save("x").error().message, HasSubstr("dead player"));
  }
  server_->shutdown();
  ASSERT_TRUE(server_->set_max_clients(2).ok());
  ASSERT_TRUE(server_->map("test").ok());
  EXPECT_THAT(server_->save("x").error().message, HasSubstr("several players"));
  EXPECT_THAT(server_->load("folder/x").error().message, HasSubstr("for one player"));
}

TEST_F(ServerSavesTest, MalformedSavesLeaveTheGameRunning) {
  start_game();
  frames(5);
  ASSERT_TRUE(server_->save("good").ok());
  const std::string good = file("good.sav"), state = server_->dump();
  const auto with = [&](const std::string& what, const std::string& by) {
    std::string text = good;
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
  };
  EXPECT_THAT(error_of_load(""), HasSubstr("x.sav: no saved game"));
  EXPECT_THAT(error_of_load(with("5\n", "4\n")), HasSubstr("version 4"));
  EXPECT_THAT(error_of_load(with("\ntest\n", "\nnowhere\n")), HasSubstr("maps/nowhere.bsp: no such map"));
  EXPECT_THAT(error_of_load(with("\ntest\n", "\n../test\n")), HasSubstr("no name of a map"));
  EXPECT_THAT(error_of_load(with("\"thinks\"", "\"nothing\"")), HasSubstr("which there is not"));
  EXPECT_THAT(error_of_load(with("{", "x")), HasSubstr("where a { should be"));
  EXPECT_THAT(error_of_load(good.substr(0, good.size() - 5)), HasSubstr("x.sav: "));
  EXPECT_THAT(error_of_load(good.substr(0, good.find('{'))), HasSubstr("has no player"));
  std::string many = good;
  for (int i = 0; i < 33000; ++i) many += "{}\n";
  EXPECT_THAT(error_of_load(many), HasSubstr("beyond the 32000"));
  EXPECT_THAT(server_->load("none").error().message, HasSubstr("none.sav: no such saved game"));
  EXPECT_FALSE(server_->load("../good").ok());
  EXPECT_TRUE(server_->active() || server_->last_error().has_value()) << "why nothing runs";
  EXPECT_EQ(server_->dump(), state);
  EXPECT_EQ(error_of_load(good), "");
}

}  // namespace
}  // namespace fb::sv
