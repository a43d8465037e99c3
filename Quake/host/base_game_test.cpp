#include "host/base_game.h"

#include <gmock/gmock.h>

#include "base/test_directory.h"
#include "formats/test_models.h"
#include "host/game/engine.h"
#include "platform/program_directory.h"
#include "scene/library/test_maps.h"

namespace fb::host {
namespace {

namespace stdfs = std::filesystem;
using testing::ElementsAre;

class BaseGame : public testing::Test {
 protected:
  BaseGame() { stdfs::create_directories(folder_ / "bin"); }
  void put(const std::string& game) const { directory_.put(game + "/id1/progs.dat", "code"); }
  const TestDirectory directory_;
  const stdfs::path folder_ = directory_.path();
};

TEST_F(BaseGame, StandsBesideTheProgramOrWhereItWasInstalled) {
  EXPECT_EQ(find_base_game(folder_ / "bin"), "");
  put("share/fullbright/game");
  EXPECT_EQ(find_base_game(folder_ / "bin"), folder_ / "share/fullbright/game");
  put("bin/game");
  EXPECT_EQ(find_base_game(folder_ / "bin"), folder_ / "bin/game");
}

TEST_F(BaseGame, WhatTheUserNamesStays) {
  EXPECT_THAT(with_base_game({"-basegame", "mine"}), ElementsAre("-basegame", "mine"));
}

TEST_F(BaseGame, AStoresGameIsPlayedWhereNothingElseIsNamed) {
  const std::vector<fs::StoreGame> games{{"/s/rerelease", "Steam", true}, {"/s", "Steam", false}, {"/g", "GOG", false}};
  const auto chosen = [&](std::vector<std::string> arguments) {
    const std::size_t before = arguments.size();
    const std::vector<std::string> with = with_store_game(std::move(arguments), games, folder_);
    return with.size() == before + 2 && with[0] == "-basedir" ? with[1] : "";
  };
  EXPECT_EQ(chosen({"-fullscreen"}), "/s/rerelease");
  EXPECT_EQ(chosen({"-preforiginal"}), "/s");
  EXPECT_EQ(chosen({"-nosteam"}), "/g");
  EXPECT_EQ(chosen({"-gog"}), "/g");
  EXPECT_EQ(chosen({"-gog", "-remaster"}), "/g") << "there is no other";
  EXPECT_EQ(chosen({"-basedir", "mine"}), "");
  EXPECT_EQ(chosen({"-nosteam", "-nogog"}), "");
  EXPECT_THAT(with_store_game({"-a"}, {}, folder_), ElementsAre("-a"));
  directory_.put("id1/pak0.pak", "data");
  EXPECT_EQ(chosen({}), "") << "the current folder is a game's";
}

TEST_F(BaseGame, ItsSkinsAreForItsOwnModels) {
  put("game");
  scene::test::TestFiles files;
  files.add_palette();
  files.add_tga("skin", 4, 4, {9, 9, 9});
  const Bytes model = formats::testing::write_mdl(formats::testing::tetrahedron());
  for (const char* mine : {"progs/both.mdl", "progs/box.mdl"}) {
    directory_.put(std::string("game/id1/") + mine, model);
    directory_.put(std::string("game/id1/") + mine + "_0.tga", files.files["skin"]);
  }
  directory_.put("data/id1/gfx/palette.lmp", files.files["gfx/palette.lmp"]);
  directory_.put("data/id1/progs/both.mdl", model);
  auto engine = Engine::create(
      {"-basedir", directory_.file("data"), "-basegame", directory_.file("game"), "-userdir", directory_.file("user")},
      {.server = false});
  ASSERT_TRUE(engine.ok()) << engine.error().message;
  scene::ModelLibrary& library = (*engine)->library();
  const auto skin = [&](const char* name) {
    const std::uint32_t material = library.model(name).skin_materials.at(0);
    const scene::Assets& assets = *library.assets();
    return assets.images[assets.materials[material].frames[0].base].name;
  };
  EXPECT_EQ(skin("progs/box.mdl"), "progs/box.mdl_0.tga");
  EXPECT_EQ(skin("progs/both.mdl"), "progs/both.mdl_0_0");
}

TEST(ProgramDirectory, HoldsThisTest) { EXPECT_TRUE(stdfs::exists(platform::program_directory() / "host_test")); }

}  // namespace
}  // namespace fb::host
