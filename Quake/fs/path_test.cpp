#include "fs/path.h"

#include <gtest/gtest.h>

namespace fb::fs {
namespace {

TEST(Path, OrdinaryNamesStay) {
  EXPECT_EQ(normalise("maps/start.bsp"), "maps/start.bsp");
  EXPECT_EQ(normalise("a"), "a");
  EXPECT_EQ(normalise("gfx/..hidden"), "gfx/..hidden");
}

TEST(Path, OneFormForManySpellings) {
  EXPECT_EQ(normalise("maps\\start.bsp"), "maps/start.bsp");
  EXPECT_EQ(normalise("./maps//./start.bsp"), "maps/start.bsp");
  EXPECT_EQ(normalise("sound/"), "sound");
}

TEST(Path, RefusesWhatLeadsElsewhere) {
  for (const char* name : {"", "/", ".", "/etc/passwd", "\\windows", "../id1/x", "maps/../../x", "maps\\..\\x", "..",
                           "c:/x", "C:x", "maps/a\nb"}) {
    EXPECT_EQ(normalise(name), std::nullopt) << name;
  }
  EXPECT_EQ(normalise(std::string_view("a\0b", 3)), std::nullopt);
}

TEST(Path, GameNames) {
  EXPECT_TRUE(is_game_name("ad"));
  EXPECT_TRUE(is_game_name("ad_v1.80"));
  for (const char* name : {"", ".", "..", "a..b", "a/b", "a\\b", "c:"}) EXPECT_FALSE(is_game_name(name)) << name;
}

TEST(Path, CaseAndEndings) {
  EXPECT_EQ(lower_case("Maps/START.Bsp"), "maps/start.bsp");
  EXPECT_TRUE(ends_with_ignoring_case("demo1.DEM", ".dem"));
  EXPECT_TRUE(ends_with_ignoring_case("x", ""));
  EXPECT_FALSE(ends_with_ignoring_case("dem", ".dem"));
}

}  // namespace
}  // namespace fb::fs
