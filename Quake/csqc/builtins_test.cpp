// The builtins of status bars, apart from bars that mods would draw (mod_hud_test.cpp).
#include <gmock/gmock.h>

#include <bit>
#include <limits>

#include "base/rng.h"
#include "csqc/test_bar.h"
#include "csqc/test_hostile.h"

namespace fb::csqc {
namespace {

using progs::testing::ListedBuiltin;

class BarBuiltinsTest : public BarTest {
 protected:
  // What the expression, a text, is in a bar that draws.
  std::string value(const std::string& expression) {
    put_program("string kept; void(vector size, float scores) CSQC_DrawHud = { kept = strzone(" + expression +
                "); localsound(kept); };");
    ++level;
    sounds.clear();
    frame();
    return sounds.empty() ? "nothing" : sounds.back();
  }
  std::string number(const std::string& expression) { return value("sprintf(\"%g\", " + expression + ")"); }
};

TEST_F(BarBuiltinsTest, TheListIsThatOfTheTable) {
  HudContext context(console, atlas);
  progs::BuiltinTable table = progs::standard_builtins({});
  add_hud_builtins(table, context);
  progs::testing::expect_listed(bar_builtins(), table);
}

TEST_F(BarBuiltinsTest, EachIsCalledOnceWithoutAWrongWord) {
  const std::map<std::string, std::string> special = {
      {"cvar", "\"cl_nocsqc\""},
      {"cvar_set", "\"cl_nocsqc\", \"0\""},
      {"cvar_string", "\"cl_nocsqc\""},
      {"cvar_defstring", "\"cl_nocsqc\""},
      {"registercvar", "\"of_a_bar\", \"1\""},
      {"localcmd", "\"echo hello\\n\""},
      {"remove", "spawn()"},
      {"strunzone", "strzone(\"kept\")"},
      {"fopen", "\"words.txt\", 2"},
      {"putentityfieldstring", "1, spawn(), \"5\""},
      {"changepitch", "spawn()"},
      {"precache_pic", "\"gfx/sb_key1\", 0"},
      {"drawgetimagesize", "\"gfx/sb_key1\""},
      {"drawpic", "'0 0 0', \"gfx/sb_key1\", '8 8 0', '1 1 1', 1, 0"},
      {"drawsubpic", "'0 0 0', '8 8 0', \"gfx/sb_key1\", '0 0 0', '1 1 0', '1 1 1', 1, 0"},
      {"registercommand", "\"of_the_bar\""},
      {"callfunction", "\"nothing_else\""},
      {"buf_del", "buf_create()"},
      {"checkbuiltin", "coredump"}};
  std::string calls;
  int count = 0;
  for (const ListedBuiltin& builtin : bar_builtins()) {
    if (builtin.name == "breakpoint" || builtin.name == "error" || builtin.name == "objerror" ||
        builtin.name == "fgets" || builtin.name == "fputs" || builtin.name == "fclose")
      continue;
    calls += progs::testing::call_of(builtin, special);
    ++count;
  }
  EXPECT_GT(count, 100);
  put_program("void() nothing_else = {}; void(vector size, float scores) CSQC_DrawHud = {\n" + calls +
              "  fputs(1, \"words\"); fclose(1); localsound(\"the end\"); };");
  set_log_level(LogLevel::kWarning);
  fs::LogLines log;
  frame();
  set_log_level(LogLevel::kInfo);
  EXPECT_THAT(log.lines, ::testing::IsEmpty());
  ASSERT_FALSE(sounds.empty());
  EXPECT_EQ(sounds.back(), "the end");
}

// A bar goes on, as the game's own program does.
TEST_F(BarBuiltinsTest, UnknownOnesReturnNothingAndAreToldOfOnce) {
  put_program(
      "float(string s) shader = #999; float() ex_none = #0; void(string s, ...) ex_bprint = #0;"
      "void(vector size, float scores) CSQC_DrawHud = { ex_bprint(\"printed\\n\");"
      "localsound(ftos(shader(\"x\") + ex_none() + 5)); };");
  fs::LogLines log;
  frame();
  frame();
  EXPECT_EQ(sounds, std::vector<std::string>({"5", "5"}));
  EXPECT_THAT(log.lines, ::testing::Contains("printed").Times(2));
  EXPECT_THAT(log.lines, ::testing::Contains(::testing::HasSubstr("builtin #999 is not known here")).Times(1));
  EXPECT_THAT(log.lines, ::testing::Contains(::testing::HasSubstr("the builtin ex_none is not known here")).Times(1));
}

TEST_F(BarBuiltinsTest, Stats) {
  hud.stats[net::kStatHealth] = -5;
  hud.stats[17] = 1000000;
  hud.items = static_cast<std::int32_t>(0x90000003u);
  EXPECT_EQ(number("getstatf(0)"), "-5");
  EXPECT_EQ(number("getstatf(17)"), "1e+06");
  EXPECT_EQ(number("getstatf(15, 0, 2)"), "3");
  EXPECT_EQ(number("getstatf(15, 28, 4)"), "9");
  EXPECT_EQ(number("getstatf(15, 31)"), "1") << "one bit";
  EXPECT_EQ(number("getstatf(15, 0, 32)"), "2.41592e+09");
  EXPECT_EQ(number("getstatf(15, 32, 1)"), "0");
  EXPECT_EQ(number("getstatf(15, -1, 1)"), "0");
  EXPECT_EQ(number("getstatf(32)"), "0");
  EXPECT_EQ(number("getstatf(-1)"), "0");
  EXPECT_EQ(number("strlen(getstats(0))"), "0");
}

TEST_F(BarBuiltinsTest, Players) {
  hud.max_clients = 4;
  hud.scores = {{"ann", 3, 0x14}, {"", 0, 0}, {"bob", 7, 0}};
  EXPECT_EQ(value("getplayerkeyvalue(0, \"name\")"), "ann");
  EXPECT_EQ(value("getplayerkeyvalue(-1, \"name\")"), "bob");
  EXPECT_EQ(value("getplayerkeyvalue(-3, \"name\")"), "");
  EXPECT_EQ(value("getplayerkeyvalue(1, \"name\")"), "");
  EXPECT_EQ(value("getplayerkeyvalue(1, \"viewentity\")"), "2");
  EXPECT_EQ(value("getplayerkeyvalue(99, \"name\")"), "");
  EXPECT_EQ(value("getplayerkeyvalue(0, \"topcolor\")"), "1");
  EXPECT_EQ(value("getplayerkeyvalue(0, \"bottomcolor\")"), "4");
  EXPECT_EQ(value("getplayerkeyvalue(0, \"team\")"), "5");
  EXPECT_EQ(value("getplayerkeyvalue(0, \"bottomcolor_rgb\")"), "0.282353 0.717647 0.501961");
  EXPECT_EQ(number("getplayerkeyfloat(2, \"frags\", 0)"), "7");
  EXPECT_EQ(number("getplayerkeyfloat(2, \"ping\", -1)"), "-1");
}

TEST_F(BarBuiltinsTest, Server) {
  hud.max_clients = 4;
  EXPECT_EQ(value("serverkey(\"mapname\")"), "e1m1");
  EXPECT_EQ(number("serverkeyfloat(\"coop\")"), "1");
  EXPECT_EQ(number("serverkeyfloat(\"maxclients\")"), "4");
  hud.game_type = 1;
  EXPECT_EQ(number("serverkeyfloat(\"coop\")"), "0");
  EXPECT_EQ(number("serverkeyfloat(\"deathmatch\")"), "1");
  console.add_cvar("fraglimit", "20", "");
  EXPECT_EQ(value("serverkey(\"fraglimit\")"), "20");
  EXPECT_EQ(value("serverkey(\"nothing_such\")"), "");
  moment.demo = true;
  EXPECT_EQ(number("isdemo()"), "1");
  EXPECT_EQ(number("isserver()"), "0");
}

TEST_F(BarBuiltinsTest, WidthsAndSizes) {
  EXPECT_EQ(number("stringwidth(\"^1four\", 0, '8 8 0')"), "48");
  EXPECT_EQ(number("stringwidth(\"^1four\", 1, '8 8 0')"), "32");
  EXPECT_EQ(number("stringwidth(\"four\", 1, '16 8 0')"), "64");
  EXPECT_EQ(value("vtos(drawgetimagesize(\"gfx/sb_armor1\"))"), "' 24.0  24.0   0.0'");
  EXPECT_EQ(value("vtos(drawgetimagesize(\"sb_armor1\"))"), "' 24.0  24.0   0.0'");
  EXPECT_EQ(value("vtos(drawgetimagesize(\"gfx/pause.lmp\"))"), "'128.0  24.0   0.0'");
  EXPECT_EQ(value("vtos(drawgetimagesize(\"gfx/pause.tga\"))"), "'128.0  24.0   0.0'") << "another ending";
  EXPECT_EQ(value("vtos(drawgetimagesize(\"gfx/none\"))"), "'  0.0   0.0   0.0'");
}

TEST_F(BarBuiltinsTest, PicturesThatAreMissingAreToldOfOnce) {
  fs::LogLines log;
  EXPECT_EQ(value("precache_pic(\"gfx/none.tga\", 0)"), "gfx/none.tga");
  EXPECT_EQ(value("precache_pic(\"gfx/none.tga\", 512)"), "");
  EXPECT_EQ(log.lines,
            std::vector<std::string>{
                "gfx/none.tga: the mod's status bar asks for this picture, which is missing or cannot be read"});
  EXPECT_EQ(number("iscachedpic(\"gfx/none.tga\")"), "0");
  EXPECT_EQ(number("iscachedpic(\"sb_key2\")"), "0");
  EXPECT_EQ(value("precache_pic(\"sb_key2\", 1)"), "sb_key2");
  EXPECT_EQ(number("iscachedpic(\"sb_key2\")"), "1");
}

// Words that are no sense as anything, and some that are.
TEST(HostileBar, AnyWordsMayBeParameters) {
  set_log_level(LogLevel::kError);
  HostileBar bar;
  ASSERT_EQ(bar.words_of(bar.text()), "^xf80 gfx/box ^{e012}");
  const float inf = std::numeric_limits<float>::infinity();
  const progs::Word words[] = {0,
                               1,
                               0x80000000u,
                               0xffffffffu,
                               0x7fffffffu,
                               bar.text(),
                               progs::as_word(std::numeric_limits<float>::quiet_NaN()),
                               progs::as_word(inf),
                               progs::as_word(-inf),
                               progs::as_word(3e38f),
                               progs::as_word(-1.0f),
                               progs::as_word(0.5f),
                               progs::as_word(100.0f),
                               progs::as_word(8.0f)};
  Rng rng(7);
  int wrong = 0, right = 0;
  for (std::uint32_t function = 1; function < bar.functions(); ++function) {
    for (int round = 0; round < 200; ++round) {
      for (std::uint32_t i = 0; i < 24; ++i) bar.set(i, words[rng.next() % std::size(words)]);
      (bar.call(function, round % 4 != 0) ? right : wrong) += 1;
    }
  }
  set_log_level(LogLevel::kInfo);
  EXPECT_GT(right, 10000);
  EXPECT_GT(wrong, 100);
}

}  // namespace
}  // namespace fb::csqc
