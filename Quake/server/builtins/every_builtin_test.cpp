// Every builtin of docs/quakec.md's list, called once from a mod's program.
#include "fs/test_log.h"
#include "progs/builtins/builtins.h"
#include "progs/test_builtin_list.h"
#include "server/test_server.h"

namespace fb::sv {
namespace {

using namespace progs::testing;

std::vector<ListedBuiltin> server_list() { return listed_builtins({"Of every program", "Of the server's program"}); }

// What makes sense as parameters, where not everything does.
const std::map<std::string, std::string>& parameters() {
  static const std::map<std::string, std::string> kAll = {
      {"setmodel", "thing, \"maps/test.bsp\""},
      {"setorigin", "thing, '0 0 64'"},
      {"setsize", "thing, '-8 -8 -8', '8 8 8'"},
      {"remove", "spawn()"},
      {"makestatic", "thing"},
      {"cvar", "\"skill\""},
      {"cvar_set", "\"temp1\", \"2\""},
      {"cvar_string", "\"skill\""},
      {"cvar_defstring", "\"skill\""},
      {"registercvar", "\"of_a_mod\", \"1\""},
      {"localcmd", "\"echo hello\\n\""},
      {"sound", "player, 1, \"a.wav\", 1, 1"},
      {"ambientsound", "'0 0 64', \"a.wav\", 1, 3"},
      {"stuffcmd", "player, \"echo hello\\n\""},
      {"sprint", "player, \"hello\", \" there\\n\""},
      {"centerprint", "player, \"hello\", \" there\""},
      {"setspawnparms", "player"},
      {"clientcommand", "player, \"name bob\""},
      {"lightstyle", "1, \"az\""},
      {"changelevel", "\"test\""},
      {"aim", "player, 1000"},
      {"fopen", "\"words.txt\", 2"},
      {"fputs", "1, \"one\", \" line\\n\""},
      {"strzone", "\"kept\""},
      {"strunzone", "strzone(\"kept\")"},
      {"sprintf", "\"%d %s\", 1, \"a\""},
      {"traceline", "'0 0 64', '0 0 -64', 0, self"},
      {"tracetoss", "self, world"},
      {"tracebox", "'0 0 64', '-8 -8 -8', '8 8 8', '0 0 -64', 0, self"},
      {"putentityfieldstring", "number_of_field(\"health\"), thing, \"5\""},
      {"getentityfieldstring", "number_of_field(\"health\"), thing"},
      {"changepitch", "self"},
      {"checkbuiltin", "coredump"},
      {"callfunction", "\"worldspawn\""},
      {"copyentity", "thing"},
      {"touchtriggers", "thing"},
      {"setmodelindex", "thing, 1"},
      {"buf_del", "buf_create()"},
      {"isbackbuffered", "player"},
      {"dropclient", "player"},
      {"localsound", "player, \"a.wav\""},
      {"pointsound", "'0 0 64', \"a.wav\", 1, 1"},
  };
  return kAll;
}

// Those that end something are called apart, precaches while the level loads.
const std::set<std::string>& ends() {
  static const std::set<std::string> kAll = {"breakpoint", "error", "objerror", "fgets", "fclose"};
  return kAll;
}

class EveryBuiltinTest : public testing::ServerTest {
 protected:
  void start_program(const std::string& source) {
    const Compiled compiled = compile(declarations(server_list()) + source, "-O2");
    ASSERT_FALSE(compiled.progs.empty()) << compiled.output;
    files_["progs.dat"] = compiled.progs;
    files_["sound/a.wav"] = Bytes{1};
    put_map("test", room());
    make_server();
    const Status status = server_->map("test");
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  std::string run(std::string_view function) {
    if (level().run(level().vm->program().find_function(function), EdictId::kWorld)) return "";
    return level().error()->message;
  }
};

TEST_F(EveryBuiltinTest, TheListIsThatOfTheTable) {
  make_server();
  expect_listed(server_list(), server_->builtins());
  expect_listed(listed_builtins({"Of every program"}), progs::standard_builtins({}));
}

TEST_F(EveryBuiltinTest, EachIsCalledOnceWithoutAWrongWord) {
  std::string precaches, others;
  int count = 0;
  for (const ListedBuiltin& builtin : server_list()) {
    const bool precache = builtin.name.starts_with("precache");
    if (ends().contains(builtin.name)) continue;
    auto special = parameters();
    if (builtin.name.starts_with("Write")) {  // to all
      const std::string& type = builtin.types.back();
      special[builtin.name] = type == "string" ? "0, \"a word\"" : type == "entity" ? "0, player" : "0, 1";
    }
    if (precache)
      special[builtin.name] = builtin.name.find("sound") != builtin.name.npos ? "\"a.wav\"" : "\"maps/test.bsp\"";
    (precache ? precaches : others) += call_of(builtin, special);
    ++count;
  }
  EXPECT_GT(count, 150);
  fs::LogLines log;
  start_program(R"(
    float last;
    entity player, thing;
    float number_of_field(string name) = {
      local float i;
      for (i = 0; i < numentityfields(); i = i + 1) if (entityfieldname(i) == name) return i;
      return -1;
    };
    void() ClientConnect = {};
    void() ClientDisconnect = {};
    void() PutClientInServer = { self.health = 100; setorigin(self, '100 0 64'); };
    void() PlayerPreThink = {};
    void() PlayerPostThink = {};
    void() StartFrame = {};
    void() SetNewParms = {};
    void() SetChangeParms = {};
    void() worldspawn = {
)" + precaches + R"(
    };
    void() every = {
      player = edict_num(1);
      thing = spawn();
      self = thing;
      self.flags = 512;
)" + others + R"(
      fclose(1);
      last = fopen("words.txt", 0);
      if (fgets(last) != "one line") error("the file's line is ", fgets(last));
      fclose(last);
      last = 2;
    };
    void() broken = { breakpoint(); };
    void() given_up = { error("no", "thing"); };
    void() object = { self = spawn(); self.classname = "thing"; objerror("of ", "it"); };
)");
  const Player player = join();
  log.lines.clear();
  set_log_level(LogLevel::kWarning);  // what coredump, eprint and traceon print is no wrong word
  EXPECT_EQ(run("every"), "");
  EXPECT_EQ(level().vm->get(global<float>("last")), 2.0f);
  EXPECT_THAT(log.lines, ::testing::IsEmpty());
  set_log_level(LogLevel::kError);
  EXPECT_EQ(run("object"), "");
  EXPECT_THAT(run("given_up"), ::testing::HasSubstr("the mod gives up: nothing"));
}

TEST_F(EveryBuiltinTest, ABreakEndsTheProgram) {
  start_program("void() worldspawn = {}; void() broken = { breakpoint(); };");
  EXPECT_THAT(run("broken"), ::testing::HasSubstr("break statement"));
}

}  // namespace
}  // namespace fb::sv
