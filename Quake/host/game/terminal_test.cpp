#include "host/game/terminal.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace fb::host {
namespace {

TEST(TerminalLines, ComeWholeAndWithoutWaiting) {
  int ends[2] = {-1, -1};
  ASSERT_EQ(pipe(ends), 0);
  TerminalLines lines(ends[0]);
  const auto type = [&](const std::string& text) {
    EXPECT_EQ(write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  };
  EXPECT_EQ(lines.next(), std::nullopt) << "nothing typed, nothing waited for";
  type("map st");
  EXPECT_EQ(lines.next(), std::nullopt) << "half a line";
  type("art\nstatus\n\nqu");
  EXPECT_EQ(lines.next(), "map start");
  EXPECT_EQ(lines.next(), "status");
  EXPECT_EQ(lines.next(), "");
  EXPECT_EQ(lines.next(), std::nullopt);
  type("it");
  close(ends[1]);
  EXPECT_EQ(lines.next(), "quit") << "the last line may lack its end";
  EXPECT_EQ(lines.next(), std::nullopt);
  close(ends[0]);
}

}  // namespace
}  // namespace fb::host
