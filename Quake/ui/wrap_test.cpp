#include "ui/wrap.h"

#include <gmock/gmock.h>

#include <string>

namespace fb::ui {
namespace {

using testing::ElementsAre;

TEST(Wrap, CutsBetweenWords) {
  EXPECT_THAT(wrap("one two three", 8), ElementsAre("one two", "three"));
  EXPECT_THAT(wrap("one two three", 7), ElementsAre("one two", "three"));
  EXPECT_THAT(wrap("one two three", 6), ElementsAre("one", "two", "three"));
  EXPECT_THAT(wrap("one two three", 13), ElementsAre("one two three"));
}

TEST(Wrap, CutsLongWords) {
  EXPECT_THAT(wrap("abcdefgh", 3), ElementsAre("abc", "def", "gh"));
  EXPECT_THAT(wrap("a bcdefgh", 4), ElementsAre("a", "bcde", "fgh"));
  EXPECT_THAT(wrap("  abcdefgh", 5), ElementsAre("  abc", "defgh"));
  EXPECT_THAT(wrap("ab", 0), ElementsAre("a", "b"));
}

TEST(Wrap, KeepsNewlinesAndEmptyLines) {
  EXPECT_THAT(wrap("a\n\nb c", 8), ElementsAre("a", "", "b c"));
  EXPECT_THAT(wrap("", 8), ElementsAre(""));
  EXPECT_THAT(wrap("a\n", 8), ElementsAre("a", ""));
}

TEST(Wrap, LosesNothingButBlanksAtCuts) {
  const std::string text = "  The quick  brown fox jumps over the lazydogwithalongname and   away ";
  for (std::size_t columns = 1; columns < 40; ++columns) {
    std::string letters;
    for (const auto piece : wrap(text, columns)) {
      EXPECT_LE(piece.size(), columns);
      for (const char c : piece) {
        if (c != ' ') letters += c;
      }
    }
    EXPECT_EQ(letters, "Thequickbrownfoxjumpsoverthelazydogwithalongnameandaway") << columns;
  }
}

}  // namespace
}  // namespace fb::ui
