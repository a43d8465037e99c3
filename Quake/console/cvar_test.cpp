#include "console/cvar.h"

#include <gmock/gmock.h>

#include <climits>

namespace fb::con {
namespace {

using testing::HasSubstr;

TEST(Cvar, FreeText) {
  Cvar cvar({"name", "player", "your name"});
  EXPECT_EQ(cvar.string(), "player");
  EXPECT_EQ(cvar.value(), 0.0f);
  EXPECT_EQ(cvar.set("3.75 of them"), "");
  EXPECT_EQ(cvar.value(), 3.75f);
  EXPECT_EQ(cvar.integer(), 3);
  EXPECT_TRUE(cvar.on());
  EXPECT_EQ(cvar.set("1e99"), "");
  EXPECT_EQ(cvar.value(), 0.0f) << "no infinities reach the program";
  EXPECT_EQ(cvar.integer(), INT_MAX);
  EXPECT_EQ(cvar.set("nan"), "");
  EXPECT_EQ(cvar.value(), 0.0f);
  EXPECT_EQ(cvar.reset(), "");
  EXPECT_EQ(cvar.string(), "player");
}

TEST(Cvar, RangesClampInOneSentence) {
  Cvar cvar({"fov", "90", "", kCvarPlain, 10, 170});
  EXPECT_EQ(cvar.set("100"), "");
  EXPECT_EQ(cvar.string(), "100");
  EXPECT_EQ(cvar.set("200"), "fov: 200 is not allowed (10 to 170), so it is 170 now.");
  EXPECT_EQ(cvar.value(), 170.0f);
  EXPECT_THAT(cvar.set("-1"), HasSubstr("so it is 10 now"));
  EXPECT_EQ(cvar.set("wide"), "fov: \"wide\" is not a number, so it stays 10 (10 to 170).");
  EXPECT_THAT(cvar.set("50 60"), HasSubstr("not a number"));
  EXPECT_THAT(cvar.set("inf"), HasSubstr("not a number"));
  EXPECT_THAT(cvar.set(""), HasSubstr("not a number"));
  EXPECT_EQ(cvar.value(), 10.0f);
}

TEST(Cvar, WholeNumbers) {
  CvarSpec spec{"r_seed", "0", ""};
  spec.min = 0;
  spec.max = 2147483647;
  spec.integer = true;
  Cvar cvar(std::move(spec));
  EXPECT_EQ(cvar.set("123456789"), "");
  EXPECT_EQ(cvar.integer(), 123456789) << "exact, where a float would not be";
  EXPECT_THAT(cvar.set("2.6"), HasSubstr("so it is 3 now"));
  EXPECT_EQ(cvar.string(), "3");
  EXPECT_EQ(cvar.set("2147483647"), "");
  EXPECT_EQ(cvar.integer(), INT_MAX);
  EXPECT_THAT(cvar.range_text(), HasSubstr("whole numbers 0 to"));
}

TEST(Cvar, OpenRanges) {
  CvarSpec spec{"x", "1", ""};
  spec.min = 0.5f;
  EXPECT_EQ(Cvar(std::move(spec)).range_text(), "at least 0.5");
  CvarSpec other{"x", "1", ""};
  other.max = 2;
  EXPECT_EQ(Cvar(std::move(other)).range_text(), "at most 2");
  EXPECT_EQ(Cvar({"x", "1", ""}).range_text(), "");
}

TEST(Cvar, BetweenZeroAndItsLeastThereIsNothing) {
  CvarSpec spec{"x", "0", "", kCvarPlain, 0.0f, 1.0f};
  spec.least_above_zero = 0.25f;
  Cvar cvar(std::move(spec));
  EXPECT_EQ(cvar.set("1e-8"), "x: 1e-8 is not allowed (0, or 0.25 to 1), so it is 0.25 now.");
  EXPECT_EQ(cvar.value(), 0.25f);
  EXPECT_EQ(cvar.set("0"), "");
  EXPECT_EQ(cvar.value(), 0.0f);
  cvar.set("-1");
  EXPECT_EQ(cvar.value(), 0.0f);
  EXPECT_EQ(cvar.set("1e99"), "x: \"1e99\" is not a number, so it stays 0 (0, or 0.25 to 1).")
      << "too large for a float";
}

TEST(Cvar, LimitsAreNamedAsTheyAreWritten) {
  Cvar cvar({"x", "0", "", kCvarPlain, 0.0f, 0.1f});
  EXPECT_EQ(cvar.set("5"), "x: 5 is not allowed (0 to 0.1), so it is 0.1 now.");
  EXPECT_EQ(cvar.string(), "0.1");
  EXPECT_EQ(cvar.set("0.1"), "") << "a limit itself is allowed, though its float is not the number";
  Cvar least({"x", "1", "", kCvarPlain, 0.001f, 1.0f});
  EXPECT_EQ(least.set("0.001"), "");
  EXPECT_EQ(least.string(), "0.001");
}

TEST(Cvar, ListenersHearChangesOnly) {
  int calls = 0;
  float heard = 0.0f;
  CvarSpec spec{"x", "1", ""};
  spec.on_change = [&](const Cvar& cvar) { heard = cvar.value(); };
  Cvar cvar(std::move(spec));
  cvar.add_listener([&](const Cvar&) { ++calls; });
  EXPECT_EQ(calls, 0);
  cvar.set("1");
  EXPECT_EQ(calls, 0);
  cvar.set(2.5f);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(heard, 2.5f);
}

TEST(CvarDeathTest, ADefaultOutsideItsRangeIsAFault) {
  EXPECT_DEATH(Cvar({"x", "5", "", kCvarPlain, 0, 1}), "check failed");
}

TEST(Cvar, NumberText) {
  EXPECT_EQ(number_text(1.0f), "1");
  EXPECT_EQ(number_text(0.1f), "0.1");
  EXPECT_EQ(number_text(-0.0f), "0");
}

}  // namespace
}  // namespace fb::con
