#include "fs/store_games.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/test_directory.h"

namespace fb::fs {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class StoreGamesTest : public testing::Test {
 protected:
  // What is found: the store, the folder below the home, and whether it is the re-release.
  std::vector<std::string> found() const {
    std::vector<std::string> list;
    for (const StoreGame& game : find_store_games(home_.path()))
      list.push_back(game.store + " " + game.base_dir.lexically_relative(home_.path()).generic_string() +
                     (game.remaster ? " remaster" : ""));
    return list;
  }
  TestDirectory home_;
};

TEST_F(StoreGamesTest, WithoutAStoreThereIsNone) { EXPECT_THAT(found(), IsEmpty()); }

TEST_F(StoreGamesTest, SteamsOwnLibraryHasBothReleases) {
  const std::string quake = ".local/share/Steam/steamapps/common/Quake";
  home_.put(quake + "/Id1/PAK0.PAK", "PACK");
  home_.put(quake + "/rerelease/id1/pak0.pak", "PACK");
  EXPECT_THAT(found(), ElementsAre("Steam " + quake + "/rerelease remaster", "Steam " + quake));
}

TEST_F(StoreGamesTest, OtherLibrariesAreNamedByItsList) {
  home_.put(".steam/steam/steamapps/libraryfolders.vdf",
            "\"libraryfolders\"\n{\n\t\"0\"\n\t{\n\t\t\"path\"\t\t\"" + (home_.path() / "disk two").generic_string() +
                "\"\n\t\t\"label\"\t\t\"path\"\n\t\t\"apps\"\n\t\t{\n\t\t\t\"2310\"\t\t\"1\"\n\t\t}\n\t}\n}\n");
  EXPECT_THAT(found(), IsEmpty());
  home_.put("disk two/steamapps/common/Quake/id1/pak0.pak", "PACK");
  EXPECT_THAT(found(), ElementsAre("Steam disk two/steamapps/common/Quake"));
  // The same folder by another way is no second game.
  std::filesystem::create_directories(home_.path() / ".local/share");
  std::filesystem::create_directory_symlink(home_.path() / ".steam/steam", home_.path() / ".local/share/Steam");
  EXPECT_EQ(found().size(), 1u);
}

TEST_F(StoreGamesTest, GogsGameComesAfterSteams) {
  home_.put("Games/Heroic/Quake/id1/pak0.pak", "PACK");
  home_.put(".steam/root/steamapps/common/Quake/id1/pak0.pak", "PACK");
  EXPECT_THAT(found(), ElementsAre("Steam .steam/root/steamapps/common/Quake", "GOG Games/Heroic/Quake"));
}

TEST_F(StoreGamesTest, AFolderWithoutAPakIsNoGame) {
  home_.put("GOG Games/Quake/id1/config.cfg", "bind a b");
  std::filesystem::create_directories(home_.path() / "Games/Heroic/Quake/id1/pak0.pak");
  EXPECT_THAT(found(), IsEmpty());
}

TEST(SteamLibraries, AreReadFromAnyText) {
  EXPECT_THAT(steam_libraries(R"("path" "C:\\Games" "path" "/b \"c\"")"), ElementsAre("C:\\Games", "/b \"c\""));
  EXPECT_THAT(steam_libraries(R"("label" "path" "0" "x" "path" { "path" "/in" })"), ElementsAre("/in"));
  for (const char* text : {"", "\"", "\"path\"", "\"path\" \"", "path /x", "\"path\" \"\"", "{\"path\"} \"/x\""})
    EXPECT_THAT(steam_libraries(text), IsEmpty()) << text;
}

}  // namespace
}  // namespace fb::fs
