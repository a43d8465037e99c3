// Who has the keys: the menu, the message that is typed, the console or the bindings.
#include "host/game/key_router.h"

#include <gmock/gmock.h>

#include "base/log.h"
#include "platform/keys.h"
#include "ui/menu/test_menu.h"

namespace fb::host {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Behind = KeyRouter::Behind;

class KeyRouterTest : public testing::Test {
 protected:
  KeyRouterTest() {
    console.add_cvar({"skill", "1", "", con::kCvarPlain, 0.0f, 3.0f, true});
    console.add_cvar("m_pitch", "0.022", "");
    for (const char* name : {"quit", "say", "say_team", "+forward", "-forward", "impulse"})
      console.add_command(name, "", [this](const con::Args& args) { ran.push_back(args.joined(0)); });
    console.execute("bind w +forward; bind F10 quit; bind t messagemode; bind y messagemode2; bind 2 \"impulse 2\"");
    keys.set_behind(Behind::kGame);
  }
  void key(int number, bool down = true) {
    platform::InputEvent event;
    event.kind = platform::InputEvent::Kind::kKey;
    event.key = number;
    event.down = down;
    keys.handle(event);
  }
  // A key and its letter, as they come from a keyboard.
  void press(int number) {
    key(number);
    if (number >= ' ' && number < 127) text(std::string(1, static_cast<char>(number)));
    key(number, false);
    console.execute();
  }
  void hold(int number, int other) {
    key(number);
    key(other);
    key(other, false);
    key(number, false);
  }
  void text(const std::string& typed) {
    platform::InputEvent event;
    event.kind = platform::InputEvent::Kind::kText;
    event.text = typed;
    keys.handle(event);
  }

  con::Console console;
  ui::menu::TestFacts facts;
  KeyRouter keys{console, facts};
  std::vector<std::string> ran;
};

// As in Ironwail: its configurations bind them.
TEST_F(KeyRouterTest, AControllersButtonsHaveASecondSet) {
  console.execute("bind LTHUMB +altmodifier; bind ABUTTON \"impulse 1\"; bind ABUTTON_ALT \"impulse 2\"");
  press(platform::kKeyAButton);
  key(platform::kKeyLeftThumb);
  console.execute();
  press(platform::kKeyAButton);
  press(platform::kKeySpace);
  key(platform::kKeyLeftThumb, false);
  console.execute();
  press(platform::kKeyAButton);
  EXPECT_THAT(ran, ElementsAre("impulse 1", "impulse 2", "impulse 1"));
}
// What was pressed as one button is let go as that, whatever is held by then.
TEST_F(KeyRouterTest, AButtonIsLetGoAsWhatItWasPressedAs) {
  console.execute("bind ABUTTON_ALT +forward; +altmodifier");
  key(platform::kKeyAButton);
  console.execute("-altmodifier");
  key(platform::kKeyAButton, false);
  console.execute();
  ASSERT_EQ(ran.size(), 2u);
  EXPECT_THAT(ran[0], testing::StartsWith("+forward"));
  EXPECT_THAT(ran[1], testing::StartsWith("-forward"));
}
TEST_F(KeyRouterTest, TheCrossIsTheArrowKeysUnlessItIsBound) {
  console.execute("bind UPARROW \"impulse 1\"; bind DPAD_DOWN \"impulse 2\"; bind DOWNARROW \"impulse 3\"");
  press(platform::kKeyDpadUp);
  press(platform::kKeyDpadDown);
  EXPECT_THAT(ran, ElementsAre("impulse 1", "impulse 2"));
  press(platform::kKeyEscape);
  press(platform::kKeyDpadDown);
  EXPECT_EQ(ran.size(), 2u) << "in the menu it moves";
  EXPECT_TRUE(keys.menu_open());
}

TEST_F(KeyRouterTest, EscapeOpensTheMenuAndLeadsBackToTheGame) {
  press(platform::kKeyEscape);
  EXPECT_TRUE(keys.menu_open());
  EXPECT_TRUE(keys.holds_game());
  press('w');
  EXPECT_THAT(ran, IsEmpty()) << "the menu has the keys";
  press(platform::kKeyEscape);
  EXPECT_FALSE(keys.holds_game());
  press('w');
  EXPECT_THAT(ran, ElementsAre("+forward 119", "-forward 119"));
}

TEST_F(KeyRouterTest, AltAndEnterChangeTheWindowWhereverKeysGo) {
  console.add_command("vid_toggle", "", [this](const con::Args&) { ran.push_back("vid_toggle"); });
  const auto both = [&] {
    key(platform::kKeyAlt);
    press(platform::kKeyEnter);
    key(platform::kKeyAlt, false);
    press(platform::kKeyEnter);
  };
  both();
  EXPECT_THAT(ran, ElementsAre("vid_toggle"));
  press(platform::kKeyEscape);
  both();
  EXPECT_EQ(std::ranges::count(ran, "vid_toggle"), 2);
  // Alt is let go where no window of ours sees it.
  key(platform::kKeyAlt);
  platform::InputEvent away;
  away.kind = platform::InputEvent::Kind::kFocus;
  keys.handle(away);
  press(platform::kKeyEnter);
  EXPECT_EQ(std::ranges::count(ran, "vid_toggle"), 2);
}

TEST_F(KeyRouterTest, ButtonsAreReleasedWhenTheMenuOpens) {
  key('w');
  console.execute();
  press(platform::kKeyEscape);
  EXPECT_THAT(ran, ElementsAre("+forward 119", "-forward 119"));
}

TEST_F(KeyRouterTest, ControllersHaveCommandsWhereDefaultCfgKnowsNone) {
  for (const char* name : {"+attack", "-attack", "+speed", "-speed"})
    console.add_command(name, "", [this](const con::Args& args) { ran.push_back(args[0]); });
  std::string script = "unbindall\nbind LTHUMB +attack";  // as id's, but for a button of its own
  console.set_file_loader([&](std::string_view name) -> std::optional<FileData> {
    if (name != "default.cfg" && name != "config.cfg") return std::nullopt;
    return FileData(Bytes(script.begin(), script.end()));
  });
  console.execute("exec default.cfg");
  press(platform::kKeyRightTrigger);
  EXPECT_THAT(ran, ElementsAre("+attack", "-attack")) << "who has a pad can shoot";
  ran.clear();
  press(platform::kKeyLeftThumb);
  EXPECT_THAT(ran, ElementsAre("+attack", "-attack")) << "the script's own command stays";
  ran.clear();
  script = "unbindall\n";
  console.execute("exec config.cfg");  // a player who has taken them away
  press(platform::kKeyRightTrigger);
  EXPECT_THAT(ran, IsEmpty());
}

TEST_F(KeyRouterTest, EscapeClosesTheConsole) {
  press('`');
  EXPECT_TRUE(keys.console_open());
  press(platform::kKeyEscape);
  EXPECT_FALSE(keys.console_open());
  EXPECT_FALSE(keys.menu_open());
}

TEST_F(KeyRouterTest, WithoutAGameThereIsAlwaysAWay) {
  keys.set_behind(Behind::kNothing);
  text("say hello");
  press(platform::kKeyEnter);
  EXPECT_THAT(ran, ElementsAre("say hello")) << "the console is typed at";
  press(platform::kKeyEscape);
  EXPECT_TRUE(keys.menu_open());
  press(platform::kKeyEscape);
  EXPECT_FALSE(keys.menu_open());
  press('`');
  press('`');
  EXPECT_TRUE(keys.menu_open()) << "a console that closes leaves the menu";
}

TEST_F(KeyRouterTest, OverADemoKeysOpenTheMenu) {
  keys.set_behind(Behind::kDemo);
  press('2');
  EXPECT_TRUE(keys.menu_open());
  EXPECT_THAT(ran, IsEmpty());
  keys.close_all();
  press(platform::kKeyTab);
  EXPECT_FALSE(keys.menu_open());
  press('`');
  EXPECT_TRUE(keys.console_open());
}

TEST_F(KeyRouterTest, ThePanelComesBeforeTheGameAndAfterTheMenu) {
  std::vector<std::string> told;
  bool takes = true;
  keys.set_panel([&](const platform::InputEvent& event) {
    if (event.kind == platform::InputEvent::Kind::kKey)
      told.push_back((event.down ? "+" : "-") + platform::key_name(event.key));
    return takes && event.down;
  });
  press('w');
  EXPECT_THAT(told, ElementsAre("+w", "-w"));
  EXPECT_THAT(ran, IsEmpty());
  takes = false;
  press('w');
  EXPECT_THAT(ran, ElementsAre("+forward 119", "-forward 119"));
  press(platform::kKeyEscape);
  told.clear();
  press('w');
  EXPECT_THAT(told, ElementsAre("-w")) << "the menu has the keys";
  press(platform::kKeyEscape);
  console.add_command("togglepanel", "", [this](const con::Args&) { ran.push_back("togglepanel"); });
  ran.clear();
  press(platform::kKeyF1 + 7);
  EXPECT_THAT(ran, ElementsAre("togglepanel"));
  console.execute("bind F8 \"impulse 9\"");
  press(platform::kKeyF1 + 7);
  EXPECT_THAT(ran, ElementsAre("togglepanel", "impulse 9")) << "a player's own binding counts";
}

TEST_F(KeyRouterTest, MessagesAreTypedAndSent) {
  press('t');
  EXPECT_TRUE(keys.holds_game());
  for (const char c : std::string("2 w`")) press(c);
  press(platform::kKeyBackspace);
  press(platform::kKeyEnter);
  EXPECT_THAT(ran, ElementsAre("say 2 w"));
  EXPECT_FALSE(keys.holds_game());
  ran.clear();
  press('y');
  text("go");
  press(platform::kKeyEscape);
  EXPECT_THAT(ran, IsEmpty());
  EXPECT_FALSE(keys.menu_open()) << "Escape ends the message alone";
  press('y');
  text("go");
  press(platform::kKeyEnter);
  EXPECT_THAT(ran, ElementsAre("say_team go"));
}

TEST_F(KeyRouterTest, OneLineOfTheClipboardIsPasted) {
  std::string copied = "say \u201chello\u201d";
  keys.set_clipboard([&] { return copied; });
  press('`');
  text("echo;");
  key(platform::kKeyCtrl);
  key('v');
  text("v");  // not typed while Ctrl is held
  key('v', false);
  key(platform::kKeyCtrl, false);
  EXPECT_EQ(keys.console_line().text(), "echo;say \"hello\"");
  hold(platform::kKeyCtrl, 'c');
  EXPECT_EQ(keys.console_line().text(), "");
  copied = "say one\r\nquit\n\nquit";
  hold(platform::kKeyShift, platform::kKeyInsert);
  EXPECT_EQ(keys.console_line().text(), "say one");
  EXPECT_EQ(console.scrollback().latest(1)[0].text, "Pasted the first line; 2 further were left out.");
  console.execute();
  EXPECT_THAT(ran, IsEmpty()) << "nothing that is pasted runs by itself";
  press(platform::kKeyEnter);
  EXPECT_THAT(ran, ElementsAre("say one"));
}

TEST_F(KeyRouterTest, ShortcutsFollowTheLayout) {
  keys.set_clipboard([] { return "x"; });
  press('`');
  key(platform::kKeyCtrl);
  platform::InputEvent event;
  event.kind = platform::InputEvent::Kind::kKey;
  event.down = true;
  event.key = '.';
  event.letter = 'v';  // Dvorak
  keys.handle(event);
  EXPECT_EQ(keys.console_line().text(), "x");
  event.key = 'v';
  event.letter = 'k';
  keys.handle(event);
  EXPECT_EQ(keys.console_line().text(), "x");
  event.letter = 0;  // a layout without Latin letters
  keys.handle(event);
  EXPECT_EQ(keys.console_line().text(), "xx");
}

TEST_F(KeyRouterTest, WhatIsTypedIsOfTheFontsLetters) {
  press('`');
  text("\u00e9t\u00e9");
  EXPECT_EQ(keys.console_line().text(), "ete");
  key(platform::kKeyAlt);  // AltGr of some systems
  key(platform::kKeyCtrl);
  text("@");
  EXPECT_EQ(keys.console_line().text(), "ete@");
}

TEST_F(KeyRouterTest, TheSameKeysEditWhereverTextIsTyped) {
  console.add_cvar("_cl_name", "two words", "", con::kCvarArchive);
  console.add_cvar("_cl_color", "0", "");
  console.add_cvar("hostname", "two words", "", con::kCvarArchive);
  keys.set_clipboard([] { return "new "; });
  const auto edit = [&] {
    key(platform::kKeyEnd);
    hold(platform::kKeyCtrl, platform::kKeyLeftArrow);
    hold(platform::kKeyCtrl, 'v');
    hold(platform::kKeyCtrl, platform::kKeyLeftArrow);
    hold(platform::kKeyCtrl, platform::kKeyBackspace);
    key(platform::kKeyEnd);
    text("!");
  };
  press('`');
  text("two words");
  edit();
  EXPECT_EQ(keys.console_line().text(), "new words!");
  press('`');
  press('t');
  keys.handle([] {
    platform::InputEvent event;
    event.kind = platform::InputEvent::Kind::kText;
    event.text = "two words";
    return event;
  }());
  edit();
  press(platform::kKeyEnter);
  EXPECT_THAT(ran, ElementsAre("say new words!"));
  console.execute("menu_settings");
  keys.menu().show("settings/all");
  while (keys.menu().selected() && keys.menu().selected()->label != "hostname") press(platform::kKeyDownArrow);
  press(platform::kKeyEnter);
  ASSERT_TRUE(keys.menu().editing());
  edit();
  press(platform::kKeyEnter);
  EXPECT_EQ(console.cvar("hostname").string(), "new words!");
}

TEST_F(KeyRouterTest, TabGoesThroughNamesAndBack) {
  for (const char* name : {"zz_a", "zz_b", "zz_c"}) console.add_cvar(name, "0", "");
  press('`');
  text("zz");
  const auto tab = [&] {
    key(platform::kKeyTab);
    key(platform::kKeyTab, false);
    return keys.console_line().text();
  };
  EXPECT_EQ(tab(), "zz_");
  EXPECT_EQ(tab(), "zz_a");
  EXPECT_EQ(tab(), "zz_b");
  key(platform::kKeyShift);
  EXPECT_EQ(tab(), "zz_a") << "the held key ends nothing";
  EXPECT_EQ(tab(), "zz_c");
}

TEST_F(KeyRouterTest, TheConsoleScrollsAndStays) {
  constexpr std::size_t kRows = 20;
  press('`');
  for (int i = 0; i < 100; ++i) log_info("line {}", i);
  const std::size_t most = console.scrollback().size() - kRows;
  keys.begin_console(kRows);
  key(platform::kKeyPageUp);
  EXPECT_EQ(keys.scrolled_up(), 2u);
  hold(platform::kKeyCtrl, platform::kKeyPageUp);
  EXPECT_EQ(keys.scrolled_up(), 18u) << "a page, of which four lines stay";
  log_info("one more");
  keys.begin_console(kRows);
  EXPECT_EQ(keys.scrolled_up(), 19u) << "what is read stays where it is";
  hold(platform::kKeyCtrl, platform::kKeyHome);
  EXPECT_EQ(keys.scrolled_up(), most + 1);
  hold(platform::kKeyCtrl, platform::kKeyEnd);
  EXPECT_EQ(keys.scrolled_up(), 0u);
  log_info("one more");
  keys.begin_console(kRows);
  EXPECT_EQ(keys.scrolled_up(), 0u);
  text("half a command");
  key(platform::kKeyPageUp);
  press('`');
  press('`');
  EXPECT_EQ(keys.scrolled_up(), 0u);
  EXPECT_EQ(keys.console_line().text(), "") << "as in QuakeSpasm it opens empty";
  console.execute("clear");
  hold(platform::kKeyCtrl, platform::kKeyHome);
  EXPECT_EQ(keys.scrolled_up(), 0u);
}

TEST_F(KeyRouterTest, TheQuitPageObeysTheKeyY) {
  press(platform::kKeyF1 + 9);
  press('n');
  EXPECT_EQ(keys.menu().page_name(), "main");
  press(platform::kKeyF1 + 9);
  press('y');
  EXPECT_THAT(ran, ElementsAre("quit"));
}

TEST_F(KeyRouterTest, AKeyThatQuitsAsks) {
  press(platform::kKeyF1 + 9);
  EXPECT_THAT(ran, IsEmpty());
  EXPECT_EQ(keys.menu().page_name(), "quit");
  press(platform::kKeyEnter);
  EXPECT_THAT(ran, ElementsAre("quit"));
  console.execute("quit");
  EXPECT_EQ(ran.size(), 2u) << "the command does not ask";
}

TEST_F(KeyRouterTest, AKeyThatIsBoundIsNoSearch) {
  console.execute("menu_keys");
  press(platform::kKeyEnter);
  EXPECT_TRUE(keys.menu().capturing());
  press('i');
  EXPECT_EQ(keys.menu().filter(), "");
  press('j');
  EXPECT_EQ(keys.menu().filter(), "j") << "the next letter searches";
  console.execute("bind i");
  EXPECT_EQ(console.scrollback().latest(1)[0].text, "\"i\" = \"+forward\"");
}

TEST_F(KeyRouterTest, AStickMovesStepByStep) {
  console.execute("menu_main");
  keys.steer({0.0f, 0.9f}, 10.0);
  keys.steer({0.0f, 0.9f}, 10.1);
  EXPECT_EQ(keys.menu().selected()->label, "Multiplayer");
  keys.steer({0.0f, 0.9f}, 10.5);
  keys.steer({0.0f, 0.9f}, 10.55);
  EXPECT_EQ(keys.menu().selected()->label, "Options") << "it repeats while it is held";
  keys.steer({0.0f, 0.0f}, 10.6);
  keys.steer({0.0f, -0.9f}, 10.7);
  EXPECT_EQ(keys.menu().selected()->label, "Multiplayer");
}

TEST(CountsWhileWaiting, WhatEndsAndWhatTheWindowIsToldDo) {
  using Kind = platform::InputEvent::Kind;
  const auto counts = [](Kind kind, bool down) {
    platform::InputEvent event;
    event.kind = kind;
    event.key = platform::kKeySpace;
    event.down = down;
    return counts_while_waiting(event);
  };
  EXPECT_FALSE(counts(Kind::kKey, true));
  EXPECT_TRUE(counts(Kind::kKey, false)) << "a button is not held for ever";
  EXPECT_FALSE(counts(Kind::kText, false));
  EXPECT_FALSE(counts(Kind::kMouseMotion, false));
  for (const Kind kind : {Kind::kFocus, Kind::kResize, Kind::kQuit}) EXPECT_TRUE(counts(kind, false));
}

}  // namespace
}  // namespace fb::host
