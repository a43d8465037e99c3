// Saves of QuakeSpasm's and ours, on LibreQuake's maps under the rules of testdemos/rules: each loads what the other
// has saved, and saves it again as it was; and a level that has just begun is the same in both, to the last letter of
// its save. Skipped where QuakeSpasm, the data or the compiler is absent.
#include <gtest/gtest.h>

#include "base/log.h"
#include "base/test_directory.h"
#include "fs/filesystem.h"
#include "server/server.h"
#include "server/simulation/test_rules.h"
#include "server/test_quakespasm.h"

namespace fb::sv {
namespace {

namespace stdfs = std::filesystem;

// No chance in it but what is worked out in whole numbers.
constexpr const char* kMonsters = R"qc(
entity(vector o, float radius) findradius = #22;
float(float yaw, float distance) walkmove = #32;
float() droptofloor = #34;
float(float f) floor = #37;
float(entity e) checkbottom = #40;
void(string s) localcmd = #46;
void() changeyaw = #49;
vector(vector v) vectoangles = #51;
float seed, finished;
float(float n) chance = {
  seed = seed * 109 + 1021;
  seed = seed - floor(seed / 65536) * 65536;
  return floor(seed * n / 65536);
};
void() barrel_explode = {};
void() StartFrame = {
  if (time < 10 || finished) return;
  finished = 1;
  localcmd("save later\nquit\n");
};
void() thrown_touch = {
  self.frags = self.frags + 1;
  if (other.takedamage) { other.health = other.health - 5; remove(self); }
};
void() throw_thing = {
  local entity thing;
  thing = spawn();
  thing.owner = self;
  thing.classname = "thrown";
  thing.solid = SOLID_BBOX;
  thing.movetype = 9 + chance(2);
  thing.touch = thrown_touch;
  setmodel(thing, "progs/missile.mdl");
  setsize(thing, '0 0 0', '0 0 0');
  setorigin(thing, self.origin + '0 0 8');
  makevectors(self.angles);
  thing.velocity = v_forward * (200 + chance(400)) + v_up * chance(300);
  thing.avelocity = '300 200 100';
  thing.angles = vectoangles(thing.velocity);
  thing.think = SUB_Remove;
  thing.nextthink = time + 1 + chance(3);
};
float() first_delay = { return chance(10) * 0.05; };
void() monster_think = {
  local entity near;
  self.nextthink = time + 0.1;
  if (chance(5) == 0) self.ideal_yaw = chance(360);
  changeyaw();
  if (!walkmove(self.angles_y, 8)) self.ideal_yaw = self.ideal_yaw + 90;
  if (!checkbottom(self)) self.frags = self.frags + 1;
  if (chance(10) == 0) throw_thing();
  near = findradius(self.origin, 300);
  while (near) {
    if (near != self && near.takedamage) {
      traceline(self.origin, near.origin, FALSE, self);
      if (trace_ent == near) self.enemy = near;
    }
    near = near.chain;
  }
  if (self.health < 0) { self.think = SUB_Remove; self.solid = SOLID_NOT; }
};
)qc";

std::string text_of(const stdfs::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// What depends on who saved: the comment's name and kills, which QuakeSpasm's client knows.
std::string without_comment(const std::string& save) {
  const auto first = save.find('\n'), second = save.find('\n', first + 1);
  return second == std::string::npos ? save : save.substr(0, first) + save.substr(second);
}

class QuakeSpasmSaves : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    set_log_level(LogLevel::kError);
    if (const std::string lacks = testing::quakespasm_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
    if (!progs::testing::compile("void() main = {};").has_compiler) GTEST_SKIP() << progs::testing::no_compiler();
    game_ = folder_.filename().string();  // QuakeSpasm saves below the user's home: under a name that nobody has
    stdfs::create_directories(folder_ / "id1");
    stdfs::create_directories(folder_ / game_);
    for (const auto& entry : stdfs::directory_iterator(stdfs::absolute(librequake_folder()) / "id1"))
      stdfs::create_symlink(entry.path(), folder_ / "id1" / entry.path().filename());
  }
  void put_rules(const std::string& more) {
    const Bytes rules = testing::compile_rules(more);
    ASSERT_FALSE(rules.empty()) << "testdemos/rules do not compile";
    directory_.put(game_ + "/progs.dat", rules);
    fs::FsOptions options;
    options.base_dir = folder_;
    options.user_dir = "";
    options.games = {game_};
    auto opened = fs::FileSystem::open(options);
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    files_.emplace(std::move(*opened));
  }
  void TearDown() override {
    set_log_level(LogLevel::kInfo);
    if (!saves_.empty()) stdfs::remove_all(saves_);
  }

  void run_quakespasm(const std::string& commands) {
    const std::string command =
        fmt::format("cd '{}' && timeout 60 '{}' -dedicated 1 -basedir . -game {} -port {} {} >out.txt 2>&1 </dev/null",
                    folder_.string(), testing::quakespasm_program(), game_, testing::quakespasm_port(), commands);
    (void)std::system(command.c_str());
    const std::string output = text_of(folder_ / "out.txt"), mark = "Saving game to ";
    const auto at = output.rfind(mark);
    ASSERT_NE(at, std::string::npos) << output;
    const auto start = at + mark.size();
    saves_ = stdfs::path(output.substr(start, output.find("...", start) - start)).parent_path();
    ASSERT_EQ(saves_.filename().string(), game_);
  }
  // Ours: after these steps, what is saved.
  template <typename Steps>
  std::string our_save(Steps&& steps) {
    con::Console console;
    ServerServices services;
    services.read_file = [this](std::string_view name) {
      return name == "theirs.sav" ? std::optional(Bytes(theirs_.begin(), theirs_.end())) : files_->read(name);
    };
    std::string saved;
    services.write_file = [&](std::string_view, ByteView data) {
      saved.assign(data.begin(), data.end());
      return ok_status();
    };
    Server server(console, services);
    Status status = steps(server);
    if (status) status = server.save("ours");
    EXPECT_TRUE(status.ok()) << status.error().message;
    return saved;
  }

  const TestDirectory directory_;
  const stdfs::path folder_ = directory_.path();
  stdfs::path saves_;
  std::string game_, theirs_;
  std::optional<fs::FileSystem> files_;
};

TEST_P(QuakeSpasmSaves, LoadHereAndThere) {
  const std::string map = GetParam();
  ASSERT_NO_FATAL_FAILURE(put_rules("void() barrel_explode = {};"));
  ASSERT_NO_FATAL_FAILURE(run_quakespasm(fmt::format("+map {} +save new +load new +save again +quit", map)));
  theirs_ = text_of(saves_ / "new.sav");
  ASSERT_FALSE(theirs_.empty());
  EXPECT_EQ(without_comment(our_save([&](Server& server) { return server.map(map); })), without_comment(theirs_));

  const std::string ours = our_save([](Server& server) { return server.load("theirs"); });
  EXPECT_EQ(without_comment(ours), without_comment(text_of(saves_ / "again.sav")));

  std::ofstream(saves_ / "ours.sav") << ours;
  ASSERT_NO_FATAL_FAILURE(run_quakespasm("+load ours +save back +quit"));
  EXPECT_EQ(without_comment(text_of(saves_ / "back.sav")), without_comment(ours));
}

TEST_P(QuakeSpasmSaves, TenSecondsLater) {
  const std::string map = GetParam();
  ASSERT_NO_FATAL_FAILURE(put_rules(std::string(kMonsters) + testing::kInhabitants));
  ASSERT_NO_FATAL_FAILURE(run_quakespasm(fmt::format("+sys_ticrate 0.001 +host_framerate 0.05 +map {}", map)));
  const std::string theirs = text_of(saves_ / "later.sav");
  ASSERT_NE(theirs.find("\"finished\" \"1.000000\""), std::string::npos) << theirs;
  const std::string ours = our_save([&](Server& server) {
    Status status = server.map(map);
    const auto finished = server.level()->vm->program().global<float>("finished");
    for (int i = 0; status && i < 1000 && server.level()->vm->get(finished) == 0.0f; ++i)
      status = server.run(0.05, static_cast<double>(0.05f));
    return status;
  });
  EXPECT_EQ(without_comment(ours), without_comment(theirs));
}

INSTANTIATE_TEST_SUITE_P(Maps, QuakeSpasmSaves, ::testing::Values("start", "lq_e0m1", "lq_e0m2", "lq_e1m7"));

}  // namespace
}  // namespace fb::sv
