#include "console/other_engines.h"

#include <gmock/gmock.h>

namespace fb::con {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(OtherEngines, TheirNamesAreNoUnknownCommands) {
  Console console;
  add_other_engines(console);
  console.execute("topcolor 11\nserverinfo dq 1\nif \"FTE\" isin $qt$version$qt then set generic fte\nvid_fsaamode 1");
  for (const ScrollLine& line : console.scrollback().latest(100))
    EXPECT_THAT(line.text, Not(HasSubstr("Unknown command")));
  EXPECT_EQ(console.cvar("topcolor").string(), "11");
  EXPECT_FALSE(console.cvar("topcolor").has_effect());
  EXPECT_EQ(console.find_cvar("generic"), nullptr) << "what stands behind a condition is not run";
  EXPECT_EQ(console.config_text(), "") << "no configuration gets them";
}

TEST(OtherEngines, WhatIsThereStays) {
  Console console;
  console.add_cvar("topcolor", "3", "a setting of ours");
  int called = 0;
  console.add_command("serverinfo", "ours", [&](const Args&) { ++called; });
  add_other_engines(console);
  console.execute("serverinfo");
  EXPECT_EQ(called, 1);
  EXPECT_TRUE(console.cvar("topcolor").has_effect());
}

}  // namespace
}  // namespace fb::con
