#include "base/system.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <ctime>
#include <limits>
#include <memory>

namespace fb {
namespace {

TEST(SystemTest, ThereIsRoomForLittleAndNotForEverything) {
  EXPECT_TRUE(has_room(1 << 20));
  EXPECT_FALSE(has_room(std::numeric_limits<std::size_t>::max() / 2));
}

TEST(SystemTest, TheMachineHasMoreThanThisTestTakes) { EXPECT_GT(physical_memory(), std::uint64_t{64} << 20); }

TEST(SystemTest, AFileIsNoTerminal) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), std::fclose);
  ASSERT_TRUE(file);
  EXPECT_FALSE(is_terminal(file.get()));
}

TEST(SystemTest, TheSecondDayOf1970InGreenwich) {
  const auto day = calendar_time(86400 + 3661, Zone::kGreenwich);
  ASSERT_TRUE(day);
  EXPECT_EQ(day->tm_year, 70);
  EXPECT_EQ(day->tm_mday, 2);
  EXPECT_EQ(day->tm_hour, 1);
  EXPECT_EQ(day->tm_min, 1);
  EXPECT_EQ(day->tm_sec, 1);
}

TEST(SystemTest, AYearThatNoCalendarHasIsNone) {
  EXPECT_FALSE(calendar_time(std::numeric_limits<std::time_t>::max(), Zone::kGreenwich));
}

TEST(SystemTest, ArgumentsAreThoseOfMain) {
  // On Windows they come from the system, which knows this program's own.
  char name[] = "quake";
  char* argv[] = {name, nullptr};
  EXPECT_FALSE(program_arguments(1, argv).empty());
}

}  // namespace
}  // namespace fb
