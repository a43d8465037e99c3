#include "host/options.h"

#include <gmock/gmock.h>

#include "host/game/engine.h"
#include "host/option_table.h"

namespace fb::host {
namespace {

using testing::HasSubstr;
using testing::Not;

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
  for (const Option& option : option_table()) {
    if (option.help != nullptr) {
      EXPECT_THAT(game_help(), HasSubstr(option.name));
    }
  }
  std::size_t start = 0;
  for (std::size_t end; (end = game_help().find('\n', start)) != std::string::npos; start = end + 1)
    EXPECT_LE(end - start, 120u) << game_help().substr(start, end - start);
}

TEST(GameOptions, NamesAreUnique) {
  for (const Option& option : option_table()) EXPECT_EQ(find_option(option.name), &option) << option.name;
}

// What QuakeSpasm 0.96.3 takes, with the values that it takes; then what vkQuake 1.37 and Ironwail have besides.
const std::vector<std::vector<std::string>> kTheirOptions = {{"-bpp", "32"},
                                                             {"-condebug"},
                                                             {"-consize", "64"},
                                                             {"-current"},
                                                             {"-dedicated"},
                                                             {"-dedicated", "4"},
                                                             {"-fitz"},
                                                             {"-fsaa", "4"},
                                                             {"-fullscreen"},
                                                             {"-game", "ad"},
                                                             {"-heapsize", "524288"},
                                                             {"-height", "600"},
                                                             {"-hipnotic"},
                                                             {"-ip", "127.0.0.1"},
                                                             {"-ipxport", "26001"},
                                                             {"-listen"},
                                                             {"-listen", "4"},
                                                             {"-minmemory"},
                                                             {"-mixspeed", "48000"},
                                                             {"-noadd"},
                                                             {"-nocombine"},
                                                             {"-noextmusic"},
                                                             {"-noglsl"},
                                                             {"-noglslalias"},
                                                             {"-noglslgamma"},
                                                             {"-nojoy"},
                                                             {"-nolan"},
                                                             {"-nomouse"},
                                                             {"-nomtex"},
                                                             {"-nopackedpixels"},
                                                             {"-nosound"},
                                                             {"-notexturenpot"},
                                                             {"-noudp"},
                                                             {"-novbo"},
                                                             {"-nowarpmipmaps"},
                                                             {"-particles", "32768"},
                                                             {"-port", "26001"},
                                                             {"-protocol", "999"},
                                                             {"-quoth"},
                                                             {"-refreshrate", "60"},
                                                             {"-rogue"},
                                                             {"-safe"},
                                                             {"-sndspeed", "44100"},
                                                             {"-udpport", "26001"},
                                                             {"-width", "800"},
                                                             {"-window"},
                                                             {"-zone", "4096"},
                                                             {"-basedir", "."},
                                                             {"-nocdaudio"},
                                                             {"-cddev", "F"},
                                                             {"-nodepthclamp"},
                                                             {"-stdvid"},
                                                             {"-dibonly"},
                                                             {"-noipx"},
                                                             {"-mem", "64"},
                                                             {"-cachesize", "8"},
                                                             {"-surfcachesize", "8"},
                                                             {"-nohome"},
                                                             {"-proghack"},
                                                             {"-noadjustaspect"},
                                                             // vkQuake
                                                             {"-validation"},
                                                             {"-device", "1"},
                                                             {"-multiuser"},
                                                             {"-nomapchecks"},
                                                             {"-pinnedworkers"},
                                                             {"-noudp4"},
                                                             {"-noudp6"},
                                                             {"-steam"},
                                                             {"-nosteam"},
                                                             {"-nosteamapi"},
                                                             {"-gog"},
                                                             {"-nogog"},
                                                             {"-egs"},
                                                             {"-noegs"},
                                                             {"-epic"},
                                                             {"-noepic"},
                                                             {"-nonightdive"},
                                                             {"-original"},
                                                             {"-preforiginal"},
                                                             {"-remaster"},
                                                             {"-remastered"},
                                                             {"-prefremaster"},
                                                             // Ironwail
                                                             {"-nobufferstorage"},
                                                             {"-nomultibind"},
                                                             {"-nobindless"},
                                                             {"-noclipcontrol"},
                                                             {"-noaddons"},
                                                             {"-addons", "http://x"}};

TEST(GameOptions, QuakeSpasmsAndItsDescendantsAreTaken) {
  std::vector<std::string> all;
  for (const std::vector<std::string>& one : kTheirOptions) {
    // The value is the option's, so that the command behind it is one.
    std::vector<std::string> line = one;
    line.insert(line.end(), {"+map", "start"});
    const auto options = parse_game_options(line);
    EXPECT_TRUE(options.ok()) << options.error().message;
    if (options) {
      EXPECT_TRUE(options->has_commands) << one[0];
    }
    line = one;
    line.push_back("-headless");
    if (const auto behind = parse_game_options(line)) {
      EXPECT_TRUE(behind->headless) << one[0];
    }
    all.insert(all.end(), one.begin(), one.end());
  }
  EXPECT_TRUE(parse_game_options(all).ok()) << parse_game_options(all).error().message;
}

TEST(GameOptions, ValuesOfWhatHasNoEffectMayBeMissing) {
  for (const Option& option : option_table()) {
    if (option.apply == nullptr) {
      EXPECT_TRUE(parse_game_options({option.name}).ok()) << option.name;
    }
  }
  const auto options = parse_game_options({"-zone", "-headless", "-heapsize", "+map", "start"});
  ASSERT_TRUE(options.ok());
  EXPECT_TRUE(options->headless && options->has_commands);
}

TEST(GameOptions, AMistypedOptionIsNotPassedOver) {
  EXPECT_THAT(parse_game_options({"-hedless"}).error().message, HasSubstr("is -headless meant?"));
  EXPECT_THAT(parse_game_options({"-condbug"}).error().message, HasSubstr("is -condebug meant?"));
  EXPECT_THAT(parse_game_options({"-x"}).error().message, Not(HasSubstr("meant")));
  EXPECT_THAT(parse_game_options({"-frobnicate"}).error().message, Not(HasSubstr("meant")));
  EXPECT_THAT(parse_game_options({"start"}).error().message, HasSubstr("start: options begin with -"));
}

TEST(GameOptions, QuakeSpasmsDoWhatTheySay) {
  const auto engine_of = [](const std::vector<std::string>& line) {
    const auto options = parse_game_options(line);
    EXPECT_TRUE(options.ok()) << options.error().message;
    return options ? engine_options(*options) : EngineOptions{};
  };
  EXPECT_EQ(engine_of({"-protocol", "15"}).protocol, 15);
  EXPECT_FALSE(engine_of({}).protocol.has_value());
  EXPECT_TRUE(engine_of({"-condebug"}).console_log);
  EXPECT_FALSE(engine_of({}).console_log);
  EXPECT_EQ(engine_of({"-consize", "64"}).console_kilobytes, 64u);
  EXPECT_EQ(engine_of({"-consize", "1"}).console_kilobytes, 16u) << "as QuakeSpasm has it";
  EXPECT_EQ(engine_of({"-particles", "4000"}).particles, 4000u);
  EXPECT_EQ(engine_of({"-particles", "99999"}).particles, 32768u);
  EXPECT_EQ(engine_of({"-udpport", "27000"}).port, 27000);
  EXPECT_TRUE(engine_of({}).network.any());
  EXPECT_FALSE(engine_of({"-nolan"}).network.any());
  EXPECT_FALSE(engine_of({"-noudp"}).network.any());
  EXPECT_FALSE(engine_of({"-noudp4"}).network.uses(net::Family::kIpv4));
  EXPECT_TRUE(engine_of({"-noudp4"}).network.uses(net::Family::kIpv6));
  EXPECT_FALSE(engine_of({"-noudp6"}).network.uses(net::Family::kIpv6));
  EXPECT_EQ(engine_of({"-ip", "192.0.2.1"}).network.own_address->to_string(), "192.0.2.1:26000");
  EXPECT_FALSE(engine_of({"-ip", "192.0.2.1"}).network.uses(net::Family::kIpv6));
  EXPECT_FALSE(parse_game_options({"-nomouse"})->mouse);
  const auto safe = parse_game_options({"-safe"});
  EXPECT_FALSE(safe->mouse || safe->network.any());
  for (const std::vector<std::string>& bad : {std::vector<std::string>{"-protocol", "14"},
                                              {"-protocol"},
                                              {"-ip", "nowhere"},
                                              {"-ip"},
                                              {"-consize", "x"},
                                              {"-particles", "-1"},
                                              {"-width", "0"}}) {
    const auto refused = parse_game_options(bad);
    ASSERT_FALSE(refused.ok()) << bad[0];
    EXPECT_THAT(refused.error().message, HasSubstr(bad[0]));
  }
}

}  // namespace
}  // namespace fb::host
