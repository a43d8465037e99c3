#include <gmock/gmock.h>

#include "progs/test_qc.h"

namespace fb::progs {
namespace {

using ::testing::HasSubstr;

class StringBuiltinsTest : public testing::QcTest {};

TEST_F(StringBuiltinsTest, NumbersAsQuakeWritesThem) {
  EXPECT_EQ(says("puts(ftos(5)); puts(ftos(-3)); puts(ftos(0.5)); puts(ftos(123.456)); puts(ftos(-0.04));"
                 "puts(ftos(16777216)); puts(ftos(100000 * 100000));"),
            "[5] [-3] [  0.5] [123.5] [ -0.0] [16777216] [10000000000.0]");
  EXPECT_EQ(says("puts(vtos('1 2.25 -3')); puts(vtos('1000 0 123456'));"),
            "['  1.0   2.2  -3.0'] ['1000.0   0.0 123456.0']");
  EXPECT_EQ(says("puts(etos(self)); puts(etos(spawn()));"), "[entity 0] [entity 2]");
}

TEST_F(StringBuiltinsTest, NumbersAreRead) {
  EXPECT_EQ(says("put(stof(\"1.5\")); put(stof(\" -2e2x\")); put(stof(\"x\")); put(stof(\"\"));"), "1.5 -200 0 0");
  EXPECT_EQ(says("putv(stov(\"'1 2 3'\")); putv(stov(\"4 -5.5   6\")); putv(stov(\"7\")); putv(stov(\"\"));"),
            "(1 2 3) (4 -5.5 6) (7 0 0) (0 0 0)");
}

TEST_F(StringBuiltinsTest, LengthAndJoining) {
  EXPECT_EQ(
      says("put(strlen(\"\")); put(strlen(\"abc\")); puts(strcat(\"a\")); puts(strcat(\"a\", \"b\", \"\", \"c\"));"),
      "0 3 [a] [abc]");
}

TEST_F(StringBuiltinsTest, Substring) {
  EXPECT_EQ(
      says("puts(substring(\"hello\", 1, 3)); puts(substring(\"hello\", 3, 99)); puts(substring(\"hello\", 5, 1));"
           "puts(substring(\"hello\", -3, 2)); puts(substring(\"hello\", 1, -1)); puts(substring(\"hello\", 1, -2));"
           "puts(substring(\"hello\", -99, 2)); puts(substring(\"hello\", 0, 0)); puts(substring(\"hello\", 9, -9));"),
      "[ell] [lo] [] [ll] [ello] [ell] [he] [] []");
}

TEST_F(StringBuiltinsTest, SearchingAndCharacters) {
  EXPECT_EQ(
      says("put(strstrofs(\"hello\", \"l\")); put(strstrofs(\"hello\", \"l\", 3)); put(strstrofs(\"hello\", \"x\"));"
           "put(strstrofs(\"hello\", \"h\", 99)); put(strstrofs(\"hello\", \"h\", -1)); put(strstrofs(\"a\", \"\"));"),
      "2 3 -1 -1 -1 0");
  EXPECT_EQ(says("put(str2chr(\"AB\", 0)); put(str2chr(\"AB\", 1)); put(str2chr(\"AB\", 2)); put(str2chr(\"AB\", -1));"
                 "put(str2chr(\"AB\", -3)); puts(chr2str(72, 105)); put(str2chr(chr2str(200), 0));"),
            "65 66 0 66 0 [Hi] 200");
}

TEST_F(StringBuiltinsTest, Comparing) {
  EXPECT_EQ(says("put(strncmp(\"abc\", \"abd\", 2)); put(strncmp(\"abc\", \"abd\", 3)); put(strncmp(\"b\", \"a\", 9));"
                 "put(strncmp(\"xabc\", \"abd\", 2, 1)); put(strncmp(\"xab\", \"yyab\", 2, 1, 2));"),
            "0 -1 1 0 0");
  EXPECT_EQ(says("put(strcasecmp(\"ABC\", \"abc\")); put(strcasecmp(\"a\", \"B\")); put(strcasecmp(\"ab\", \"a\"));"
                 "put(strncasecmp(\"ABCx\", \"abcy\", 3)); put(strncasecmp(\"ABCx\", \"abcy\", 4));"),
            "0 -1 1 0 -1");
}

TEST_F(StringBuiltinsTest, Styles) {
  EXPECT_EQ(
      says("puts(strconv(1, 0, 0, \"AbC\")); puts(strconv(2, 0, 0, \"AbC\", \"d\")); puts(strconv(0, 0, 0, \"A1\"));"),
      "[abc] [ABCD] [A1]");
  EXPECT_EQ(says("local string s; s = strconv(0, 2, 2, \"a1\"); put(str2chr(s, 0)); put(str2chr(s, 1));"
                 "s = strconv(0, 1, 1, s); puts(s); s = strconv(0, 0, 3, \"a7\"); put(str2chr(s, 1));"
                 "puts(strconv(0, 0, 1, s)); s = strconv(0, 5, 0, \"aa\"); put(str2chr(s, 0)); put(str2chr(s, 1));"),
            "225 177 [a1] 25 [a7] 97 225");
  EXPECT_EQ(says("puts(strpad(5, \"ab\")); puts(strpad(-5, \"ab\", \"c\")); puts(strpad(1, \"abc\"));"),
            "[ab   ] [  abc] [abc]");
  EXPECT_EQ(says("puts(strtolower(\"AbC\")); puts(strtoupper(\"AbC\"));"), "[abc] [ABC]");
  EXPECT_EQ(says("puts(strreplace(\"l\", \"LL\", \"hello\")); puts(strreplace(\"\", \"x\", \"hello\"));"
                 "puts(strireplace(\"H\", \"j\", \"hehe\")); puts(strreplace(\"a\", \"\", \"banana\"));"),
            "[heLLLLo] [hello] [jeje] [bnn]");
}

TEST_F(StringBuiltinsTest, InfoStrings) {
  EXPECT_EQ(says(R"(local string s; s = infoadd("", "name", "ranger"); s = infoadd(s, "team", "4"); puts(s);
                    puts(infoget(s, "team")); puts(infoget(s, "nothing")); s = infoadd(s, "name", "x", "y"); puts(s);
                    s = infoadd(s, "team", ""); puts(s); puts(infoadd(s, "bad\\key", "1")); puts(infoget("\\a", "a"));)"),
            "[\\name\\ranger\\team\\4] [4] [] [\\team\\4\\name\\xy] [\\name\\xy] [\\name\\xy] []");
}

TEST_F(StringBuiltinsTest, TemporariesOfOneExpressionDoNotOverwriteEachOther) {
  EXPECT_EQ(says("puts(strcat(ftos(1), vtos('1 2 3'), ftos(2.5), etos(self)));"),
            "[1'  1.0   2.0   3.0'  2.5entity 0]");
  EXPECT_EQ(says(R"(local string first; local float i; first = ftos(77);
                    for (i = 0; i < 1000; i++) strcat("x", ftos(i)); puts(first);)"),
            "[77]");
}

TEST_F(StringBuiltinsTest, StringsAreCutAtTheirLimit) {
  EXPECT_EQ(says(R"(local string s; local float i; s = "0123456789abcdef";
                    for (i = 0; i < 20; i++) s = strcat(s, s); put(strlen(s)); puts(substring(s, 0, 4));)"),
            "65535 [0123]");
}

TEST_F(StringBuiltinsTest, ZoneStrings) {
  EXPECT_EQ(says(R"(local string kept; local float i; kept = strzone("a", "b");
                    for (i = 0; i < 10000; i++) ftos(i); puts(kept); strunzone(kept); puts("end");)"),
            "[ab] [end]");
  EXPECT_EQ(says("strunzone(\"a constant\"); strunzone(ftos(5)); puts(\"fine\");"), "[fine]");
  EXPECT_THAT(warned("local string s; s = strzone(\"a\"); strunzone(s); puts(s);"), HasSubstr("which there is not"));
  EXPECT_EQ(output(), "[]");
  EXPECT_THAT(warned("local string s; s = strzone(\"a\"); strunzone(s); strunzone(s);"),
              HasSubstr("parameter 1 of strunzone is string"));
}

TEST_F(StringBuiltinsTest, WhatIsNoStringIsEmpty) {
  // The classic: an entity's or a float's word taken for a string.
  const std::string before = "string(float f) as_string = { local float g; g = f; return __NULL__; }; .string text;";
  ASSERT_TRUE(start(std::string(testing::kBuiltinSource) + "string s; void() main = { puts(s); };"));
  const auto s = vm_->program().global<StringId>("s");
  for (const std::int32_t bad : {1 << 30, -1000000, INT32_MIN, INT32_MAX}) {
    vm_->set(s, StringId{bad});
    EXPECT_EQ(error_of(), "") << bad;
    EXPECT_EQ(output(), "[]");
    EXPECT_THAT(vm_->warning(), HasSubstr(fmt::format("parameter 1 of puts is string {}, which there is not", bad)));
  }
}

class TokenizeTest : public testing::QcTest {};

TEST_F(TokenizeTest, Words) {
  EXPECT_EQ(
      says(R"(put(tokenize("one \"two words\" three")); puts(argv(0)); puts(argv(1)); puts(argv(2)); puts(argv(3));
                    puts(argv(-1)); puts(argv(-4)); put(argv_start_index(1)); put(argv_end_index(1));
                    put(argv_start_index(7));)"),
      "3 [one] [two words] [three] [] [three] [] 4 15 -1");
  EXPECT_EQ(
      says(R"(put(tokenize_console("  a // comment\n b")); puts(argv(1)); put(tokenize("")); put(tokenize("\"open"));
                    puts(argv(0));)"),
      "2 [b] 0 1 [open]");
}

TEST_F(TokenizeTest, Separators) {
  EXPECT_EQ(says(R"(put(tokenizebyseparator("a,b,,c d", ",")); puts(argv(0)); puts(argv(2)); puts(argv(3));
                    put(tokenizebyseparator("a--b-c", "-", "--")); puts(argv(1)); put(tokenizebyseparator("", ","));)"),
            "4 [a] [] [c d] 3 [b] 1");
}

class SprintfTest : public testing::QcTest {
 protected:
  std::string formatted(const std::string& arguments) { return says("puts(sprintf(" + arguments + "));"); }
};

TEST_F(SprintfTest, Conversions) {
  EXPECT_EQ(formatted("\"plain %% text\""), "[plain % text]");
  EXPECT_EQ(formatted("\"%d %x %X %o %u %c\", 42.9, 255, 255, 8, 7, 65"), "[42 ff FF 10 7 A]");
  EXPECT_EQ(formatted("\"%f %.2f %e %g %G\", 1.5, 1.005, 1500, 0.0001, 100000000"),
            "[1.500000 1.00 1.500000e+03 0.0001 1E+08]");
  EXPECT_EQ(formatted("\"%s|%5s|%-5s|%.2s\", \"a\", \"b\", \"c\", \"defg\""), "[a|    b|c    |de]");
  EXPECT_EQ(formatted("\"%v %.1v %V\", '1 2.5 3', '1 2 3', '1 2 0.000001'"), "[1 2.5 3 1 2 3 1 2 1E-06]");
}

TEST_F(SprintfTest, FlagsAndSizes) {
  EXPECT_EQ(formatted("\"%05d|%+d|% d|%-4d|%#x\", 42, 42, 42, 42, 255"), "[00042|+42| 42|42  |0xff]");
  EXPECT_EQ(formatted("\"%*d|%-*d|%.*f\", 5, 42, 4, 42, 1, 2.55"), "[   42|42  |2.5]");
  EXPECT_EQ(formatted("\"%2$s %1$s\", \"world\", \"hello\""), "[hello world]");
  EXPECT_EQ(formatted("\"%1$*2$d|\", 42, 5"), "[   42|]");
}

TEST_F(SprintfTest, IntegersAndFloats) {
  EXPECT_EQ(says("local entity e; e = spawn(); puts(sprintf(\"%i %ld %hd %hi\", e, e, 3.7, 4.2));"), "[2 2 3 4]");
}

TEST_F(SprintfTest, NonsenseIsLeftAsItIs) {
  EXPECT_EQ(formatted("\"a %y b\", 1"), "[a %y b]");
  EXPECT_EQ(formatted("\"a %\""), "[a %]");
  EXPECT_EQ(formatted("\"%d %s %v\""), "[0  0 0 0]");
  EXPECT_EQ(formatted("\"%9999999999d\", 1").size(), 4096u + 2);
  EXPECT_EQ(formatted("\"%.999999f\", 1").size(), 4096u + 2 + 2);
}

}  // namespace
}  // namespace fb::progs
