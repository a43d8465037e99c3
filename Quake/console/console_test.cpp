#include "console/console.h"

#include <gmock/gmock.h>

#include "base/stop.h"
#include "base/test_directory.h"
#include "fs/file.h"

namespace fb::con {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// A console with a command `do` that notes its arguments, and scripts in memory.
class ConsoleTest : public testing::Test {
 protected:
  ConsoleTest() {
    console.add_command("do", "do <words>: note them", [this](const Args& args) { done.push_back(args.joined(1)); });
    console.set_file_loader([this](std::string_view name) -> std::optional<Bytes> {
      const auto found = scripts.find(std::string(name));
      if (found == scripts.end()) return std::nullopt;
      return Bytes(found->second.begin(), found->second.end());
    });
  }
  // The lines that executing this text puts on the console.
  std::vector<std::string> said(std::string_view text) {
    const auto before = console.scrollback().total();
    console.execute(text);
    std::vector<std::string> lines;
    for (const ScrollLine& line : console.scrollback().latest(console.scrollback().total() - before))
      lines.push_back(line.text);
    return lines;
  }

  Console console;
  std::vector<std::string> done;
  std::map<std::string, std::string> scripts;
};

TEST_F(ConsoleTest, SemicolonsNewlinesQuotesComments) {
  console.execute("do a; do b\ndo \"c; d\" // ; do e\nDO f");
  EXPECT_THAT(done, ElementsAre("a", "b", "c; d", "f"));
}

TEST_F(ConsoleTest, ACommandThatFailedIsRemembered) {
  console.add_cvar({"n", "1", "", kCvarPlain, 0, 9});
  console.execute("inc n 2");
  EXPECT_FALSE(console.failed());
  EXPECT_THAT(said("inc n abc"), ElementsAre("inc abc: a number is wanted"));
  EXPECT_EQ(console.cvar("n").value(), 3.0f);
  EXPECT_TRUE(console.failed());
}

TEST_F(ConsoleTest, AScriptThatIsTooLongIsNotRead) {
  scripts["long.cfg"] = std::string(CommandBuffer::kMaxBytes + 1, '\n');
  EXPECT_THAT(said("exec long.cfg; do behind"),
              ElementsAre("exec long.cfg: a script of 8388609 bytes; at most 8388608 are taken"));
  EXPECT_THAT(done, ElementsAre("behind"));
}

TEST_F(ConsoleTest, WhoIsToldToEndExecutesNothingMore) {
  console.add_command("end", "end: as a signal does", [](const Args&) { want_stop(15); });
  console.execute("do a; end; do b");
  EXPECT_THAT(done, ElementsAre("a"));
  want_stop(0);
}

TEST_F(ConsoleTest, UnknownCommandsAreOneSentence) {
  EXPECT_THAT(said("frobnicate 1 2"), ElementsAre("Unknown command \"frobnicate\""));
  EXPECT_THAT(said(" ; ;; // nothing"), IsEmpty());
}

TEST_F(ConsoleTest, ScriptsAloneMayNameNothing) {
  scripts["player.cfg"] = "crosshair 1\nalias later frobnicate\ndo script\n";
  EXPECT_THAT(said("exec player.cfg"), Contains("Unknown command \"crosshair\""));
  console.set_scripts_may_name_nothing(true);
  EXPECT_THAT(said("exec player.cfg"), ElementsAre("execing player.cfg"));
  EXPECT_THAT(done, ElementsAre("script", "script"));
  EXPECT_THAT(said("frobnicate"), ElementsAre("Unknown command \"frobnicate\""));
  EXPECT_THAT(said("later"), ElementsAre("Unknown command \"frobnicate\""));
  console.set_command_line({"+frobnicate"});
  EXPECT_THAT(said("exec player.cfg; stuffcmds"), Contains("Unknown command \"frobnicate\""));
}

TEST_F(ConsoleTest, WhatWaitsMayBeForgotten) {
  console.add_command("stop", "", [&](const Args&) { console.forget_commands(); });
  console.execute("do a; stop; do b\ndo c");
  EXPECT_THAT(done, ElementsAre("a"));
  EXPECT_TRUE(console.buffer_empty());
}

TEST_F(ConsoleTest, AliasesRunBeforeWhatFollows) {
  console.execute("alias two \"do 1; do 2\"; two; do 3");
  EXPECT_THAT(done, ElementsAre("1", "2", "3"));
  console.execute("alias two do 4\nTWO");
  EXPECT_THAT(done, Contains("4"));
  EXPECT_THAT(said("unalias two; two"), ElementsAre("Unknown command \"two\""));
  EXPECT_THAT(said("alias"), ElementsAre("0 alias commands"));
}

TEST_F(ConsoleTest, AliasNamesShadowCvarsButNotCommands) {
  console.add_cvar("x", "1", "");
  console.execute("alias x do x; alias do echo never; x; do y");
  EXPECT_THAT(done, ElementsAre("x", "y"));
}

TEST_F(ConsoleTest, AliasesMayCallAliases) {
  console.execute("alias a \"do a1;b;do a2\"; alias b \"do b1;c;do b2\"; alias c do c; a; do end");
  EXPECT_THAT(done, ElementsAre("a1", "b1", "c", "b2", "a2", "end"));
}

TEST_F(ConsoleTest, WaitPutsTheRestOffByAFrame) {
  console.execute("do 1; wait; do 2; wait; do 3");
  EXPECT_THAT(done, ElementsAre("1"));
  console.append("do 4\n");
  console.execute();
  EXPECT_THAT(done, ElementsAre("1", "2"));
  console.execute();
  EXPECT_THAT(done, ElementsAre("1", "2", "3", "4"));
  EXPECT_TRUE(console.buffer_empty());
}

TEST_F(ConsoleTest, AnAliasThatWaitsMayGoOnForEver) {
  console.execute("alias loop \"do x; wait; loop\"; loop");
  for (int i = 0; i < 1000; ++i) console.execute();
  EXPECT_EQ(done.size(), 1001u);
}

TEST_F(ConsoleTest, AnAliasThatDoesNotIsStoppedInOneSentence) {
  const auto lines = said("alias a \"a; do never\"; a; do after");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines[0], HasSubstr("Alias \"a\" runs itself"));
  EXPECT_THAT(done, ElementsAre("after"));
  EXPECT_THAT(said("alias b c; alias c \"b;b\"; b"), ElementsAre(HasSubstr("runs itself")));
}

TEST_F(ConsoleTest, AliasesThatMultiplyAreStopped) {
  std::string text = "alias m0 do x\n";
  for (int i = 1; i < 60; ++i) text += fmt::format("alias m{} \"m{};m{}\"\n", i, i - 1, i - 1);
  const auto lines = said(text + "m59\ndo after\n");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines[0], HasSubstr("without a wait"));
  EXPECT_EQ(done.back(), "after");
}

TEST_F(ConsoleTest, ScriptsRunInPlaceAndNest) {
  scripts["a.cfg"] = "do a1\r\nexec b.cfg\r\ndo a2";
  scripts["b.cfg"] =
      "\xef\xbb\xbf"
      "do b // comment\n\n";
  EXPECT_THAT(said("exec a.cfg; do end"), ElementsAre("execing a.cfg", "execing b.cfg"));
  EXPECT_THAT(done, ElementsAre("a1", "b", "a2", "end"));
  EXPECT_THAT(said("exec b; exec none.cfg"), ElementsAre("execing b", "couldn't exec none.cfg"));
}

TEST_F(ConsoleTest, AScriptThatRunsItselfIsPassedOverAndTheRestGoesOn) {
  scripts["a.cfg"] = "do 1\nexec a.cfg\nexec a\ndo 2";
  EXPECT_THAT(said("exec a; do after"),
              ElementsAre("execing a", "a.cfg runs itself without a wait (a.cfg, a.cfg): that line is passed over.",
                          "a.cfg runs itself without a wait (a.cfg, a.cfg): that line is passed over."));
  EXPECT_THAT(done, ElementsAre("1", "2", "after"));
}

TEST_F(ConsoleTest, AScriptThatRunsItselfThroughOthersIsNamedWithThem) {
  scripts["a.cfg"] = "alias go \"exec b.cfg; do go\"\ngo\ndo a";
  scripts["b.cfg"] = "exec a.cfg";
  EXPECT_THAT(said("exec a.cfg; do after"),
              Contains("a.cfg runs itself without a wait (a.cfg, go, b.cfg, a.cfg): that line is passed over."));
  EXPECT_THAT(done, ElementsAre("go", "a", "after"));
}

TEST_F(ConsoleTest, AScriptMayRunItselfAfterAWait) {
  scripts["loop.cfg"] = "do x\nwait\nexec loop.cfg\n";
  console.execute("exec loop.cfg");
  for (int i = 0; i < 500; ++i) console.execute();
  EXPECT_EQ(done.size(), 501u);
}

// What the issue of the lost command line was: the configuration's mistakes cost only themselves.
TEST_F(ConsoleTest, TheCommandLineSurvivesAConfigurationThatRunsAway) {
  scripts["quake.rc"] = "exec config.cfg\nexec autoexec.cfg\nstuffcmds\ndo last\n";
  scripts["config.cfg"] = "alias x \"x; do never\"\nx\ndo config\n";
  console.set_command_line({"+do", "map", "+do", "quit"});
  for (const char* loop : {"exec autoexec.cfg\n", "exec quake.rc\n", "exec config.cfg\nexec autoexec.cfg\n"}) {
    done.clear();
    scripts["autoexec.cfg"] = loop;
    said("exec quake.rc");
    EXPECT_THAT(std::vector<std::string>(done.end() - 3, done.end()), ElementsAre("map", "quit", "last")) << loop;
    EXPECT_EQ(done.front(), "config");
  }
  done.clear();
  console.set_command_line({"+stuffcmds", "+exec", "quake.rc", "+do", "quit"});
  EXPECT_THAT(said("exec quake.rc"),
              Contains("The command line runs itself without a wait (The command line, The command line): that line is "
                       "passed over."));
  EXPECT_THAT(done, ElementsAre("config", "config", "quit", "last"));
}

TEST_F(ConsoleTest, AnAliasInAScriptLosesNothingOfTheScript) {
  scripts["a.cfg"] = "alias a \"b;do never\"; alias b \"a;do never\"\na\ndo rest";
  EXPECT_THAT(said("exec a.cfg; do after"),
              ElementsAre("execing a.cfg", "Alias \"a\" runs itself without a wait: it is stopped."));
  EXPECT_THAT(done, ElementsAre("rest", "after"));
}

TEST_F(ConsoleTest, CommandsThatCouldNotAreErrorsAndRemembered) {
  console.add_command("try", "", [this](const Args& args) {
    console.fail_unless(args.size() > 1 ? Status(Error{"x.sav: the disk is full"}) : ok_status());
  });
  console.execute("try");
  EXPECT_FALSE(console.failed());
  EXPECT_THAT(said("try it"), ElementsAre("x.sav: the disk is full"));
  EXPECT_TRUE(console.failed());
  console.execute("try");
  EXPECT_TRUE(console.failed()) << "what went well afterwards writes no file";
}

TEST_F(ConsoleTest, AScriptThatTheCommandLineNamesMustBeThere) {
  scripts["quake.rc"] = "exec config.cfg\nstuffcmds\n";
  console.execute("exec quake.rc; exec none.cfg");
  EXPECT_FALSE(console.failed()) << "Quake's own start names scripts that need not be there";
  console.set_command_line({"+exec", "none.cfg", "+do", "after"});
  EXPECT_THAT(said("exec quake.rc"), Contains("couldn't exec none.cfg"));
  EXPECT_TRUE(console.failed());
  EXPECT_THAT(done, ElementsAre("after"));
}

TEST_F(ConsoleTest, QuakesStart) {
  scripts["quake.rc"] = "exec default.cfg\nexec config.cfg\nexec autoexec.cfg\nstuffcmds\nstartdemos demo1\n";
  scripts["default.cfg"] = "do default";
  scripts["config.cfg"] = "do config";
  console.add_command("startdemos", "", [this](const Args& args) { done.push_back("startdemos " + args[1]); });
  console.set_command_line({"-basedir", "/quake", "+do", "from the line", "-game", "ad", "+do", "2"});
  const auto lines = said("exec quake.rc");
  EXPECT_THAT(done, ElementsAre("default", "config", "from the line", "2", "startdemos demo1"));
  EXPECT_THAT(lines, Contains("couldn't exec autoexec.cfg"));
}

TEST_F(ConsoleTest, ExecuteInsideACommandDoesNotNest) {
  console.add_command("outer", "", [this](const Args&) {
    console.execute("do inner");
    done.push_back("outer's end");
  });
  console.execute("outer; do next");
  EXPECT_THAT(done, ElementsAre("outer's end", "next", "inner"));
}

TEST_F(ConsoleTest, CvarsShowAndSet) {
  Cvar& cvar = console.add_cvar({"r_spp", "1", "paths per pixel", kCvarPlain, 1, 4096, true});
  EXPECT_THAT(said("r_spp"), ElementsAre("\"r_spp\" is \"1\""));
  EXPECT_THAT(said("R_SPP 8"), IsEmpty());
  EXPECT_EQ(cvar.integer(), 8);
  EXPECT_THAT(said("r_spp 5000"), ElementsAre(HasSubstr("so it is 4096 now")));
  EXPECT_THAT(said("set r_spp many"), ElementsAre(HasSubstr("is not a number")));
  EXPECT_EQ(cvar.integer(), 4096);
  EXPECT_TRUE(console.set("r_spp", "2"));
  EXPECT_FALSE(console.set("r_spp", "0"));
  EXPECT_FALSE(console.set("r_none", "0"));
  EXPECT_EQ(console.cvar("r_spp").integer(), 1);
  EXPECT_EQ(console.find_cvar("r_none"), nullptr);
}

TEST_F(ConsoleTest, ToggleCycleIncReset) {
  Cvar& cvar = console.add_cvar("x", "0", "");
  console.execute("toggle x");
  EXPECT_EQ(cvar.string(), "1");
  console.execute("toggle x");
  EXPECT_EQ(cvar.string(), "0");
  console.execute("inc x; inc x 0.5; inc x -2");
  EXPECT_EQ(cvar.string(), "-0.5");
  console.execute("cycle x 1 2 3");
  EXPECT_EQ(cvar.string(), "1");
  console.execute("cycle x 1 2 3");
  EXPECT_EQ(cvar.string(), "2");
  console.execute("cycle x 1 2.0");
  EXPECT_EQ(cvar.string(), "1");
  console.execute("reset x");
  EXPECT_EQ(cvar.string(), "0");
  EXPECT_THAT(said("reset nothing"), ElementsAre("There is no cvar \"nothing\"."));
  EXPECT_THAT(said("toggle"), ElementsAre(HasSubstr("toggle <cvar>")));
}

TEST_F(ConsoleTest, ReadOnlyCvarsStay) {
  Cvar& cvar = console.add_cvar("version", "1", "", kCvarRom);
  for (const char* text : {"version 2", "set version 2", "toggle version", "inc version", "reset version"})
    EXPECT_THAT(said(text), ElementsAre("\"version\" is read-only.")) << text;
  EXPECT_EQ(cvar.string(), "1");
  cvar.set("3");
  EXPECT_EQ(cvar.string(), "3");
  console.execute("resetall");
  EXPECT_EQ(cvar.string(), "3");
}

TEST_F(ConsoleTest, UserCvarsBecomeTheProgramsOwn) {
  console.execute("set r_spp 64; set r_mode wild; seta r_kept 5");
  const Cvar* before = console.find_cvar("r_spp");
  Cvar& spp = console.add_cvar({"r_spp", "1", "", kCvarPlain, 1, 32, true});
  EXPECT_EQ(&spp, before);
  EXPECT_EQ(spp.integer(), 32) << "kept as far as it is allowed";
  EXPECT_EQ(spp.default_string(), "1");
  int calls = 0;
  CvarSpec mode{"r_mode", "0", "", kCvarPlain, 0, 1};
  mode.on_change = [&](const Cvar&) { ++calls; };
  EXPECT_EQ(console.add_cvar(std::move(mode)).string(), "0");
  EXPECT_EQ(calls, 0);
  console.execute("r_mode 1");
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(console.add_cvar("r_kept", "1", "").archived());
  EXPECT_THAT(said("set do 1"), ElementsAre(HasSubstr("is a command")));
}

TEST_F(ConsoleTest, ListsAndHelp) {
  console.add_cvar({"zz_size", "1", "how big the zebra is", kCvarArchive, 0, 9});
  EXPECT_THAT(said("cvarlist zz"), ElementsAre("* zz_size \"1\"", "1 cvars beginning with \"zz\""));
  EXPECT_THAT(said("cmdlist d"), ElementsAre("   do", "1 commands beginning with \"d\""));
  EXPECT_THAT(said("apropos ZEBRA"), ElementsAre(HasSubstr("zz_size"), HasSubstr("1 commands and cvars")));
  EXPECT_THAT(said("help zz_size"),
              ElementsAre("zz_size: how big the zebra is", "   is \"1\", default \"1\", 0 to 9, kept in config.cfg"));
  EXPECT_THAT(said("help do"), ElementsAre("do <words>: note them"));
  EXPECT_THAT(said("help zebra"), ElementsAre(HasSubstr("There is no command")));
}

TEST_F(ConsoleTest, ConfigReadsBackTheSame) {
  console.add_cvar("a_name", "player", "", kCvarArchive);
  console.add_cvar("a_plain", "1", "");
  console.add_config_section([] { return "unbindall\n"; });
  console.execute("a_name \"Ranger; Rick // 1\"; seta u_own 5; set u_lost 6; a_plain 2");
  const std::string text = console.config_text();
  EXPECT_EQ(text, "unbindall\na_name \"Ranger; Rick // 1\"\nseta u_own \"5\"\n");

  Console other;
  other.add_command("unbindall", "", [](const Args&) {});
  other.add_cvar("a_name", "player", "", kCvarArchive);
  other.execute(text);
  EXPECT_EQ(other.config_text(), text.substr(10));
}

TEST_F(ConsoleTest, WhatConfigCannotNameIsNoCvar) {
  for (const char* name : {"kemen\"2", "\"two words\"", "\"a;b\"", "\"a{b\"", "\"\"", "\"// b\""}) {
    EXPECT_THAT(said(std::string("seta ") + name + " 3"), ElementsAre(HasSubstr("cannot be a cvar"))) << name;
  }
  EXPECT_EQ(console.config_text(), "");
  EXPECT_THAT(said("seta _odd-name.2 3"), IsEmpty());
  EXPECT_EQ(console.config_text(), "seta _odd-name.2 \"3\"\n");
}

TEST_F(ConsoleTest, ConfigValuesCannotBreakOut) {
  console.add_cvar("a", "", "", kCvarArchive).set("x\"; quit\n\"y");
  EXPECT_EQ(console.config_text(), "a \"x'; quit 'y\"\n");
}

TEST_F(ConsoleTest, WritesConfig) {
  const TestDirectory directory;
  const auto path = directory.path() / "id1" / "config.cfg";
  console.add_cvar("a", "1", "", kCvarArchive);
  ASSERT_TRUE(console.write_config(path));
  const auto data = fs::read_whole_file(path);
  ASSERT_TRUE(data);
  EXPECT_EQ(std::string(data->begin(), data->end()), "a \"1\"\n");
  EXPECT_FALSE(console.write_config(path / "below"));
}

TEST_F(ConsoleTest, AnotherConsoleGetsItsCvarsAndAliases) {
  Console other;
  for (Console* each : {&console, &other}) {
    each->add_cvar("kept", "1", "", kCvarArchive);
    each->add_cvar("plain", "1", "");
    each->add_cvar("untouched", "1", "");
    each->add_cvar("fixed", each == &console ? "here" : "there", "", kCvarRom);
  }
  console.execute("kept 2\nplain \"two words; do no\"\nset mine 3\nseta my_own 4\nalias both \"do a; do b\"");
  other.execute("untouched 5");
  other.execute(console.session_text());
  EXPECT_EQ(other.cvar("kept").string(), "2");
  EXPECT_EQ(other.cvar("plain").string(), "two words; do no");
  EXPECT_EQ(other.cvar("untouched").string(), "5");
  EXPECT_EQ(other.cvar("fixed").string(), "there");
  EXPECT_EQ(other.cvar("mine").string(), "3");
  EXPECT_FALSE(other.cvar("mine").archived());
  EXPECT_TRUE(other.cvar("my_own").archived());
  std::vector<std::string> heard;
  other.add_command("do", "", [&](const Args& args) { heard.push_back(args.joined(1)); });
  other.execute("both");
  EXPECT_THAT(heard, ElementsAre("a", "b"));
}

TEST_F(ConsoleTest, ScrollbackHearsTheLogAndEchoIsThere) {
  EXPECT_THAT(said("echo \"a  b\" c"), ElementsAre("a  b c"));
  EXPECT_THAT(said("clear; echo x"), ElementsAre("x"));
  EXPECT_EQ(console.scrollback().size(), 1u);
  { Console short_lived; }
  log_info("after the other console is gone");
  EXPECT_EQ(console.scrollback().size(), 2u);
}

TEST_F(ConsoleTest, ACommandMayAddCommands) {
  console.add_command("grow", "", [this](const Args&) {
    for (int i = 0; i < 100; ++i) console.add_command(fmt::format("grown{}", i), "", [](const Args&) {});
    done.push_back("grown");
  });
  console.execute("grow");
  EXPECT_TRUE(console.has_command("grown99"));
  EXPECT_THAT(done, ElementsAre("grown"));
  console.remove_command("grow");
  EXPECT_FALSE(console.has_command("grow"));
  console.remove_command("grow");
}

TEST_F(ConsoleTest, DeathOfDuplicates) {
  console.add_cvar("x", "1", "");
  EXPECT_DEATH(console.add_cvar("X", "1", ""), "already");
  EXPECT_DEATH(console.add_command("x", "", [](const Args&) {}), "already");
  EXPECT_DEATH(console.add_command("Do", "", [](const Args&) {}), "already");
  EXPECT_DEATH(console.add_cvar("do", "1", ""), "already");
  EXPECT_DEATH(console.cvar("none"), "no cvar");
}

}  // namespace
}  // namespace fb::con
