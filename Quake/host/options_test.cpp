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

TEST(GameOptions, ServersSayForHowMany) {
  EXPECT_FALSE(parse_game_options({"+map", "start"})->dedicated);
  const auto dedicated = parse_game_options({"-dedicated", "4", "-port", "27000", "-seed", "12"});
  ASSERT_TRUE(dedicated.ok());
  EXPECT_TRUE(dedicated->dedicated);
  EXPECT_EQ(dedicated->max_clients, 4);
  EXPECT_EQ(dedicated->port, 27000u);
  EXPECT_EQ(dedicated->seed, 12u);
  const auto listening = parse_game_options({"-listen", "+map", "start"});
  ASSERT_TRUE(listening.ok());
  EXPECT_FALSE(listening->dedicated);
  EXPECT_EQ(listening->max_clients, 8);
  EXPECT_FALSE(listening->seed.has_value());
  for (const std::vector<std::string>& bad : {std::vector<std::string>{"-dedicated", "0"},
                                              {"-listen", "17"},
                                              {"-port", "0"},
                                              {"-port", "65536"},
                                              {"-seed", "x"},
                                              {"-seed"}}) {
    const auto refused = parse_game_options(bad);
    ASSERT_FALSE(refused.ok()) << bad[0];
    EXPECT_NE(refused.error().message.find(bad[0]), std::string::npos);
  }
}

TEST(GameOptions, OneSideOfTheSizeGivesTheOther) {
  EXPECT_EQ(parse_game_options({"-width", "1280"})->size, uvec2(1280, 720));
  EXPECT_EQ(parse_game_options({"-height", "720"})->size, uvec2(1280, 720));
}

TEST(GameOptions, HelpNamesEveryOption) {
  for (const char* option : {"-basedir", "-basegame", "-game", "-headless", "-size", "-device", "-listdevices",
                             "-capture", "-validation", "-dedicated", "-listen", "-port", "-seed"}) {
    EXPECT_NE(game_help().find(option), std::string::npos) << option;
  }
}

}  // namespace
}  // namespace fb::host
