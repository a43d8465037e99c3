#include "progs/markup.h"

#include <gtest/gtest.h>

#include <string>

namespace fb::progs {
namespace {

std::string codes(std::string_view text) {
  std::string all;
  for (const Letter& letter : marked_up(text, vec4(1.0f))) all += static_cast<char>(letter.code);
  return all;
}
vec4 color(std::string_view text, const vec4& base = vec4(1.0f)) { return marked_up(text, base).back().color; }

TEST(Markup, MarksAreNoLetters) {
  EXPECT_EQ(codes("plain"), "plain");
  EXPECT_EQ(codes("^1red^7 ^xf08more"), "red more");
  EXPECT_EQ(codes("a^^b"), "a^b");
  EXPECT_EQ(codes("^h^b^s^r^dx"), "x");
  EXPECT_EQ(codes(""), "");
}

TEST(Markup, ACaretThatBeginsNoMarkIsALetter) {
  EXPECT_EQ(codes("^"), "^");
  EXPECT_EQ(codes("2^"), "2^");
  EXPECT_EQ(codes("^z"), "^z");
  EXPECT_EQ(codes("^xgg"), "^xgg");
  EXPECT_EQ(codes("^x12"), "^x12");
  EXPECT_EQ(codes("^U12"), "^U12");
  EXPECT_EQ(codes("^{12"), "^{12");
  EXPECT_EQ(codes("^{}"), "^{}");
  EXPECT_EQ(codes("^{123456789}"), "^{123456789}");
}

TEST(Markup, CharactersByTheirCodes) {
  EXPECT_EQ(codes("^Ue08d^{e012}^{41}^U0042"),
            "\x8d\x12"
            "AB");
  EXPECT_EQ(codes("^{20ac}"), "?");
}

TEST(Markup, Colors) {
  EXPECT_EQ(color("x"), vec4(1.0f));
  EXPECT_EQ(color("^2x"), vec4(0.0f, 1.0f, 0.33f, 1.0f));
  EXPECT_EQ(color("^2x", vec4(0.5f)), vec4(0.0f, 0.5f, 0.165f, 0.5f));
  EXPECT_EQ(color("^2^3x"), vec4(1.0f, 1.0f, 0.33f, 1.0f)) << "of the line's colour, not of the one before";
  EXPECT_EQ(color("^xf0fx"), vec4(1.0f, 0.0f, 1.0f, 1.0f));
  EXPECT_EQ(color("^8x").w, 0.5f);
  EXPECT_EQ(color("^hx").w, 0.5f);
  EXPECT_EQ(color("^h^hx").w, 1.0f);
  EXPECT_EQ(color("^1^dx"), vec4(1.0f));
}

TEST(Markup, TheOtherAlphabet) {
  EXPECT_EQ(codes("^mA^mA"),
            "\xc1"
            "A");
  EXPECT_EQ(codes("\002A"), "\xc1");
  EXPECT_EQ(codes("\001^dA"), "A");
}

}  // namespace
}  // namespace fb::progs
