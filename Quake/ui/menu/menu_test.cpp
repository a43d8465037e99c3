#include "ui/menu/menu.h"

#include "ui/menu/test_menu.h"

namespace fb::ui::menu {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST_F(MenuTest, EscapeLeadsOutFromEveryPage) {
  for (const PageInfo& info : page_list()) {
    menu.show(info.name);
    ASSERT_TRUE(menu.open()) << info.name;
    EXPECT_EQ(menu.page_name(), info.name);
    for (int i = 0; i < 5 && menu.open(); ++i) menu.press(Key::kBack);
    EXPECT_FALSE(menu.open()) << info.name;
  }
}

TEST_F(MenuTest, EveryPageDrawsItsRows) {
  facts.save_list.push_back({"s0", true, "", "The Hall", "3/22", 75.0});
  facts.map_list.push_back({"e1m1", "The Gate", false});
  facts.demo_list = {"demo1"};
  facts.mod_list.push_back({"hipnotic", "a mission pack", false});
  for (const PageInfo& info : page_list()) {
    menu.show(info.name);
    const std::string text = read();
    if (menu.selected() == nullptr) continue;  // groups without a setting
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string label = menu.selected()->label;
      // Names of the first rows are large: not letters of the size that is read.
      const bool large = std::string_view(label) == "Single Player" || label == "Multiplayer" || label == "Options" ||
                         label == "New Game" || label == "Load" || label == "Save" || label == "Join a Game" ||
                         label == "Setup";
      if (!large) {
        EXPECT_THAT(read(), HasSubstr(label.substr(0, 12))) << info.name;
      }
      menu.press(Key::kDown);
    }
  }
}

TEST_F(MenuTest, CommandsOpenPagesAndTogglemenuCloses) {
  console.execute("menu_load");
  EXPECT_EQ(menu.page_name(), "load");
  menu.press(Key::kBack);
  EXPECT_EQ(menu.page_name(), "singleplayer");
  console.execute("togglemenu");
  EXPECT_EQ(menu.page_name(), "main");
  console.execute("togglemenu");
  EXPECT_FALSE(menu.open());
  for (const char* command : {"menu_main", "menu_singleplayer", "menu_load", "menu_save", "menu_multiplayer",
                              "menu_setup", "menu_options", "menu_keys", "menu_video", "menu_help", "menu_quit"}) {
    menu.close();
    console.execute(command);
    EXPECT_TRUE(menu.open()) << command;
  }
}

TEST_F(MenuTest, CursorGoesRoundAndIsKept) {
  menu.show("main");
  EXPECT_EQ(menu.selected()->label, "Single Player");
  menu.press(Key::kUp);
  EXPECT_EQ(menu.selected()->label, "Credits");
  menu.press(Key::kDown);
  menu.press(Key::kDown);
  EXPECT_EQ(menu.selected()->label, "Multiplayer");
  menu.close();
  menu.show("main");
  EXPECT_EQ(menu.selected()->label, "Multiplayer") << "where it was left";
}

TEST_F(MenuTest, NewGameStartsWhereTheMapChoosesTheSkill) {
  facts.start_list = {{"start", "The Hub", true}};
  menu.show("singleplayer");
  choose("New Game");
  EXPECT_FALSE(menu.open());
  EXPECT_THAT(run(), ElementsAre("disconnect", "maxplayers 1", "deathmatch 0", "coop 0", "map start"));
}

TEST_F(MenuTest, NewGameAsksForTheSkillWhereTheMapDoesNot) {
  facts.start_list = {{"start", "The Hub", false}};
  menu.show("singleplayer");
  choose("New Game");
  EXPECT_EQ(menu.page_name(), "singleplayer/new");
  choose("Hard");
  EXPECT_THAT(run(), Contains("map start"));
  EXPECT_EQ(console.cvar("skill").string(), "2");
}

TEST_F(MenuTest, NewGameAsksBeforeItEndsAnother) {
  facts.start_list = {{"start", "The Hub", true}};
  facts.game = true;
  menu.show("singleplayer");
  choose("New Game");
  EXPECT_TRUE(menu.asking());
  EXPECT_THAT(read(), HasSubstr("Leave this game"));
  menu.type("n");
  EXPECT_TRUE(menu.open());
  EXPECT_THAT(run(), IsEmpty());
  choose("New Game");
  menu.press(Key::kRight);
  menu.press(Key::kEnter);
  EXPECT_THAT(run(), IsEmpty()) << "No was selected";
  choose("New Game");
  menu.type("y");
  EXPECT_THAT(run(), Contains("map start"));
}

TEST_F(MenuTest, SeveralStartsAreListed) {
  facts.start_list = {{"start", "The Hub", true}, {"hipstart", "", true}};
  menu.show("singleplayer");
  choose("New Game");
  EXPECT_THAT(read(), HasSubstr("The Hub"));
  choose("hipstart");
  EXPECT_THAT(run(), Contains("map hipstart"));
}

TEST_F(MenuTest, LoadListsPlaceKillsAndTime) {
  facts.save_list = {
      {"s0", true, "", "The Hall", "3/22", 75.0}, {"s1"}, {"s2", true, "s2.sav: no version", "", "", 0.0}};
  menu.show("load");
  const std::string text = read();
  EXPECT_THAT(text, HasSubstr("The Hall"));
  EXPECT_THAT(text, HasSubstr("3/22"));
  EXPECT_THAT(text, HasSubstr("1:15"));
  EXPECT_THAT(text, HasSubstr("- empty -"));
  EXPECT_THAT(text, HasSubstr("(cannot be read)"));
  choose("(cannot be read)");
  EXPECT_TRUE(menu.open()) << "a broken file is not loaded";
  EXPECT_THAT(read(), HasSubstr("s2.sav: no version"));
  choose("The Hall");
  EXPECT_THAT(run(), Contains("load s0"));
}

TEST_F(MenuTest, SaveAsksBeforeItWritesOverOne) {
  facts.save_list = {{"s0", true, "", "The Hall", "3/22", 75.0}, {"s1"}};
  menu.show("save");
  choose("- empty -");
  EXPECT_THAT(run(), ElementsAre("save s1"));
  menu.show("save");
  choose("The Hall");
  EXPECT_TRUE(menu.asking());
  menu.press(Key::kEnter);
  EXPECT_THAT(run(), ElementsAre("save s0"));
  facts.no_save = "no game runs here that could be saved";
  menu.show("save");
  EXPECT_EQ(menu.selected(), nullptr);
  EXPECT_THAT(read(), HasSubstr("no game runs here"));
}

TEST_F(MenuTest, AutosavesAreLoadedButNotWrittenOver) {
  SaveEntry automatic;
  automatic.name = "autosave/e1m1";
  automatic.automatic = automatic.used = true;
  automatic.place = "The Gate";
  facts.save_list = {SaveEntry{.name = "s0"}, automatic};
  menu.show("load");
  EXPECT_THAT(read(), HasSubstr("Autosaves\n"));
  choose("The Gate");
  EXPECT_THAT(run(), Contains("load autosave/e1m1"));
  menu.show("save");
  EXPECT_THAT(read(), Not(HasSubstr("The Gate")));
}

// The colour in the middle of the save's picture; black where none is drawn.
std::uint32_t pictured(Menu& menu, Atlas& atlas, int width, int height) {
  scene::DrawList list;
  menu.draw(list, atlas, width, height, {});
  for (const scene::DrawQuad& quad : list.quads) {
    const vec2 texels = quad.uv_max - quad.uv_min;
    if (texels != vec2(kSavePictureWidth, kSavePictureHeight)) continue;
    const ivec2 at((quad.uv_min + quad.uv_max) * 0.5f);
    return list.atlas->texels[static_cast<std::size_t>(at.y * list.atlas->width + at.x)];
  }
  return 0;
}

TEST_F(MenuTest, TheSelectedSaveHasItsPicture) {
  const auto picture = [](std::uint8_t level) {
    formats::RgbaImage image{kSavePictureWidth, kSavePictureHeight, {}};
    image.rgba.assign(std::size_t{4} * kSavePictureWidth * kSavePictureHeight, level);
    return image;
  };
  for (const char* name : {"s0", "s1", "s2"}) {
    SaveEntry save;
    save.name = save.place = name;
    save.used = true;
    facts.save_list.push_back(save);
  }
  facts.save_pictures = {{"s0", picture(0x50)}, {"s2", picture(0x70)}};
  menu.show("load");
  select("s0");
  EXPECT_EQ(pictured(menu, atlas, kWidth, kHeight), 0x50505050u);
  EXPECT_EQ(pictured(menu, atlas, 1280, 720), 0x50505050u);
  EXPECT_EQ(facts.pictures_read, 1) << "once for many frames";
  select("s1");
  EXPECT_EQ(pictured(menu, atlas, kWidth, kHeight), 0u);
  EXPECT_THAT(read(), HasSubstr("no picture"));
  select("s2");
  EXPECT_EQ(pictured(menu, atlas, kWidth, kHeight), 0x70707070u);
  menu.close();
  facts.save_pictures["s2"] = picture(0x20);
  menu.show("load");
  EXPECT_EQ(pictured(menu, atlas, kWidth, kHeight), 0x20202020u) << "saved again meanwhile";
}

TEST_F(MenuTest, TheDeadMayGoBack) {
  facts.last_save = "quick";
  menu.show("dead");
  choose("Load the last save");
  EXPECT_THAT(run(), ElementsAre("load quick"));
  EXPECT_FALSE(menu.open());
  menu.show("dead");
  choose("Start the level over");
  EXPECT_THAT(run(), ElementsAre("restart level"));
}

TEST_F(MenuTest, MapsAreSearchedByNameAndTitle) {
  facts.map_list = {{"e1m1", "The Gate"}, {"e1m2", "Castle"}, {"dm3", "The Bad Place"}};
  menu.show("maps");
  menu.type("pla");
  EXPECT_EQ(menu.filter(), "pla");
  EXPECT_THAT(read(), Not(HasSubstr("Castle")));
  EXPECT_EQ(menu.selected()->label, "dm3");
  menu.press(Key::kErase);
  menu.press(Key::kErase);
  menu.press(Key::kErase);
  menu.type("the e1");
  EXPECT_EQ(menu.selected()->label, "e1m1");
  menu.press(Key::kEnter);
  EXPECT_THAT(run(), Contains("map e1m1"));
  menu.show("maps");
  menu.type("xyz");
  EXPECT_EQ(menu.selected(), nullptr);
  EXPECT_THAT(read(), HasSubstr("Nothing has these words."));
  menu.press(Key::kBack);
  EXPECT_EQ(menu.page_name(), "maps") << "Escape ends the search first";
  EXPECT_EQ(menu.filter(), "");
}

TEST_F(MenuTest, TitlesAppearWhenTheyAreRead) {
  facts.map_list = {{"e1m1", ""}};
  menu.show("maps");
  facts.map_list[0].title = "The Gate";
  menu.update();
  EXPECT_THAT(read(), Not(HasSubstr("The Gate")));
  ++facts.changes;
  menu.update();
  EXPECT_THAT(read(), HasSubstr("The Gate"));
}

TEST_F(MenuTest, ModsAndDemos) {
  facts.mod_list = {{"id1", "", true}, {"ad", "Arcane Dimensions", false}};
  menu.show("mods");
  EXPECT_THAT(read(), HasSubstr("Arcane Dimensions"));
  choose("ad");
  EXPECT_THAT(run(), ElementsAre("game ad"));
  facts.demo_list = {"demo1"};
  menu.show("demos");
  choose("demo1");
  EXPECT_THAT(run(), ElementsAre("playdemo demo1"));
  facts.demo_list.clear();
  menu.show("demos");
  EXPECT_THAT(read(), HasSubstr("There are no demos."));
}

TEST_F(MenuTest, ArchivesOfModsAreInstalled) {
  facts.mod_list = {{"id1", "", true}};
  facts.install.folder = "/home/player/archives";
  menu.show("mods");
  select("Install a mod");
  EXPECT_THAT(read(), HasSubstr("/home/player/archives"));
  menu.press(Key::kEnter);
  EXPECT_THAT(run(), IsEmpty());
  facts.archive_list = {{"ad 1.zip", "ad", "12.0 MiB", "400 files"},
                        {"q.zip", "quoth", "1.0 MiB", "9 files", "", true},
                        {"x.zip", "", "1.0 MiB", "", "x.zip: it is torn."}};
  menu.show("mods");
  EXPECT_THAT(read(), HasSubstr("12.0 MiB"));
  choose("x.zip");
  EXPECT_THAT(read(), HasSubstr("it is torn."));
  EXPECT_THAT(run(), IsEmpty());
  choose("Install ad");
  EXPECT_THAT(run(), ElementsAre("installmod ad 1.zip"));
  choose("Replace quoth");
  EXPECT_THAT(read(), HasSubstr("Replace quoth? Saves and"));
  menu.type("y");
  EXPECT_THAT(run(), ElementsAre("installmod q.zip replace"));
}

TEST_F(MenuTest, AnInstallationIsFollowed) {
  facts.mod_list = {{"id1", "", true}};
  facts.archive_list = {{"ad.zip", "ad", "12.0 MiB", "400 files"}};
  menu.show("mods");
  select("Install ad");
  facts.install = {"ad", 45, "", "", ""};
  ++facts.changes;
  menu.update();
  EXPECT_THAT(read(), HasSubstr("45 %"));
  ASSERT_NE(menu.selected(), nullptr);
  EXPECT_EQ(menu.selected()->label, "Install ad") << "where the cursor was, though a row came before it";
  menu.press(Key::kEnter);
  EXPECT_THAT(run(), IsEmpty()) << "one at a time";
  choose("Installing ad");
  EXPECT_TRUE(menu.asking());
  // While a question waits, the rows stay: it is answered for the one that it was asked of.
  facts.install = {"", 0, "ad", "", ""};
  facts.mod_list.push_back({"ad", "Arcane Dimensions", false});
  ++facts.changes;
  menu.update();
  menu.type("y");
  EXPECT_THAT(run(), ElementsAre("installmod cancel"));
  menu.update();
  EXPECT_THAT(read(), HasSubstr("Arcane Dimensions"));
  select("Installed");
  facts.install = {"", 0, "", "ad.zip: the disk is full.", ""};
  ++facts.changes;
  menu.update();
  select("Not installed");
  EXPECT_THAT(read(), HasSubstr("the disk is full."));
}

TEST_F(MenuTest, QuitAsks) {
  console.execute("menu_quit");
  choose("No, stay");
  EXPECT_EQ(menu.page_name(), "main");
  EXPECT_THAT(run(), IsEmpty());
  console.execute("menu_quit");
  choose("Yes, quit");
  EXPECT_THAT(run(), ElementsAre("quit"));
}

TEST_F(MenuTest, TheQuitPageObeysYAndN) {
  console.execute("menu_quit");
  menu.type("x");
  EXPECT_EQ(menu.page_name(), "quit");
  menu.type("N");
  EXPECT_EQ(menu.page_name(), "main");
  EXPECT_THAT(run(), IsEmpty());
  for (const char* yes : {"y", "Y"}) {
    console.execute("menu_quit");
    menu.press(Key::kDown);  // at No
    menu.type(yes);
    EXPECT_THAT(run(), ElementsAre("quit"));
  }
}

TEST_F(MenuTest, HelpTurnsItsPictures) {
  menu.show("help");
  menu.press(Key::kLeft);
  menu.press(Key::kRight);
  EXPECT_EQ(menu.page_name(), "help");
  EXPECT_THAT(read(), HasSubstr("F6, F9: quick")) << "without pictures there are words";
}

TEST_F(MenuTest, HostingAGame) {
  facts.map_list = {{"dm1", "Place of Two Deaths"}, {"start", "The Hub"}};
  menu.show("multiplayer/host");
  choose("Map");
  EXPECT_EQ(menu.page_name(), "multiplayer/host/map");
  choose("dm1");
  EXPECT_EQ(menu.page_name(), "multiplayer/host");
  select("Players");
  menu.press(Key::kLeft);
  select("Frag limit");
  menu.press(Key::kRight);
  select("Game");
  menu.press(Key::kRight);  // to cooperative
  EXPECT_THAT(read(), HasSubstr("cooperative"));
  choose("Begin game");
  EXPECT_THAT(run(),
              ElementsAre("disconnect", "listen 0", "maxplayers 7", "listen 1", "deathmatch 0", "coop 1", "map dm1"));
  EXPECT_EQ(console.cvar("fraglimit").string(), "10");
}

TEST_F(MenuTest, JoiningAGame) {
  facts.server_list = {{"a server", "dm3", "192.0.2.1:26000", 2, 8, true}, {"old", "dm1", "192.0.2.2", 0, 4, false}};
  menu.show("multiplayer/join");
  EXPECT_THAT(run(), ElementsAre("slist")) << "the page looks for servers when it opens";
  const std::string text = read();
  EXPECT_THAT(text, HasSubstr("dm3"));
  EXPECT_THAT(text, HasSubstr("2/8"));
  choose("old");
  EXPECT_TRUE(menu.open()) << "it speaks another version";
  choose("Search the local network");
  EXPECT_THAT(run(), ElementsAre("slist"));
  choose("Address");
  menu.type("192.0.2.9");
  menu.press(Key::kEnter);
  EXPECT_THAT(ran, Contains("connect 192.0.2.9"));
  choose("a server");
  EXPECT_THAT(run(), ElementsAre("connect 192.0.2.1:26000"));
}

TEST_F(MenuTest, SetupChangesNameAndColours) {
  menu.show("setup");
  choose("Your name");
  for (int i = 0; i < 10; ++i) menu.press(Key::kErase);
  menu.type("Ranger");
  menu.press(Key::kEnter);
  EXPECT_THAT(ran, Contains("name Ranger"));
  select("Shirt");
  menu.press(Key::kLeft);
  EXPECT_THAT(ran, Contains("color 13 0")) << "round from 0";
  select("Trousers");
  menu.press(Key::kRight);
  EXPECT_THAT(ran, Contains("color 0 1"));
}

TEST_F(MenuTest, SoundsOfMovingChoosingAndChanging) {
  std::vector<std::string> heard;
  menu.set_sound([&](std::string_view name) { heard.emplace_back(name); });
  menu.show("options");
  menu.press(Key::kDown);
  select("Lookspring");
  heard.clear();
  menu.press(Key::kRight);
  menu.press(Key::kUp);
  menu.press(Key::kBack);
  EXPECT_THAT(heard, ElementsAre("misc/menu3.wav", "misc/menu1.wav", "misc/menu2.wav"));
}

}  // namespace
}  // namespace fb::ui::menu
