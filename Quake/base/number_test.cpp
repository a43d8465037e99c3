#include "base/number.h"

#include <gtest/gtest.h>

namespace fb {
namespace {

TEST(Number, IsTheWholeTextAndFinite) {
  EXPECT_EQ(parse_number("1.5"), 1.5);
  EXPECT_EQ(parse_number("  -2e3\t"), -2000.0);
  EXPECT_EQ(parse_number("1e300"), 1e300) << "a number; whether it is too large is its range's business";
  for (const char* wrong : {"", " ", "abc", "1x", "1 2", "inf", "-inf", "nan", "1e999", "0x", "--1"})
    EXPECT_EQ(parse_number(wrong), std::nullopt) << wrong;
  EXPECT_EQ(parse_number(std::string_view("12345").substr(1, 2)), 23.0) << "the view may end before the text does";
}

TEST(Number, WholeOnesAreDigitsAlone) {
  EXPECT_EQ(parse_whole_number("-12"), -12);
  EXPECT_EQ(parse_whole_number("010"), 10);
  EXPECT_EQ(parse_whole_number_unsigned("18446744073709551615"), 18446744073709551615u);
  for (const char* wrong : {"", "abc", "1.5", "1e3", "0x10", "9223372036854775808", "1 2", "inf"})
    EXPECT_EQ(parse_whole_number(wrong), std::nullopt) << wrong;
  EXPECT_EQ(parse_whole_number_unsigned("-1"), std::nullopt);
  EXPECT_EQ(parse_whole_number_unsigned("18446744073709551616"), std::nullopt);
}

TEST(Number, OutsideItsRangeTheSentenceNamesWhoWantsIt) {
  EXPECT_EQ(*number_in("sv_run", "1e6", 0.0, 1e9), 1e6);
  EXPECT_EQ(*number_in("sv_run", "0", 0.0, 1e9), 0.0) << "both ends are allowed";
  for (const char* wrong : {"inf", "nan", "abc", "-5", "1e300", ""})
    EXPECT_FALSE(number_in("sv_run", wrong, 0.0, 1e9)) << wrong;
  EXPECT_EQ(number_in("sv_run", "1e300", 0.0, 1e9).error().message,
            "sv_run 1e300: a number from 0 to 1000000000 is wanted");
  EXPECT_EQ(*number_of("inc", "-1e300"), -1e300);
  EXPECT_EQ(number_of("inc", "abc").error().message, "inc abc: a number is wanted");
  EXPECT_EQ(*whole_number_in<std::uint16_t>("-port", "65535", 1), 65535);
  EXPECT_EQ(whole_number_in<std::uint16_t>("-port", "65536", 1).error().message,
            "-port 65536: a whole number from 1 to 65535 is wanted");
  EXPECT_EQ(whole_number_in<int>("maxplayers", "-1", 1, 16).error().message,
            "maxplayers -1: a whole number from 1 to 16 is wanted");
}

}  // namespace
}  // namespace fb
