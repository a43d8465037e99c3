#include "base/log_flow.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/log.h"
#include "base/log_budget.h"

namespace fb {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

constexpr LogLimits kSmall{.burst = 10.0, .lines_a_second = 2.0, .same_in_a_row = 3};

struct Said {
  Said() {
    handle = add_log_listener([this](LogLevel, std::string_view line) { lines.emplace_back(line); });
  }
  ~Said() { remove_log_listener(handle); }
  std::vector<std::string> lines;
  int handle;
};

TEST(LogFlow, FewLinesAreAllWritten) {
  const Said said;
  const LogBudget budget(kSmall);
  for (const char* line : {"a", "a", "a", "b", "a"}) log_info("{}", line);
  EXPECT_THAT(said.lines, ElementsAre("a", "a", "a", "b", "a"));
}

TEST(LogFlow, ALineThatComesOverAndOverIsCounted) {
  const Said said;
  const LogBudget budget(kSmall);
  for (int i = 0; i < 100; ++i) log_info("again");
  EXPECT_THAT(said.lines, ElementsAre("again", "again", "again"));
  log_info("else");
  EXPECT_THAT(said.lines, ElementsAre("again", "again", "again", "(the same line 97 more times)", "else"));
}

TEST(LogFlow, WhatWasCountedIsSaidAfterASecondOrAtTheEnd) {
  const Said said;
  {
    const LogBudget budget(kSmall);
    for (int i = 0; i < 5; ++i) log_info("again");
    advance_log_time(0.5);
    EXPECT_THAT(said.lines, SizeIs(3));
    advance_log_time(0.5);
    EXPECT_THAT(said.lines, ElementsAre("again", "again", "again", "(the same line 2 more times)"));
    advance_log_time(5.0);
    EXPECT_THAT(said.lines, SizeIs(4)) << "once";
    for (int i = 0; i < 7; ++i) log_info("again");
  }
  EXPECT_EQ(said.lines.back(), "(the same line 7 more times)");
}

TEST(LogFlow, BeyondTheBudgetLinesAreCountedAndAnErrorIsWritten) {
  const Said said;
  LogBudget budget(kSmall);
  for (int i = 0; i < 1000; ++i) log_info("line {}", i);
  ASSERT_THAT(said.lines, SizeIs(9)) << "ten, less what their length costs";
  log_error("the end");
  EXPECT_THAT(said.lines, SizeIs(11));
  EXPECT_EQ(said.lines[9], "(991 lines are left out: more than 2 a second)");
  EXPECT_EQ(said.lines[10], "the end");
}

// A mod that asks in every frame for a level that is not there.
TEST(LogFlow, ErrorsWithoutEndAreCounted) {
  const Said said;
  const LogBudget budget(kSmall);
  for (int i = 0; i < 100; ++i) log_error("no such map");
  EXPECT_THAT(said.lines, ElementsAre("no such map", "no such map", "no such map"));
  log_info("else");
  EXPECT_THAT(said.lines,
              ElementsAre("no such map", "no such map", "no such map", "(the same line 97 more times)", "else"));
  for (int i = 0; i < 1000; ++i) log_error("no map {}", i % 2);
  EXPECT_THAT(said.lines, SizeIs(5u + 6u)) << "ten, less what their length costs";
  log_info("else");
  EXPECT_EQ(said.lines[11], "(994 lines are left out: more than 2 a second)");
}

TEST(LogFlow, TheBudgetComesBackWithTime) {
  const Said said;
  const LogBudget budget(kSmall);
  int line = 0;
  std::size_t written = 0;
  for (int second = 0; second < 100; ++second) {
    for (int i = 0; i < 10000; ++i) log_info("{}", line++);
    advance_log_time(1.0);
  }
  for (const std::string& text : said.lines) written += text.front() != '(';
  EXPECT_GE(written, 9u + 99u) << "two a second, less what their length costs";
  EXPECT_LE(written, 10u + 200u);
  EXPECT_THAT(said.lines, SizeIs(testing::Le(10u + 200u + 200u)));
}

TEST(LogFlow, LongLinesCountAsSeveral) {
  const Said said;
  const LogBudget budget(kSmall);
  for (int i = 0; i < 10; ++i) log_info("{}{}", i, std::string(1000, 'x'));
  EXPECT_THAT(said.lines, SizeIs(2));
}

TEST(LogFlow, WithoutABudgetEverythingIsWritten) {
  const Said said;
  for (int i = 0; i < 300; ++i) log_info("again");
  EXPECT_THAT(said.lines, SizeIs(300));
}

// `edicts` on the largest level prints 32,000 entities.
TEST(LogFlow, TheUsualLimitsHoldTheLongestList) {
  LogFlow flow{LogLimits{}};
  for (int i = 0; i < 32000; ++i) ASSERT_TRUE(flow.take(std::to_string(i) + std::string(500, 'x'), false).written);
}

}  // namespace
}  // namespace fb
