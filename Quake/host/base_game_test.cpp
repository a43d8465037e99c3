#include "host/base_game.h"

#include <gmock/gmock.h>

#include "base/test_directory.h"
#include "platform/program_directory.h"

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

TEST(ProgramDirectory, HoldsThisTest) { EXPECT_TRUE(stdfs::exists(platform::program_directory() / "host_test")); }

}  // namespace
}  // namespace fb::host
