#include "ui/console_view.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "ui/test_raster.h"

namespace fb::ui {
namespace {

constexpr int kWidth = 160, kHeight = 96;  // 18 columns of text, 12 rows

class ConsoleViewTest : public testing::Test {
 protected:
  // The rows of text, with the background transparent so that it does not hide them from the reader.
  std::vector<std::string> rows(ConsoleView view, int scale = 1) {
    view.opacity = 0.0f;
    view.fraction = std::min(view.fraction, 0.999f);
    scene::DrawList list;
    {
      Painter painter(list, atlas, kWidth * scale, kHeight * scale, scale);
      draw_console(painter, lines, input, view);
    }
    Raster raster(kWidth * scale, kHeight * scale);
    raster.draw(list);
    std::vector<std::string> read;
    for (int y = 0; y < kHeight; y += 8) read.push_back(raster.text(atlas, 8 * scale, y * scale, 18, scale));
    return read;
  }

  Atlas atlas;
  con::Scrollback lines;
  con::InputLine input;
};

TEST_F(ConsoleViewTest, NewestLineAboveTheInput) {
  lines.add(LogLevel::kInfo, "first");
  lines.add(LogLevel::kWarning, "second");
  input.insert("map start");
  ConsoleView view;
  view.fraction = 1.0f;
  view.time = 0.3;  // the cursor is dark
  for (int scale = 1; scale <= 2; ++scale) {
    const auto read = rows(view, scale);
    EXPECT_EQ(read[8], "first");
    EXPECT_EQ(read[9], "second");
    EXPECT_EQ(read[10], "]map start");
    EXPECT_EQ(read[7], "");
  }
}

TEST_F(ConsoleViewTest, HalfDown) {
  lines.add(LogLevel::kInfo, "first");
  ConsoleView view;
  view.time = 0.3;
  const auto read = rows(view);
  EXPECT_EQ(read[3], "first");
  EXPECT_EQ(read[4], "]");
  for (std::size_t row = 5; row < read.size(); ++row) EXPECT_EQ(read[row], "");
}

TEST_F(ConsoleViewTest, LongLinesWrapUpwards) {
  lines.add(LogLevel::kInfo, "before");
  lines.add(LogLevel::kInfo, "a line that is longer than it");
  ConsoleView view;
  view.fraction = 1.0f;
  view.time = 0.3;
  const auto read = rows(view);
  EXPECT_EQ(read[7], "before");
  EXPECT_EQ(read[8], "a line that is");
  EXPECT_EQ(read[9], "longer than it");
  EXPECT_EQ(read[10], "]");
}

TEST_F(ConsoleViewTest, ScrolledUp) {
  for (int i = 0; i < 30; ++i) lines.add(LogLevel::kInfo, "line " + std::to_string(i));
  ConsoleView view;
  view.fraction = 1.0f;
  view.scrolled_up = 10;
  view.time = 0.3;
  const auto read = rows(view);
  EXPECT_EQ(read[9], "^   ^   ^   ^   ^");
  EXPECT_EQ(read[8], "line 19");
  EXPECT_EQ(read[0], "line 11");
  view.scrolled_up = 1000;
  EXPECT_EQ(rows(view)[8], "");
}

TEST_F(ConsoleViewTest, ScrolledToTheFirstLine) {
  for (int i = 0; i < 30; ++i) lines.add(LogLevel::kInfo, "line " + std::to_string(i));
  ConsoleView view;
  view.time = 0.3;
  for (const float fraction : {0.5f, 1.0f}) {
    view.fraction = fraction;
    view.scrolled_up = lines.size() - console_rows(kHeight, fraction);
    const auto read = rows(view);
    EXPECT_EQ(read[0], "line 0") << "the top row is filled, and by the first line";
  }
}

TEST_F(ConsoleViewTest, InputScrollsWithTheCursor) {
  input.insert("0123456789abcdefghijklmnopqrstuvwxyz");
  ConsoleView view;
  view.time = 0.3;
  EXPECT_EQ(rows(view)[4], "jklmnopqrstuvwxyz") << "the end, and a place for the cursor";
  input.home();
  EXPECT_EQ(rows(view)[4], "]0123456789abcdefg");
}

TEST_F(ConsoleViewTest, TheCursorBlinks) {
  ConsoleView view;
  view.time = 0.3;
  const auto dark = rows(view);
  view.time = 0.6;
  EXPECT_NE(rows(view)[4], dark[4]);
  view.time = 0.8;
  EXPECT_EQ(rows(view)[4], dark[4]);
}

TEST_F(ConsoleViewTest, BackgroundCoversItsPartAlone) {
  const auto draw = [&](float fraction) {
    scene::DrawList list;
    {
      Painter painter(list, atlas, kWidth, kHeight, 1);
      draw_console(painter, lines, input, {fraction, 0.5f, 0, 0.3});
    }
    Raster raster(kWidth, kHeight);
    raster.draw(list);
    return raster;
  };
  const Raster half = draw(0.5f), all = draw(1.0f), none = draw(0.0f);
  EXPECT_TRUE(half.lit(100, kHeight / 2 - 1));
  EXPECT_FALSE(half.lit(100, kHeight / 2));
  EXPECT_TRUE(all.lit(kWidth - 1, kHeight - 1));
  EXPECT_GT(all.at(100, 3).x, half.at(100, 3).x) << "without a game behind it, it is opaque";
  EXPECT_FALSE(none.lit(100, 0));
}

TEST_F(ConsoleViewTest, TinyOutputsDoNoHarm) {
  lines.add(LogLevel::kInfo, "something to say");
  for (int size = 1; size < 40; size += 3) {
    scene::DrawList list;
    {
      Painter painter(list, atlas, size, size, 1);
      draw_console(painter, lines, input, {1.0f, 0.5f, 0, 0.0});
    }
    Raster raster(size, size);
    raster.draw(list);
    EXPECT_TRUE(raster.lit(0, 0));
  }
}

}  // namespace
}  // namespace fb::ui
