#include "console/input_line.h"

#include <gmock/gmock.h>

#include "console/console.h"

namespace fb::con {
namespace {

using testing::ElementsAre;

TEST(InputLine, Editing) {
  InputLine line;
  line.insert("map start\n");
  EXPECT_EQ(line.text(), "map start");
  line.move(-5);
  line.erase_before();
  line.insert("_");
  EXPECT_EQ(line.text(), "map_start");
  line.home();
  line.erase_before();
  line.erase_at();
  EXPECT_EQ(line.text(), "ap_start");
  line.move(-3);
  EXPECT_EQ(line.cursor(), 0u);
  line.move(99);
  EXPECT_EQ(line.cursor(), 8u);
  line.erase_at();
  EXPECT_EQ(line.text(), "ap_start");
}

TEST(InputLine, Words) {
  InputLine line;
  line.insert("one two  three");
  line.move_word(-1);
  EXPECT_EQ(line.cursor(), 9u);
  line.erase_word_before();
  EXPECT_EQ(line.text(), "one three");
  line.home();
  line.move_word(1);
  EXPECT_EQ(line.cursor(), 4u);
}

TEST(InputLine, HasAnEnd) {
  InputLine line;
  line.insert(std::string(5000, 'x'));
  EXPECT_EQ(line.text().size(), InputLine::kMaxLength);
}

TEST(InputLine, EnterExecutesAndRemembers) {
  Console console;
  InputLine line;
  std::vector<std::string> done;
  console.add_command("do", "", [&](const Args& args) { done.push_back(args[1]); });
  for (const char* text : {"do 1", "do 2", "do 2", ""}) {
    line.set_text(text);
    line.enter(console);
  }
  console.execute();
  EXPECT_THAT(done, ElementsAre("1", "2", "2"));
  EXPECT_THAT(line.history(), ElementsAre("do 1", "do 2"));

  line.insert("typing");
  line.recall(1);
  EXPECT_EQ(line.text(), "do 2");
  line.recall(1);
  line.recall(1);
  EXPECT_EQ(line.text(), "do 1");
  line.recall(-1);
  line.recall(-1);
  EXPECT_EQ(line.text(), "typing");
  line.recall(-1);
  EXPECT_EQ(line.text(), "typing");
  EXPECT_EQ(line.cursor(), 6u);
}

TEST(InputLine, CompletesAtTheCursor) {
  Console console;
  console.add_cvar("zz_one", "1", "");
  console.add_cvar("zz_other", "2", "");
  InputLine line;
  line.insert("zz 5");
  line.move(-2);
  line.complete(console);
  EXPECT_EQ(line.text(), "zz_o 5");
  EXPECT_EQ(line.cursor(), 4u);
  const auto before = console.scrollback().total();
  line.complete(console);
  EXPECT_EQ(console.scrollback().total() - before, 3u) << "the line and both candidates";
  EXPECT_EQ(console.scrollback().latest(1).front().text, "   zz_other \"2\"");
  line.set_text("zz_on");
  line.complete(console);
  EXPECT_EQ(line.text(), "zz_one ");
}

TEST(InputLine, HistoryIsBounded) {
  InputLine line;
  line.set_history(std::vector<std::string>(1000, "x"));
  EXPECT_EQ(line.history().size(), InputLine::kMaxHistory);
}

}  // namespace
}  // namespace fb::con
