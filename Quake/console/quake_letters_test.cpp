#include "console/quake_letters.h"

#include <gtest/gtest.h>

namespace fb::con {
namespace {

TEST(QuakeLetters, LettersOfQuakesFont) {
  EXPECT_EQ(quake_letters("\xc3\x9c"
                          "ber die Stra\xc3\x9f"
                          "e \xe2\x80\x9e"
                          "so\xe2\x80\x9c\xe2\x80\xa6"),
            "Uber die Strasse \"so\"...");
  EXPECT_EQ(quake_letters("\xc5\x81\xc3\xb3"
                          "d\xc5\xba \xc5\x93uvre \xc2\xbfqu\xc3\xa9?"),
            "Lodz oeuvre ?que?");
  EXPECT_EQ(quake_letters("\xd0\x94\xe2\x98\xba\xf0\x9f\x98\x80"), "???");
  EXPECT_EQ(quake_letters("\xc1\xc2 \xe2\x80"), "\xc1\xc2 \xe2\x80") << "a bronze A, and what is cut short";
}

TEST(TypedText, AsciiStays) {
  std::string ascii;
  for (char c = ' '; c < 0x7f; ++c) ascii += c;
  EXPECT_EQ(typed_text(ascii), ascii);
  EXPECT_EQ(typed_text("a\tb\x01\x08\x7f\nc\r\n"), "a b\nc\r\n");
}

TEST(TypedText, LettersLoseTheirAccents) {
  EXPECT_EQ(typed_text("Größe: naïve Éclair Łódź Æon cœur ÿŽſ"), "Grosse: naive Eclair Lodz AEon coeur yZs");
  EXPECT_EQ(typed_text("e\u0301t\u00e9"), "ete") << "also those that are written apart";
}

TEST(TypedText, PunctuationOfBooksIsThatOfConsoles) {
  EXPECT_EQ(typed_text("bind\u00a0x \u201csay hi\u201d \u2013 don\u2019t\u2026\ufeff"), "bind x \"say hi\" - don't...");
}

TEST(TypedText, WhatTheFontLacksIsOneQuestionMark) {
  EXPECT_EQ(typed_text("\u0416\u4e2d\U0001f600"), "???");
  EXPECT_EQ(typed_text("a\xff\xc3(\xe2\x82"), std::string("a?") + "?(?" + "?")
      << "malformed bytes, and an end that is missing";
  EXPECT_EQ(typed_text(std::string_view("a\0b", 3)), "ab");
}

}  // namespace
}  // namespace fb::con
