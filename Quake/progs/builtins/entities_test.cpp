#include <gmock/gmock.h>

#include "console/console.h"
#include "progs/test_qc.h"

namespace fb::progs {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class EntityBuiltinsTest : public testing::QcTest {};

TEST_F(EntityBuiltinsTest, SpawnAndRemove) {
  EXPECT_EQ(says("local entity a, b; a = spawn(); b = spawn(); pute(a); pute(b); remove(a); put(wasfreed(a));"
                 "pute(spawn());"),
            "e2 e3 1 e2");  // time 0: used again at once
  options_.max_edicts = 8;
  EXPECT_THAT(says("while (1) spawn();"), HasSubstr("no free edicts: all 8 (max_edicts) are in use"));
  EXPECT_EQ(says("remove(world); remove(edict_num(1)); put(wasfreed(world));"), "0");
}

TEST_F(EntityBuiltinsTest, Find) {
  const std::string setup = R"(local entity a, b, c; a = spawn(); b = spawn(); c = spawn();
    a.classname = "x"; b.classname = "y"; c.classname = strcat("", "x"); a.health = 5; c.health = 6; a.enemy = c; )";
  EXPECT_EQ(says(setup + "pute(find(world, classname, \"x\")); pute(find(a, classname, \"x\"));"
                         "pute(find(c, classname, \"x\")); pute(find(world, classname, \"z\"));"),
            "e2 e4 e0 e0");
  EXPECT_EQ(says(setup + "remove(a); pute(find(world, classname, \"x\"));"), "e4");
  EXPECT_EQ(says(setup + "pute(find(world, classname, \"\"));"), "e1");  // a client without a class
  EXPECT_EQ(
      says(setup +
           "pute(findfloat(world, health, 6)); pute(findflags(world, health, 4)); pute(findflags(a, health, 4));"),
      "e4 e2 e4");
  EXPECT_EQ(
      says(setup + "local entity e; e = findchain(classname, \"x\"); pute(e); e = e.chain; pute(e); pute(e.chain);"),
      "e4 e2 e0");
  EXPECT_EQ(says(setup + "pute(findchainfloat(health, 5)); pute(findchainflags(health, 2));"
                         "local entity e; e = findchain(classname, \"x\", goalentity); pute(e.goalentity);"),
            "e2 e4 e2");
}

TEST_F(EntityBuiltinsTest, Nextent) {
  EXPECT_EQ(
      says(
          "local entity a, b; a = spawn(); b = spawn(); remove(a); pute(nextent(world)); pute(nextent(nextent(world)));"
          "pute(nextent(b));"),
      "e1 e3 e0");
}

TEST_F(EntityBuiltinsTest, Numbers) {
  EXPECT_EQ(says("put(num_for_edict(spawn())); pute(edict_num(1)); pute(edict_num(77)); pute(edict_num(-1));"),
            "2 e1 e0 e0");
}

TEST_F(EntityBuiltinsTest, EntitiesThatAreNone) {
  ASSERT_TRUE(
      start(std::string(testing::kBuiltinSource) +
            "entity e; void() main = { remove(e); }; void() eprints = { eprint(e); }; void() nexts = { nextent(e); };"
            "void() finds = { find(e, classname, \"\"); }; void() nums = { put(num_for_edict(e)); };"));
  const auto e = vm_->program().global<EdictId>("e");
  for (const std::uint32_t bad : {2u, 64u, 0xffffffffu, 0x80000000u}) {
    vm_->set(e, EdictId{bad});
    for (const char* function : {"main", "eprints", "nexts", "finds", "nums"}) {
      EXPECT_EQ(error_of(function), "") << function;
      EXPECT_THAT(vm_->warning(), HasSubstr(fmt::format("is entity {}, of 2: the call does nothing", bad)));
      EXPECT_THAT(vm_->warning(), HasSubstr("parameter 1 of ")) << function;
    }
    EXPECT_EQ(output(), "0") << "what num_for_edict returned";
  }
}

TEST_F(EntityBuiltinsTest, FieldsThatAreNone) {
  ASSERT_TRUE(start(std::string(testing::kBuiltinSource) +
                        ".string f; .string g; void() main = { g = f; find(world, g, \"\"); findchain(g, \"\"); };"
                        "void() chains = { g = f; findchain(g, \"\"); };",
                    "-O0"));
  ASSERT_EQ(error_of(), "");
  const auto g = vm_->program().global<FieldId>("f");
  ASSERT_TRUE(g);
  for (const std::uint32_t bad : {vm_->program().field_words, 0xffffffffu}) {
    vm_->set(g, FieldId{bad});
    for (const char* function : {"main", "chains"}) {
      EXPECT_EQ(error_of(function), "");
      EXPECT_THAT(vm_->warning(), HasSubstr(fmt::format("field {}, of ", bad)));
    }
  }
}

TEST_F(EntityBuiltinsTest, FieldsByNumber) {
  EXPECT_EQ(
      says(
          R"(local float i, n; local entity e; e = spawn(); e.origin = '1 2 3'; e.classname = "x"; n = numentityfields();
    for (i = 0; i < n; i++) { if (entityfieldname(i) == "origin") { put(entityfieldtype(i)); puts(getentityfieldstring(i, e));
      put(putentityfieldstring(i, e, "4 5 6")); putv(e.origin); } }
    puts(entityfieldname(-1)); puts(getentityfieldstring(99999, e)); put(putentityfieldstring(99999, e, ""));)"),
      "3 [1.000000 2.000000 3.000000] 1 (4 5 6) [] [] 0");
}

class ConsoleBuiltinsTest : public testing::QcTest {
 protected:
  void SetUp() override {
    QcTest::SetUp();
    services_.console = &console_;
    services_.print = [this](std::string_view text) { printed_ += text; };
    console_.add_cvar("developer", "0", "whether there is more to say");
    console_.add_cvar({"skill", "1", "how hard it is", con::kCvarArchive, 0, 3});
  }
  con::Console console_;
  std::string printed_;
};

TEST_F(ConsoleBuiltinsTest, Cvars) {
  EXPECT_EQ(says("put(cvar(\"skill\")); put(cvar(\"nothing\")); cvar_set(\"skill\", \"2\"); put(cvar(\"skill\"));"
                 "puts(cvar_string(\"skill\")); puts(cvar_string(\"nothing\")); puts(cvar_defstring(\"skill\"));"),
            "1 0 2 [2] [] [1]");
  EXPECT_EQ(console_.cvar("skill").integer(), 2);
  EXPECT_EQ(says("cvar_set(\"skill\", \"99\"); put(cvar(\"skill\")); cvar_set(\"nothing\", \"1\");"),
            "3");  // the console's own rules
  EXPECT_EQ(says("put(registercvar(\"mine\", \"7\")); put(registercvar(\"mine\", \"8\")); put(cvar(\"mine\"));"
                 "put(registercvar(\"echo\", \"8\")); put(cvar_type(\"mine\")); put(cvar_type(\"skill\")); "
                 "put(cvar_type(\"no\"));"),
            "1 0 7 0 17 27 0");
}

// Mods ask for other engines' cvars on every tick.
TEST_F(ConsoleBuiltinsTest, AMissingCvarIsToldOfOnce) {
  std::vector<std::string> lines;
  set_log_level(LogLevel::kInfo);
  const int listener =
      add_log_listener([&](LogLevel, std::string_view line) { lines.emplace_back(line.substr(0, line.find(','))); });
  ASSERT_TRUE(start(std::string(testing::kBuiltinSource) +
                    "void() main = { put(cvar(\"gone\")); puts(cvar_string(\"GONE\")); cvar_set(\"away\", \"1\");"
                    " put(cvar(\"away\")); put(cvar_type(\"asked\")); put(cvar(\"skill\")); };"));
  for (int i = 0; i < 100; ++i) EXPECT_EQ(error_of(), "");
  EXPECT_EQ(output(), "0 [] 0 0 1");
  EXPECT_EQ(console_.find_cvar("away"), nullptr);
  EXPECT_THAT(lines, ElementsAre("QuakeC reads \"gone\"", "QuakeC sets \"away\""));
  lines.clear();
  ASSERT_TRUE(start(std::string(testing::kBuiltinSource) +
                    "void() main = { local float i; i = 0; while (i < 1000) { cvar(ftos(i)); i = i + 1; } };"));
  EXPECT_EQ(error_of(), "");
  EXPECT_EQ(lines.size(), 65u) << "not without end either";
  remove_log_listener(listener);
}

TEST_F(ConsoleBuiltinsTest, Commands) {
  std::string said;
  console_.add_command("say_it", "", [&](const con::Args& args) { said = args.rest(); });
  EXPECT_EQ(says("localcmd(\"say_it \", \"hello\\n\");"), "");
  EXPECT_EQ(said, "");
  console_.execute();
  EXPECT_EQ(said, "hello");
}

TEST_F(ConsoleBuiltinsTest, Printing) {
  EXPECT_EQ(says("dprint(\"hidden\"); bprint(\"all \", \"of you\\n\");"), "");
  EXPECT_EQ(printed_, "all of you\n");
  console_.set("developer", "1");
  EXPECT_EQ(says("dprint(\"seen\", \" now\");"), "");
  EXPECT_THAT(printed_, HasSubstr("seen now"));
}

TEST_F(ConsoleBuiltinsTest, Extensions) {
  EXPECT_EQ(says("put(checkextension(\"FRIK_FILE\")); put(checkextension(\"FTE_STRINGS\")); "
                 "put(checkextension(\"DP_QC_SPRINTF\"));"
                 "put(checkextension(\"DP_TE_NOTHING\"));"),
            "1 1 1 0");
}

TEST_F(ConsoleBuiltinsTest, ErrorsOfTheMod) {
  EXPECT_THAT(says("self = spawn(); self.classname = \"thing\"; error(\"it \", \"broke\"); puts(\"never\");"),
              HasSubstr("main (test.qc), statement "));
  EXPECT_EQ(output(), "");
  EXPECT_EQ(printed_, "======SERVER ERROR in main:\nit broke\n\nEDICT 2:\nclassname      thing\n");
  printed_.clear();
  EXPECT_EQ(says("self = spawn(); objerror(\"odd\"); put(wasfreed(self));"), "1");  // QuakeC goes on
  EXPECT_EQ(printed_, "======OBJECT ERROR in main:\nodd\n\nEDICT 2:\n");
}

TEST_F(ConsoleBuiltinsTest, PrintsOfEdicts) {
  EXPECT_EQ(says("local entity e; e = spawn(); e.origin = '1 2.5 -3'; e.think = main; e.enemy = e; e.health = 0.5;"
                 "e.classname = \"thing\"; eprint(e); remove(e); eprint(e);"),
            "");
  EXPECT_EQ(printed_,
            "\nEDICT 2:\norigin         '  1.0   2.5  -3.0'\nclassname      thing\nthink          main()\n"
            "health           0.5\nenemy          entity 2\nFREE\n");
  printed_.clear();
  EXPECT_EQ(says("coredump();"), "");
  EXPECT_EQ(printed_, "\nEDICT 0:\n\nEDICT 1:\n");
}

}  // namespace
}  // namespace fb::progs
