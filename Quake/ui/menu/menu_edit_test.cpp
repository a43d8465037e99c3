// Settings, bindings and the mouse.
#include "ui/menu/test_menu.h"

namespace fb::ui::menu {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Control of(con::Console& console, con::CvarSpec spec) { return control_of(console.add_cvar(std::move(spec))); }

TEST(MenuControl, FollowsTheCvarsLimits) {
  con::Console console;
  EXPECT_EQ(of(console, {"a", "0", "1: something is on"}).kind, Control::Kind::kToggle);
  EXPECT_EQ(of(console, {"b", "2", "1: something is on, 2: more"}).kind, Control::Kind::kText);
  EXPECT_EQ(of(console, {"c", "0", "a switch", con::kCvarPlain, 0.0f, 1.0f, true}).kind, Control::Kind::kToggle);
  const Control choice = of(console, {"d", "0", "levels", con::kCvarPlain, -1.0f, 2.0f, true});
  EXPECT_EQ(choice.kind, Control::Kind::kChoice);
  EXPECT_EQ(choice.choices.size(), 4u);
  EXPECT_EQ(choice.choices.front().value, "-1");
  const Control slider = of(console, {"e", "0.7", "loudness", con::kCvarPlain, 0.0f, 1.0f});
  EXPECT_EQ(slider.kind, Control::Kind::kSlider);
  EXPECT_DOUBLE_EQ(slider.step, 0.05);
  const Control wide = of(console, {"f", "129600", "pixels", con::kCvarPlain, 0.0f, 1e8f, true});
  EXPECT_DOUBLE_EQ(wide.step, 10000) << "a tenth of the value, since the range is far wider";
}

TEST(MenuControl, StepsStayOnTheGridAndInTheRange) {
  con::Console console;
  con::Cvar& cvar = console.add_cvar({"v", "0.7", "", con::kCvarPlain, 0.0f, 1.0f});
  const Control slider = slider_of(cvar, 0, 1, 0.1);
  EXPECT_EQ(slider.moved(1), "0.8");
  EXPECT_EQ(slider.moved(-1), "0.6");
  cvar.set("0.75");
  EXPECT_EQ(slider.moved(1), "0.8");
  EXPECT_EQ(slider.moved(-1), "0.7");
  cvar.set("1");
  EXPECT_EQ(slider.moved(1), "1");
  EXPECT_EQ(slider.at_fraction(0.32), "0.3");
  EXPECT_EQ(slider.at_fraction(2.0), "1");
  EXPECT_EQ(round_step(0.3), 0.2);
  EXPECT_EQ(round_step(70), 50);
  EXPECT_EQ(round_step(0), 1);
}

TEST_F(MenuTest, SettingsChangeThroughTheirCvars) {
  menu.show("settings/all");
  select("volume");
  EXPECT_THAT(menu.selected()->help, HasSubstr("loudness of sounds"));
  EXPECT_THAT(menu.selected()->help, HasSubstr("default 0.7; 0 to 1"));
  EXPECT_THAT(read(), HasSubstr("default 0.7; 0 to 1"));
  for (int i = 0; i < 30; ++i) menu.press(Key::kRight);
  EXPECT_EQ(console.cvar("volume").string(), "1") << "no further than its range";
  menu.press(Key::kDelete);
  EXPECT_EQ(console.cvar("volume").string(), "0.7");
  menu.press(Key::kEnter);
  EXPECT_TRUE(menu.editing());
  menu.press(Key::kErase);
  menu.press(Key::kErase);
  menu.press(Key::kErase);
  menu.type("9");
  menu.press(Key::kEnter);
  EXPECT_EQ(console.cvar("volume").string(), "1") << "typed numbers are clamped, too";
  menu.press(Key::kEnter);
  menu.type("5");
  menu.press(Key::kBack);
  EXPECT_EQ(console.cvar("volume").string(), "1") << "Escape leaves the value";
  EXPECT_EQ(menu.page_name(), "settings/all");
}

TEST_F(MenuTest, EveryArchivedSettingIsReachable) {
  console.add_cvar({"cg_strange", "abc", "a mod's own", con::kCvarArchive});
  console.add_cvar({"hidden", "0", "not kept", con::kCvarPlain});
  console.add_cvar({"foreign", "0", "another engine's", con::kCvarArchive | con::kCvarNoEffect});
  menu.show("settings/all");
  std::vector<std::string> labels;
  for (const Row& row : setting_rows(console, "")) labels.push_back(row.label);
  for (const con::Cvar* cvar : console.cvars())
    EXPECT_EQ(std::ranges::count(labels, cvar->name()), cvar->archived() ? 1 : 0) << cvar->name();
  std::size_t in_groups = 0;
  for (const std::string& group : setting_groups(console)) in_groups += setting_rows(console, group).size();
  EXPECT_EQ(in_groups + setting_groups(console).size(), labels.size()) << "each is in one group";
  select("foreign");
  menu.press(Key::kEnter);
  EXPECT_FALSE(menu.editing()) << "it has no effect";
}

TEST_F(MenuTest, TypingOnTheSettingsSearchesThemAll) {
  menu.show("settings");
  menu.type("loud");
  EXPECT_EQ(menu.page_name(), "settings/all");
  EXPECT_EQ(menu.selected()->label, "volume") << "its help has the word";
  menu.type(" nothing");
  EXPECT_EQ(menu.selected(), nullptr);
}

TEST_F(MenuTest, InvertMouseTurnsTheSign) {
  menu.show("options");
  select("Invert mouse");
  menu.press(Key::kEnter);
  EXPECT_EQ(console.cvar("m_pitch").string(), "-0.022");
  menu.press(Key::kLeft);
  EXPECT_EQ(console.cvar("m_pitch").string(), "0.022");
}

TEST_F(MenuTest, VideoSizeIsTwoCvars) {
  console.add_cvar({"vid_width", "1280", "", con::kCvarArchive, 320.0f, 16384.0f, true});
  console.add_cvar({"vid_height", "720", "", con::kCvarArchive, 200.0f, 16384.0f, true});
  menu.show("video");
  select("Window size");
  EXPECT_THAT(read(), HasSubstr("1280x720"));
  menu.press(Key::kRight);
  EXPECT_EQ(console.cvar("vid_width").string(), "640");
  EXPECT_EQ(console.cvar("vid_height").string(), "480");
  choose("Apply");
  EXPECT_THAT(run(), ElementsAre("vid_restart"));
}

TEST_F(MenuTest, VideoAndSoundSpeakToPlayers) {
  console.add_cvar({"r_water", "-1", "water: 0 classic, 1 clear", con::kCvarArchive, -1.0f, 1.0f, true});
  console.add_cvar({"vid_vsync", "0", "1: pictures wait for the display", con::kCvarArchive, 0.0f, 1.0f, true});
  for (const char* name :
       {"vid_fullscreen", "vid_desktopfullscreen", "vid_borderless",    "r_target_ms", "r_scale",      "r_cpu_pixels",
        "r_bounces",      "r_fog_scale",           "r_denoise",         "r_taa",       "r_fxaa",       "host_maxfps",
        "r_frames_ahead", "scr_showfps",           "scr_menuscale",     "bgmvolume",   "bgm_extmusic", "ambient_level",
        "snd_waterfx",    "snd_mute_unfocused",    "snd_filterquality", "nosound"})
    console.add_cvar(name, "1", "what it does", con::kCvarArchive);
  for (const char* page : {"video", "sound"}) {
    menu.show(page);
    for (int i = 0; i < 30; ++i, menu.press(Key::kDown)) {
      const Row& row = *menu.selected();
      EXPECT_THAT(row.label + row.help, Not(HasSubstr("_"))) << page << ": no cvar's name";
      if (row.kind != Row::Kind::kSetting) continue;
      EXPECT_FALSE(row.help.empty()) << row.label;
      EXPECT_LE(row.label.size(), page == std::string("video") ? 17u : 20u) << row.label << ": values begin there";
    }
  }
  menu.show("video");
  select("Clear water");
  EXPECT_THAT(menu.selected()->help, HasSubstr("default automatic"));
  menu.press(Key::kRight);
  EXPECT_EQ(console.cvar("r_water").string(), "0");
  select("Vertical sync");
  EXPECT_THAT(menu.selected()->help, HasSubstr("default off"));
}

TEST_F(MenuTest, KeysAreBoundInTwoColumns) {
  bindings.bind('w', "+forward");
  menu.show("keys");
  select("Walk forward");
  EXPECT_THAT(read(), HasSubstr("---"));
  menu.press(Key::kRight);
  menu.press(Key::kEnter);
  EXPECT_TRUE(menu.capturing());
  EXPECT_THAT(read(), HasSubstr("press key"));
  menu.bind('x');
  EXPECT_FALSE(menu.capturing());
  EXPECT_THAT(bindings.keys_of("+forward"), ElementsAre('w', 'x'));
  menu.press(Key::kLeft);
  menu.press(Key::kEnter);
  menu.bind(200);
  EXPECT_THAT(bindings.keys_of("+forward"), ElementsAre('x', 200)) << "in the place of w";
  EXPECT_THAT(read(), HasSubstr("MOUSE1"));
  menu.press(Key::kDelete);
  EXPECT_THAT(bindings.keys_of("+forward"), ElementsAre(200));
  menu.press(Key::kEnter);
  menu.press(Key::kBack);
  EXPECT_FALSE(menu.capturing());
  EXPECT_THAT(bindings.keys_of("+forward"), ElementsAre(200)) << "Escape binds nothing";
  EXPECT_EQ(menu.page_name(), "keys");
}

TEST_F(MenuTest, AKeyHasOneCommand) {
  bindings.bind('w', "+forward");
  menu.show("keys");
  choose("Walk back");
  menu.bind('w');
  EXPECT_THAT(bindings.keys_of("+back"), ElementsAre('w'));
  EXPECT_THAT(bindings.keys_of("+forward"), IsEmpty());
}

TEST_F(MenuTest, ForeignBindingsAreListed) {
  bindings.bind('z', "zoom_in");
  menu.show("keys");
  select("zoom_in");
  menu.press(Key::kDelete);
  EXPECT_THAT(bindings.keys_of("zoom_in"), IsEmpty());
}

// The mouse finds rows where they are drawn.
TEST_F(MenuTest, TheMouseSelectsChoosesAndGoesBack) {
  menu.show("main");
  read();
  menu.point(120.0f, 32.0f + 2 * 20.0f + 12.0f);
  EXPECT_EQ(menu.selected()->label, "Options");
  menu.click();
  EXPECT_EQ(menu.page_name(), "options");
  menu.click(true);
  EXPECT_EQ(menu.page_name(), "main");
  read();
  menu.point(5.0f, 5.0f);
  menu.click();
  EXPECT_EQ(menu.page_name(), "main") << "nothing is there";
  menu.wheel(1);
  EXPECT_EQ(menu.selected()->label, "Help");
}

TEST_F(MenuTest, TheMouseMovesSliders) {
  menu.show("settings/Sound");
  read();
  // The first row is at 34; values begin in the middle.
  menu.point(176.0f + 8.0f + 1.0f, 39.0f);
  menu.click();
  EXPECT_EQ(console.cvar("volume").string(), "0");
  menu.point(176.0f + 72.0f - 1.0f, 39.0f);
  menu.click();
  EXPECT_EQ(console.cvar("volume").string(), "1");
}

TEST_F(MenuTest, TheMouseAnswersQuestions) {
  facts.start_list = {{"start", "The Hub", true}};
  facts.game = true;
  menu.show("singleplayer");
  choose("New Game");
  read();
  const auto click_at_letter = [&](char wanted, float dx) {
    // Yes and No are in the last line of the box: find it by trying every place.
    for (float y = 60.0f; y < 160.0f && menu.asking(); y += 4.0f) {
      menu.point(dx, y);
      menu.click();
    }
    EXPECT_FALSE(menu.asking()) << wanted;
  };
  click_at_letter('N', 32.0f + 22 * 8.0f);
  EXPECT_THAT(run(), IsEmpty());
  choose("New Game");
  read();
  click_at_letter('Y', 32.0f + 8 * 8.0f);
  EXPECT_THAT(run(), Contains("map start"));
}

TEST_F(MenuTest, LongListsScrollWithTheCursor) {
  for (int i = 0; i < 60; ++i) facts.map_list.push_back({"map" + std::to_string(i + 10), ""});
  menu.show("maps");
  read();
  menu.press(Key::kEnd);
  EXPECT_THAT(read(), HasSubstr("map69"));
  menu.press(Key::kPageUp);
  EXPECT_THAT(read(), HasSubstr(menu.selected()->label));
  menu.press(Key::kHome);
  EXPECT_THAT(read(), HasSubstr("map10"));
}

TEST(MenuScale, FitsAndIsWhole) {
  EXPECT_EQ(menu_scale(1280, 720, 0), 3);
  EXPECT_EQ(menu_scale(1920, 1080, 0), 5);
  EXPECT_EQ(menu_scale(200, 100, 0), 1);
  EXPECT_EQ(menu_scale(1280, 720, 2), 2);
  EXPECT_EQ(menu_scale(1280, 720, 9), 3);
}

}  // namespace
}  // namespace fb::ui::menu
