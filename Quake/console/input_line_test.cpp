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
  line.set_text("god;r_svgf_alpha 1");
  line.home();
  for (const std::size_t place : {4u, 6u, 11u, 17u, 18u, 18u}) {
    line.move_word(1);
    EXPECT_EQ(line.cursor(), place);
  }
  line.move(-7);
  line.erase_word_at();
  EXPECT_EQ(line.text(), "god;r_svgf_1");
  line.home();
  line.erase_word_before();
  EXPECT_EQ(line.text(), "god;r_svgf_1");
}

TEST(InputLine, TypesOverWhatIsThere) {
  InputLine line;
  line.insert("map e1m1");
  line.move(-4);
  line.set_overwriting(true);
  line.type("e2m");
  EXPECT_EQ(line.text(), "map e2m1");
  line.type("345");
  EXPECT_EQ(line.text(), "map e2m345");
  line.home();
  line.paste("x");
  EXPECT_EQ(line.text(), "xmap e2m345") << "what is pasted takes no place";
}

TEST(InputLine, TheFirstLineIsPasted) {
  InputLine line;
  line.insert("map ");
  EXPECT_EQ(line.paste("\r\ne1m1\r\n\r\ngod\nnoclip\n"), 2u);
  EXPECT_EQ(line.text(), "map e1m1");
  EXPECT_EQ(line.paste(""), 0u);
  EXPECT_EQ(line.paste("\n"), 0u);
  EXPECT_EQ(line.paste(";god\n"), 0u);
  EXPECT_EQ(line.text(), "map e1m1;god");
}

TEST(InputLine, ItsEndRepeatsTheLastLine) {
  InputLine line;
  line.move_or_repeat();
  EXPECT_EQ(line.text(), "");
  line.set_history({"map e1m1", "give c 9"});
  for (int i = 0; i < 5; ++i) line.move_or_repeat();
  EXPECT_EQ(line.text(), "give ");
  line.home();
  line.move_or_repeat();
  EXPECT_EQ(line.cursor(), 1u);
  line.end();
  for (int i = 0; i < 9; ++i) line.move_or_repeat();
  EXPECT_EQ(line.text(), "give c 9");
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
  const auto before = console.scrollback().total();
  line.complete(console);
  EXPECT_EQ(line.text(), "zz_o 5");
  EXPECT_EQ(line.cursor(), 4u);
  EXPECT_EQ(console.scrollback().total() - before, 3u) << "the line and both candidates";
  EXPECT_EQ(console.scrollback().latest(1).front().text, "   zz_other \"2\"");
  line.set_text("zz_on");
  line.complete(console);
  EXPECT_EQ(line.text(), "zz_one ");
  line.set_text("zz_on 5");
  line.move(-2);
  line.complete(console);
  EXPECT_EQ(line.text(), "zz_one 5") << "one space is enough";
  EXPECT_EQ(line.cursor(), 6u);
}

TEST(InputLine, GoesThroughTheCandidates) {
  Console console;
  for (const char* name : {"zz_a", "zz_a_b", "zz_c"}) console.add_cvar(name, "0", "");
  InputLine line;
  line.insert("echo x; zz;god");
  line.move(-4);
  const auto next = [&](int step) {
    line.complete(console, step);
    return line.text();
  };
  EXPECT_EQ(next(1), "echo x; zz_;god");
  const auto total = console.scrollback().total();
  EXPECT_EQ(next(1), "echo x; zz_a;god");
  EXPECT_EQ(next(1), "echo x; zz_a_b;god");
  EXPECT_EQ(next(1), "echo x; zz_c;god");
  EXPECT_EQ(line.cursor(), 12u);
  EXPECT_EQ(next(1), "echo x; zz_a;god") << "round again";
  EXPECT_EQ(next(-1), "echo x; zz_c;god");
  EXPECT_EQ(next(-1), "echo x; zz_a_b;god");
  EXPECT_EQ(console.scrollback().total(), total) << "they are listed once";
  line.erase_before();  // zz_a_, which is a beginning of its own
  EXPECT_EQ(next(1), "echo x; zz_a_b;god");
  line.set_text("zz_a");
  EXPECT_EQ(next(1), "zz_a");
  EXPECT_EQ(next(1), "zz_a_b") << "the next one, not what is there";
  line.set_text("zz_");
  next(1);
  EXPECT_EQ(next(-1), "zz_c") << "backwards from the last";
}

TEST(InputLine, CompletesWordsWithSpacesInQuotes) {
  Console console;
  console.add_command("zz_load", "", [](const Args&) {});
  console.set_argument_completer("zz_load", [](std::string_view) {
    return std::vector<std::string>{"my save", "mysave", "quick"};
  });
  InputLine line;
  line.insert("zz_load \"my s");
  line.complete(console);
  EXPECT_EQ(line.text(), "zz_load \"my save\" ");
  line.set_text("zz_load my");
  line.complete(console);
  EXPECT_EQ(line.text(), "zz_load my");
  line.complete(console);
  EXPECT_EQ(line.text(), "zz_load \"my save\"");
  line.complete(console);
  EXPECT_EQ(line.text(), "zz_load mysave");
}

TEST(InputLine, AnAbortedLineIsShownAndNotRun) {
  Console console;
  InputLine line;
  line.insert("quit");
  line.abort();
  EXPECT_EQ(line.text(), "");
  EXPECT_TRUE(console.buffer_empty());
  EXPECT_EQ(console.scrollback().latest(1).front().text, "]quit");
  EXPECT_TRUE(line.history().empty());
}

TEST(InputLine, KnowsWhatWasEnteredInThisRun) {
  Console console;
  InputLine line;
  line.set_history({"one", "two"});
  line.set_text("two");
  line.enter(console);
  line.set_text("three");
  line.enter(console);
  EXPECT_THAT(line.history(), ElementsAre("one", "two", "three"));
  EXPECT_THAT(line.entered(), ElementsAre("two", "three"));
}

TEST(InputLine, HistoryIsBounded) {
  InputLine line;
  line.set_history(std::vector<std::string>(1000, "x"));
  EXPECT_EQ(line.history().size(), InputLine::kMaxHistory);
}

}  // namespace
}  // namespace fb::con
