#include "host/options.h"

#include <gtest/gtest.h>

namespace fb::host {
namespace {

TEST(GameOptions, TakesWhatItKnowsAndLeavesCommandsAlone) {
  const auto o = parse_game_options({"-headless", "-basedir", "x", "-size", "320x180", "-capture", "out",
                                     "-capture_every", "3", "+set", "x", "-1", "+timedemo", "demo1", "+quit"});
  ASSERT_TRUE(o.ok());
  EXPECT_TRUE(o->headless);
  EXPECT_EQ(o->size, uvec2(320, 180));
  EXPECT_EQ(o->capture, "out");
  EXPECT_EQ(o->capture_every, 3u);
  EXPECT_TRUE(o->has_commands);
}

TEST(GameOptions, AnUnknownOptionOrAMissingValueIsNamed) {
  EXPECT_NE(parse_game_options({"-hedless"}).error().message.find("-hedless"), std::string::npos);
  EXPECT_NE(parse_game_options({"-size"}).error().message.find("-size"), std::string::npos);
  EXPECT_NE(parse_game_options({"-capture_every", "0"}).error().message.find("-capture_every"), std::string::npos);
  for (const char* bad : {"320", "x180", "320x", "0x5", "320x180x2", "99999x2", "-3x3"}) {
    EXPECT_FALSE(parse_size(bad).ok()) << bad;
  }
}

TEST(GameOptions, OneSideOfTheSizeGivesTheOther) {
  EXPECT_EQ(parse_game_options({"-width", "1280"})->size, uvec2(1280, 720));
  EXPECT_EQ(parse_game_options({"-height", "720"})->size, uvec2(1280, 720));
}

TEST(GameOptions, HelpNamesEveryOption) {
  for (const char* option :
       {"-basedir", "-game", "-headless", "-size", "-device", "-listdevices", "-capture", "-validation"}) {
    EXPECT_NE(game_help().find(option), std::string::npos) << option;
  }
}

}  // namespace
}  // namespace fb::host
