// LibreQuake's maps under the rules of testdemos/rules and the monsters, items and lamps below, as a dedicated server
// runs them. Skipped where the data or the compiler is absent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/log.h"
#include "fs/filesystem.h"
#include "server/server.h"
#include "server/simulation/test_rules.h"
#include "server/test_librequake.h"

namespace fb::sv {
namespace {

// Walks about by chance, looks around itself, and shoots what it finds.
constexpr const char* kMonsters = R"qc(
float() random = #7;
entity(vector o, float radius) findradius = #22;
float(float yaw, float distance) walkmove = #32;
float() droptofloor = #34;
float(entity e) checkbottom = #40;
entity() checkclient = #17;
void() changeyaw = #49;
void(float step) movetogoal = #67;
void(entity e) makestatic = #69;
void(vector o, string sample, float volume, float attenuation) ambientsound = #74;
void(vector o, vector d, float color, float count) particle = #48;
float() first_delay = { return random() * 0.5; };
void() monster_think = {
  local entity near;
  self.nextthink = time + 0.1;
  if (random() < 0.2) self.ideal_yaw = random() * 360;
  changeyaw();
  if (random() < 0.5) movetogoal(8);
  else if (!walkmove(self.angles_y, 8)) self.ideal_yaw = self.ideal_yaw + 90;
  near = findradius(self.origin, 200);
  while (near) {
    if (near != self && near.takedamage) {
      traceline(self.origin, near.origin, FALSE, self);
      if (trace_ent == near) { near.health = near.health - 1; particle(trace_endpos, '0 0 1', 73, 4); }
    }
    near = near.chain;
  }
  if (checkclient()) self.frags = self.frags + 1;
  if (self.health < 0) { self.think = SUB_Remove; self.solid = SOLID_NOT; }
};
void() light = { remove(self); };
void() barrel_explode = { remove(self); };
void() light_torch_small_walltorch = { precache_model("progs/flame.mdl"); setmodel(self, "progs/flame.mdl");
  precache_sound("ambience/fire1.wav"); ambientsound(self.origin, "ambience/fire1.wav", 0.5, 3); makestatic(self); };
)qc";

class LibreQuake : public ::testing::Test {
 protected:
  void SetUp() override {
    set_log_level(LogLevel::kError);
    if (const std::string lacks = testing::game_data_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
    auto opened = fs::FileSystem::open(testing::game_data_options());
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    files_.emplace(std::move(*opened));
    if (!progs::testing::compile("void() main = {};").has_compiler) GTEST_SKIP() << progs::testing::no_compiler();
    static const Bytes rules = testing::compile_rules(std::string(kMonsters) + testing::kInhabitants);
    ASSERT_FALSE(rules.empty()) << "testdemos/rules do not compile";
    written_["progs.dat"] = rules;
  }
  void TearDown() override { set_log_level(LogLevel::kInfo); }

  // Files that are written stay in memory.
  std::unique_ptr<Server> make_server(con::Console& console, Rng& rng) {
    ServerServices services;
    services.read_file = [this](std::string_view name) {
      const auto found = written_.find(std::string(name));
      return found == written_.end() ? files_->read(name) : std::optional(found->second);
    };
    services.game_index_of = [this](std::string_view name) { return files_->game_index_of(name); };
    services.write_file = [this](std::string_view name, ByteView data) {
      written_[std::string(name)] = Bytes(data.begin(), data.end());
      return ok_status();
    };
    services.rng = &rng;
    return std::make_unique<Server>(console, services);
  }
  // The state behind some seconds of a map, alone.
  std::string played(const std::string& map, std::uint64_t seed, double seconds, double step = 0.05) {
    con::Console console;
    Rng rng(seed);
    const auto server = make_server(console, rng);
    Status status = server->map(map);
    if (status) status = server->run(seconds, step);
    EXPECT_TRUE(status.ok()) << map << ": " << status.error().message;
    return server->dump();
  }

  std::optional<fs::FileSystem> files_;
  std::map<std::string, Bytes> written_;
};

TEST_F(LibreQuake, EveryMapSpawnsAndRuns) {
  int maps = 0;
  for (const fs::FoundFile& file : files_->find("maps/", ".bsp")) {
    const std::string name = file.name.substr(5, file.name.size() - 9);
    if (name.starts_with("b_")) continue;  // boxes of ammunition, which are models
    SCOPED_TRACE(name);
    EXPECT_NE(played(name, 1, 2.0, 0.1), "");
    ++maps;
  }
  EXPECT_GE(maps, 5);
}

TEST_F(LibreQuake, TheSameSeedIsTheSameGame) {
  const std::string once = played("lq_e0m1", 7, 10.0);
  EXPECT_EQ(played("lq_e0m1", 7, 10.0), once);
  EXPECT_NE(played("lq_e0m1", 8, 10.0), once);
  EXPECT_GT(once.size(), 10000u);
}

TEST_F(LibreQuake, SavesComeBack) {
  con::Console console;
  Rng rng(3);
  const auto server = make_server(console, rng);
  ASSERT_TRUE(server->map("lq_e0m1").ok());
  ASSERT_TRUE(server->run(5.0, 0.05).ok());
  // A load links everything, as QuakeSpasm's does, also what QuakeC never did: so that save comes back which is made of
  // a game that was loaded.
  ASSERT_TRUE(server->save("start").ok());
  ASSERT_TRUE(server->load("start").ok());
  ASSERT_TRUE(server->save("first").ok());
  const std::string state = server->dump();
  ASSERT_TRUE(server->run(5.0, 0.05).ok());
  EXPECT_NE(server->dump(), state);
  const auto played_on = [&] {
    const Status status = server->load("first");
    EXPECT_TRUE(status.ok()) << status.error().message;
    EXPECT_EQ(server->dump(), state);
    rng = Rng(9);
    EXPECT_TRUE(server->run(10.0, 0.05).ok());
    return server->dump();
  };
  const std::string once = played_on();
  EXPECT_EQ(played_on(), once);
  ASSERT_TRUE(server->load("first").ok());
  ASSERT_TRUE(server->save("second").ok());
  EXPECT_TRUE(written_.at("second.sav") == written_.at("first.sav"));
}

}  // namespace
}  // namespace fb::sv
