// What the menus list of files: saved games, maps, mods.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/test_directory.h"
#include "fs/filesystem.h"
#include "host/game/map_list.h"
#include "host/game/mod_list.h"
#include "host/options.h"
#include "host/game/save_list.h"

namespace fb::host {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string save_text(const std::string& comment, const std::string& time = "75.5") {
  std::string text = "5\n" + comment + "\n";
  for (int i = 0; i < 16; ++i) text += "0\n";
  text += "1\ne1m1\n" + time + "\n";
  for (int i = 0; i < 64; ++i) text += "m\n";
  return text + "{\n}\n";
}

std::string map_text(const std::string& entities) {
  std::string text = {29, 0, 0, 0, 16, 0, 0, 0};
  const auto size = static_cast<std::uint32_t>(entities.size());
  for (int shift = 0; shift < 32; shift += 8) text += static_cast<char>(size >> static_cast<unsigned>(shift) & 255u);
  return text + "pad." + entities;
}

class MenuLists : public testing::Test {
 protected:
  MenuLists() { directory.put("base/id1/progs.dat", "code"); }
  fs::FileSystem open(std::vector<std::string> games = {}) const {
    fs::FsOptions options;
    options.base_dir = directory.file("base");
    options.base_dir_named = true;
    options.games = std::move(games);
    options.user_dir = directory.file("user");
    auto files = fs::FileSystem::open(options);
    EXPECT_TRUE(files.ok()) << files.error().message;
    return *std::move(files);
  }
  const TestDirectory directory;
};

TEST(SaveList, ReadsPlaceKillsAndTime) {
  const auto save = describe_save("s0", save_text("The_Slipgate_Complex__kills:__3/_22____"));
  EXPECT_TRUE(save.used);
  EXPECT_EQ(save.failure, "");
  EXPECT_EQ(save.place, "The Slipgate Complex");
  EXPECT_EQ(save.kills, "3/22");
  EXPECT_DOUBLE_EQ(save.seconds, 75.5);
  EXPECT_EQ(describe_save("s0", save_text("something_else")).place, "something else");
  EXPECT_EQ(describe_save("s0", save_text("_____")).place, "e1m1") << "without a title the map's name";
}

TEST(SaveList, ABrokenFileHasOneSentence) {
  for (const std::string& text : {std::string(), std::string("hello"), std::string("7\nx\n"), std::string("5\nx\n0\n"),
                                  save_text("x", "never"), std::string(5000, '\xff')}) {
    const auto save = describe_save("s3", text);
    EXPECT_TRUE(save.used);
    EXPECT_THAT(save.failure, HasSubstr("s3.sav: ")) << text.substr(0, 20);
    EXPECT_EQ(save.failure.find('\n'), std::string::npos);
  }
}

TEST_F(MenuLists, SavesAreTheSlotsThenTheOthers) {
  directory.put("user/id1/s2.sav", save_text("Here__kills:__0/__1"));
  directory.put("user/id1/quick.sav", save_text("There"));
  directory.put("user/id1/s19.sav", "rubbish");
  const auto saves = list_saves(open());
  ASSERT_EQ(saves.size(), 21u);
  EXPECT_FALSE(saves[0].used);
  EXPECT_EQ(saves[2].place, "Here");
  EXPECT_NE(saves[19].failure, "");
  EXPECT_EQ(saves[20].name, "quick");
}

TEST_F(MenuLists, AutosavesComeLast) {
  directory.put("user/id1/autosave/start.sav", save_text("There"));
  directory.put("user/id1/other/x.sav", save_text("Nowhere"));
  directory.put("user/id1/zoo.sav", save_text("Zoo"));
  const auto saves = list_saves(open());
  ASSERT_EQ(saves.size(), 22u);
  EXPECT_EQ(saves[20].name, "zoo");
  EXPECT_FALSE(saves[20].automatic);
  EXPECT_EQ(saves[21].name, "autosave/start");
  EXPECT_EQ(saves[21].place, "There");
  EXPECT_TRUE(saves[21].automatic);
}

TEST_F(MenuLists, SavesOfAnotherGameAreNotListed) {
  directory.put("user/id1/s0.sav", save_text("Here"));
  directory.put("base/mod/progs.dat", "code");
  EXPECT_FALSE(list_saves(open({"mod"}))[0].used);
}

TEST(MapList, ReadsTheTitleOfWorldspawnAlone) {
  const auto map = summarise_entities(
      "{\n\"classname\" \"worldspawn\"\n\"message\" \"A {braced}\\nTitle\"\n}\n{\n\"classname\" "
      "\"info_player_start\"\n\"message\" \"no\"\n}\n");
  EXPECT_EQ(map.title, "A {braced} Title");
  EXPECT_TRUE(map.playable);
  EXPECT_FALSE(map.chooses_skill);
  EXPECT_TRUE(summarise_entities("{\"classname\" \"trigger_setskill\"}").chooses_skill);
  for (const char* broken : {"", "{", "}", "{\"message\"}", "\"", "{{{"})
    EXPECT_EQ(summarise_entities(broken).title, "");
}

TEST_F(MenuLists, MapsGetTheirTitlesAndBoxesAreLeftOut) {
  directory.put("base/id1/maps/e1m1.bsp", map_text("{\"message\" \"The Gate\"}{\"classname\" \"info_player_start\"}"));
  directory.put("base/id1/maps/b_box.bsp", map_text("{\"classname\" \"worldspawn\"}"));
  directory.put("base/id1/maps/broken.bsp", "no map at all");
  directory.put("base/id1/maps/short.bsp", "x");
  directory.put("base/id1/maps/start.bsp",
                map_text("{\"message\" \"Hub\"}{\"classname\" \"info_player_start\"}{\"classname\" "
                         "\"trigger_setskill\"}"));
  const fs::FileSystem files = open();
  MapList list(files);
  EXPECT_FALSE(list.read_more()) << "nobody has asked for maps";
  ASSERT_EQ(list.start_maps().size(), 1u);
  EXPECT_EQ(list.start_maps()[0].title, "Hub");
  EXPECT_TRUE(list.start_maps()[0].chooses_skill);
  EXPECT_EQ(list.maps().size(), 5u);
  EXPECT_TRUE(list.read_more());
  EXPECT_FALSE(list.read_more()) << "all are known";
  std::vector<std::string> seen;
  for (const auto& map : list.maps()) seen.push_back(map.name + ": " + map.title);
  EXPECT_THAT(seen, ElementsAre("broken: (cannot be read)", "e1m1: The Gate", "short: (cannot be read)", "start: Hub"));
}

TEST_F(MenuLists, ModsAreFoldersWithGameData) {
  directory.put("base/ad/pak0.pak", "PACK");
  directory.put("base/ad/modinfo.txt", "\xef\xbb\xbf\r\n  Arcane Dimensions\x01\r\nmore\r\n");
  directory.put("base/pictures/a.png", "x");
  directory.put("user/mine/maps/a.bsp", "x");
  const fs::FileSystem files = open();
  std::vector<std::string> seen;
  for (const auto& mod : list_mods(files))
    seen.push_back(mod.directory + "|" + mod.description + (mod.active ? "|active" : ""));
  EXPECT_THAT(seen, ElementsAre("id1||active", "ad|Arcane Dimensions", "mine|"));
}

TEST(GameOptionsWithGame, TheFolderTakesThePlaceOfOthers) {
  EXPECT_THAT(with_game({"-size", "640x360", "-game", "old", "+map", "start", "-1", "-hipnotic"}, "ad"),
              ElementsAre("-size", "640x360", "-game", "ad"));
  EXPECT_THAT(with_game({"-game", "old"}, "id1"), IsEmpty());
  EXPECT_THAT(with_game({"-basedir", "x"}, "rogue"), ElementsAre("-basedir", "x", "-rogue"));
}

}  // namespace
}  // namespace fb::host
