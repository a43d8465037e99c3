#include "host/base_game.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "platform/program_directory.h"

namespace fb::host {
namespace {

namespace stdfs = std::filesystem;
using testing::ElementsAre;

class BaseGame : public testing::Test {
 protected:
  BaseGame() : folder_(stdfs::temp_directory_path() / ("fullbright_box_" + std::to_string(::getpid()))) {
    stdfs::create_directories(folder_ / "bin");
  }
  ~BaseGame() override { stdfs::remove_all(folder_); }
  void put(const stdfs::path& game) {
    stdfs::create_directories(folder_ / game / "id1");
    std::ofstream(folder_ / game / "id1" / "progs.dat") << "code";
  }
  stdfs::path folder_;
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

TEST(ProgramDirectory, HoldsThisTest) { EXPECT_TRUE(stdfs::exists(platform::program_directory() / "host_test")); }

}  // namespace
}  // namespace fb::host
