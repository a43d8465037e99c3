// A game whose mod draws its own status bar, from the console's `map` to the draw list; and what modcheck says of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "base/log.h"
#include "base/test_directory.h"
#include "formats/test_bsp.h"
#include "host/game/engine.h"
#include "host/game/key_router.h"
#include "host/game/menu_facts.h"
#include "host/game/screen.h"
#include "progs/test_builtin_list.h"
#include "progs/test_compile.h"
#include "server/simulation/test_map.h"

namespace fb::host {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kRules = R"(
void() nothing_known = #900;
void() worldspawn = { if (cvar("r_of_others")) nothing_known(); if (checkextension("DP_NONE_SUCH")) nothing_known(); };
void() PutClientInServer = { self.health = 77; setorigin(self, '0 0 64'); };
void() ClientConnect = {}; void() ClientDisconnect = {}; void() ClientKill = {}; void() StartFrame = {};
void() PlayerPreThink = {}; void() PlayerPostThink = {}; void() SetNewParms = {}; void() SetChangeParms = {};
)";
// A green square for each point of health, and in the second level an error.
constexpr const char* kBar = R"(
void() missing;
void(string name) shader = #901;
void(vector size, float scores) CSQC_DrawHud = {
  local float i;
  for (i = 0; i < getstatf(0, 0, 32); i = i + 1) drawfill('1 0 0' * i, '1 1 0', '0 1 0', 1, 0);
  if (mapname == "second") missing();
};
void() CSQC_WorldLoaded = { shader("x"); };
)";

class ModBarTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!progs::testing::compile("void() main = {};").has_compiler) GTEST_SKIP() << "fteqcc is not installed";
    put_program("progs.dat", {"Of every program", "Of the server's program"}, kRules);
    put_program("csprogs.dat", {"Of every program", "Of a status bar's program"}, kBar);
    const auto room = sv::testing::MapBuilder(vec3(-512, -512, 0), vec3(512, 512, 256)).build();
    for (const char* name : {"first", "second"})
      game.put(std::string("id1/maps/") + name + ".bsp", formats::testing::write_bsp(room));
    handle = add_log_listener([this](LogLevel, std::string_view line) { log.emplace_back(line); });
    auto made = Engine::create({"-basedir", game.path().string(), "-nohome", "-nolan"});
    ASSERT_TRUE(made.ok()) << made.error().message;
    engine = std::move(*made);
    facts = std::make_unique<MenuFacts>(*engine);
    keys = std::make_unique<KeyRouter>(engine->console(), *facts);
    screen = std::make_unique<Screen>(engine->console(), csqc::ModHudServices{.read_file = engine->files().loader()},
                                      *keys, engine->rules());
  }
  void TearDown() override {
    screen.reset();
    keys.reset();
    facts.reset();
    engine.reset();
    if (handle != 0) remove_log_listener(handle);
  }
  void put_program(const std::string& name, const std::set<std::string>& builtins, const std::string& source) {
    const auto compiled =
        progs::testing::compile(progs::testing::declarations(progs::testing::listed_builtins(builtins)) + source);
    ASSERT_FALSE(compiled.progs.empty()) << compiled.output;
    game.put("id1/" + name, compiled.progs);
  }
  // Frames, of which the last is drawn: how many green squares it has.
  std::ptrdiff_t green_after(const std::string& command, int frames = 30) {
    FrameTimer timer;
    engine->console().append(command + "\n");
    std::ptrdiff_t green = 0;
    for (int i = 0; i < frames; ++i) {
      now += 0.05;
      engine->execute_commands(now);
      engine->frame(timer.plan(0.05, read_time_settings(engine->console())), vec2(0.0f), now);
      const auto& quads = screen->draw(engine->client(), {{640, 400}, now, 0.05, false}).quads;
      green = std::count_if(quads.begin(), quads.end(),
                            [](const scene::DrawQuad& quad) { return quad.color == vec4(0, 1, 0, 1); });
    }
    return green;
  }

  const TestDirectory game;
  std::vector<std::string> log;
  int handle = 0;
  double now = 1.0;
  std::unique_ptr<Engine> engine;
  std::unique_ptr<MenuFacts> facts;
  std::unique_ptr<KeyRouter> keys;
  std::unique_ptr<Screen> screen;
};

TEST_F(ModBarTest, IsShownInEachLevelAndNoneOfItsErrorsEndsTheGame) {
  EXPECT_EQ(green_after(""), 0);
  EXPECT_EQ(green_after("map first"), 77);
  EXPECT_EQ(green_after("cl_nocsqc 1", 1), 0);
  EXPECT_EQ(green_after("cl_nocsqc 0", 1), 77);
  log.clear();
  EXPECT_EQ(green_after("changelevel second"), 0);
  EXPECT_THAT(log, Contains(HasSubstr("the game's own status bar is shown until the next level")).Times(1));
  EXPECT_TRUE(engine->client().active()) << "the game goes on";
  EXPECT_EQ(green_after("changelevel first"), 77);
  EXPECT_EQ(green_after("disconnect", 2), 0);
  EXPECT_FALSE(engine->went_wrong());
}

TEST_F(ModBarTest, ModcheckNamesWhatIsMissing) {
  engine->console().execute("modcheck");
  EXPECT_THAT(
      log,
      Contains(
          "progs.dat calls builtin #900 (nothing_known), which is not known here: a call does nothing and returns 0."));
  EXPECT_THAT(log, Contains("progs.dat asks for the extension DP_NONE_SUCH, and is told that it is not there."));
  EXPECT_THAT(log, Contains("progs.dat reads the cvar r_of_others, which is not here: it reads 0."));
  EXPECT_THAT(log, Contains(HasSubstr("progs.dat: 3 things are missing here; it uses 4 builtins")));
  EXPECT_THAT(
      log,
      Contains("csprogs.dat calls builtin #901 (shader), which is not known here: a call does nothing and returns 0."));
  EXPECT_THAT(log, Contains("csprogs.dat has the function CSQC_WorldLoaded, which is never called here."));
  EXPECT_THAT(log, Not(Contains(HasSubstr("drawfill"))));
  log.clear();
  game.put("id1/csprogs.dat", std::string_view("no program"));
  engine->console().execute("modcheck");
  EXPECT_THAT(log, Contains(HasSubstr("csprogs.dat: offset")));
}

}  // namespace
}  // namespace fb::host
