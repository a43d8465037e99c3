#include "client/session/fog_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string_view>

#include "base/log.h"
#include "client/client.h"
#include "client/session/test_session.h"
#include "console/args.h"
#include "console/console.h"

namespace fb::cl {
namespace {

using test::ToldSession;
using testing::HasSubstr;
namespace svc = net::svc;

const Fog kBefore{0.25f, vec3(0.1f, 0.2f, 0.3f)};  // density, colour
constexpr double kSecond = 10.0;                   // when the command comes

struct Case {
  const char* line;
  float density;
  vec3 color;
  double seconds;  // of the change
};
const Case kCases[] = {
    {"fog 0.5", 0.5f, kBefore.color, 0.0},
    {"fog 0.5 4", 0.5f, kBefore.color, 4.0},
    {"fog 0.5 0.6 0.7", kBefore.density, {0.5f, 0.6f, 0.7f}, 0.0},
    {"fog 0.5 0.6 0.7 0.8", 0.5f, {0.6f, 0.7f, 0.8f}, 0.0},
    {"fog 0.5 0.6 0.7 0.8 4", 0.5f, {0.6f, 0.7f, 0.8f}, 4.0},
    // DarkPlaces': the fifth is an opacity, not a time.
    {"fog 0.5 0.6 0.7 0.8 1 8", 0.5f, {0.6f, 0.7f, 0.8f}, 0.0},
    {"fog 0.5 0.6 0.7 0.8 1 0 16384 1024 32", 0.5f, {0.6f, 0.7f, 0.8f}, 0.0},
    {"fog 0.5 0.6 0.7 0.8 1 0 16384 1024 32 7", 0.5f, {0.6f, 0.7f, 0.8f}, 0.0},
    // Held to what there is; of a word its beginning counts.
    {"fog -1", 0.0f, kBefore.color, 0.0},
    {"fog 1e9", kDensestFog, kBefore.color, 0.0},
    {"fog 0.5 -4", 0.5f, kBefore.color, 0.0},
    {"fog 0.5 -1 2 0.5 -4", 0.5f, {0.0f, 1.0f, 0.5f}, 0.0},
    {"fog \"0.5\" 0.6x .7 +0.8", 0.5f, {0.6f, 0.7f, 0.8f}, 0.0},
};

void expect_fog(const Fog& fog, float density, const vec3& color, const char* line) {
  EXPECT_FLOAT_EQ(fog.density, density) << line;
  for (int i = 0; i < 3; ++i) EXPECT_FLOAT_EQ(fog.color[i], color[i]) << line;
}

void expect_change(const FogState& fog, const Case& c) {
  if (c.seconds > 0.0) {
    expect_fog(fog_at(fog, kSecond), kBefore.density, kBefore.color, c.line);
    expect_fog(fog_at(fog, kSecond + 0.5 * c.seconds), 0.5f * (kBefore.density + c.density),
               0.5f * (kBefore.color + c.color), c.line);
  }
  expect_fog(fog_at(fog, kSecond + c.seconds), c.density, c.color, c.line);
}

TEST(FogCommand, NumbersMeanByTheirCount) {
  for (const Case& c : kCases) {
    ClientState state;
    state.time = kSecond;
    state.fog.now = kBefore;
    const auto said = fog_command(state, con::Args(c.line));
    ASSERT_TRUE(said.ok()) << c.line;
    EXPECT_EQ(*said, "") << c.line;
    expect_change(state.fog, c);
  }
}

TEST(FogCommand, AServersTextMeansTheSame) {
  for (const Case& c : kCases) {
    ToldSession s;
    s.state.time = kSecond;
    s.state.fog.now = kBefore;
    s.tell({svc::StuffText{std::string(c.line) + "\n"}});
    expect_change(s.state.fog, c);
  }
}

TEST(FogCommand, AChangeGoesOnFromWhereTheLastOneIs) {
  ClientState state;
  ASSERT_TRUE(fog_command(state, con::Args("fog 1 4")).ok());
  state.time = 2.0;
  ASSERT_TRUE(fog_command(state, con::Args("fog 0 1")).ok());
  EXPECT_FLOAT_EQ(fog_at(state.fog, 2.5).density, 0.25f);
  ASSERT_TRUE(fog_command(state, con::Args("fog 1 0 0")).ok());
  EXPECT_FLOAT_EQ(fog_at(state.fog, 2.5).density, 0.5f) << "what it was when the colour came";
}

std::string log_of(const std::function<void()>& run) {
  std::string log;
  const int listener = add_log_listener([&](LogLevel, std::string_view line) { log += std::string(line) + "\n"; });
  run();
  remove_log_listener(listener);
  return log;
}

TEST(FogCommand, NonsenseIsOneSentenceAndNoChange) {
  for (const char* words : {"red", "0.5 red", "0.5 0.6 0.7 red", "nan", "1e99", "\"\"", "0.5 1 1 1 1 0 red"}) {
    ToldSession s;
    s.state.fog.now = kBefore;
    const std::string line = std::string("fog ") + words;
    const auto said = fog_command(s.state, con::Args(line));
    ASSERT_FALSE(said.ok()) << line;
    EXPECT_THAT(said.error().message, testing::EndsWith(": a number is wanted"));
    EXPECT_EQ(log_of([&] { s.tell({svc::StuffText{line + "\n"}}); }), said.error().message + "\n");
    s.quiet = true;
    EXPECT_EQ(log_of([&] { s.tell({svc::StuffText{line + "\n"}}); }), "") << "passed over in a demo";
    expect_fog(fog_at(s.state.fog, s.state.time), kBefore.density, kBefore.color, words);
  }
}

TEST(FogCommand, AtTheConsole) {
  con::Console console;
  scene::ModelLibrary library(nullptr);
  Client client(console, library, nullptr);
  const auto say = [&](const char* line) { return log_of([&] { console.execute(line); }); };
  EXPECT_EQ(say("fog 0.5 0.1 0.2 0.3"), "");
  expect_fog(client.fog(), 0.5f, {0.1f, 0.2f, 0.3f}, "density and colour");
  EXPECT_THAT(say("fog"), HasSubstr("Now: density 0.5, colour 0.1 0.2 0.3"));
  EXPECT_THAT(say("fog"), HasSubstr("fog <density> [seconds]"));
  EXPECT_EQ(say("fog 0.75"), "");
  expect_fog(client.fog(), 0.75f, {0.1f, 0.2f, 0.3f}, "density");
  EXPECT_EQ(say("fog 0.4 0.5 0.6"), "");
  expect_fog(client.fog(), 0.75f, {0.4f, 0.5f, 0.6f}, "colour");
  EXPECT_EQ(say("fog 0 3"), "");
  expect_fog(client.fog(), 0.75f, {0.4f, 0.5f, 0.6f}, "density in three seconds");
  EXPECT_EQ(say("fog 1 0.4 0.5 0.6 3"), "");
  expect_fog(client.fog(), 0.75f, {0.4f, 0.5f, 0.6f}, "both in three seconds");
  EXPECT_EQ(say("fog 0.1 0.2 0.3 0.4 1 0"), "");
  expect_fog(client.fog(), 0.1f, {0.2f, 0.3f, 0.4f}, "six");
  EXPECT_EQ(say("fog 0.2 0.3 0.4 0.5 1 0 16384 1024 32"), "");
  expect_fog(client.fog(), 0.2f, {0.3f, 0.4f, 0.5f}, "nine");
  EXPECT_EQ(say("fog 0.3 0.4 0.5 0.6 1 0 16384 1024 32 7"), "");
  expect_fog(client.fog(), 0.3f, {0.4f, 0.5f, 0.6f}, "ten");
  EXPECT_EQ(say("fog red"), "fog red: a number is wanted\n");
  expect_fog(client.fog(), 0.3f, {0.4f, 0.5f, 0.6f}, "nonsense");
}

}  // namespace
}  // namespace fb::cl
