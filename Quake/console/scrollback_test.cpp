#include "console/scrollback.h"

#include <gmock/gmock.h>

namespace fb::con {
namespace {

std::vector<std::string> texts(const std::vector<ScrollLine>& lines) {
  std::vector<std::string> list;
  for (const ScrollLine& line : lines) list.push_back(line.text);
  return list;
}
using testing::ElementsAre;
using testing::IsEmpty;

TEST(Scrollback, LatestLines) {
  Scrollback lines;
  for (const char* text : {"a", "b", "c", "d"}) lines.add(LogLevel::kInfo, text);
  EXPECT_THAT(texts(lines.latest(2)), ElementsAre("c", "d"));
  EXPECT_THAT(texts(lines.latest(2, 1)), ElementsAre("b", "c"));
  EXPECT_THAT(texts(lines.latest(9, 3)), ElementsAre("a"));
  EXPECT_THAT(texts(lines.latest(9, 9)), IsEmpty());
  EXPECT_EQ(lines.total(), 4u);
  lines.clear();
  EXPECT_EQ(lines.size(), 0u);
  EXPECT_EQ(lines.total(), 4u);
}

TEST(Scrollback, NewlinesMakeLines) {
  Scrollback lines;
  lines.add(LogLevel::kWarning, "a\n\nb\n");
  lines.add(LogLevel::kInfo, "");
  EXPECT_THAT(texts(lines.latest(9)), ElementsAre("a", "", "b", ""));
  EXPECT_EQ(lines.latest(9)[2].level, LogLevel::kWarning);
}

TEST(Scrollback, OldLinesMakeRoom) {
  Scrollback lines(10000);
  for (int i = 0; i < 1000; ++i) lines.add(LogLevel::kInfo, "line " + std::to_string(i));
  EXPECT_LT(lines.size(), 10000u / sizeof(ScrollLine) + 1);
  EXPECT_GT(lines.size(), 50u);
  EXPECT_EQ(lines.latest(1).front().text, "line 999");
  lines.add(LogLevel::kInfo, std::string(50000, 'x'));
  EXPECT_LT(lines.latest(1).front().text.size(), 10000u);
}

TEST(Scrollback, RoomMayChange) {
  Scrollback lines(1000000);
  for (int i = 0; i < 1000; ++i) lines.add(LogLevel::kInfo, "line");
  ASSERT_EQ(lines.size(), 1000u);
  lines.set_max_bytes(16384);
  lines.add(LogLevel::kInfo, "last");
  EXPECT_LT(lines.size(), 16384u / sizeof(ScrollLine));
  EXPECT_EQ(lines.latest(1)[0].text, "last");
}

TEST(Scrollback, RecentLinesByTime) {
  Scrollback lines;
  lines.set_time(1.0);
  lines.add(LogLevel::kInfo, "old");
  lines.set_time(4.0);
  lines.add(LogLevel::kInfo, "new");
  lines.add(LogLevel::kInfo, "newer");
  EXPECT_THAT(texts(lines.recent(4, 4.5, 3.0)), ElementsAre("new", "newer"));
  EXPECT_THAT(texts(lines.recent(1, 4.5, 3.0)), ElementsAre("newer"));
  EXPECT_THAT(texts(lines.recent(4, 3.5, 3.0)), ElementsAre("old", "new", "newer"));
  EXPECT_THAT(lines.recent(4, 7.0, 3.0), IsEmpty());
}

}  // namespace
}  // namespace fb::con
