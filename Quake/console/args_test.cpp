#include "console/args.h"

#include <gmock/gmock.h>

#include <climits>

namespace fb::con {
namespace {

using testing::ElementsAre;

std::vector<std::string> words(std::string_view line) {
  const Args args(line);
  std::vector<std::string> list;
  for (std::size_t i = 0; i < args.size(); ++i) list.push_back(args[i]);
  return list;
}

TEST(Args, WordsAndQuotes) {
  EXPECT_THAT(words("map  start\t1"), ElementsAre("map", "start", "1"));
  EXPECT_THAT(words("bind x \"impulse 5 ; wait\""), ElementsAre("bind", "x", "impulse 5 ; wait"));
  EXPECT_THAT(words("a \"\" b"), ElementsAre("a", "", "b"));
  EXPECT_THAT(words("a \"b c"), ElementsAre("a", "b c"));
  EXPECT_THAT(words("a\"b c\""), ElementsAre("a\"b", "c\"")) << "a quote inside a word is a letter";
  EXPECT_THAT(words("\"a\"b"), ElementsAre("a", "b"));
  EXPECT_TRUE(words("  \r\t ").empty());
  EXPECT_TRUE(words("").empty());
}

TEST(Args, Comments) {
  EXPECT_THAT(words("a // b c"), ElementsAre("a"));
  EXPECT_THAT(words("a//b c"), ElementsAre("a//b", "c"));
  EXPECT_THAT(words("a \"// b\" c"), ElementsAre("a", "// b", "c"));
  EXPECT_THAT(words("a /* b */ c"), ElementsAre("a", "c"));
  EXPECT_THAT(words("a /* b"), ElementsAre("a"));
}

TEST(Args, SomeCharactersAreWords) {
  EXPECT_THAT(words("bind ' x"), ElementsAre("bind", "'", "x"));
  EXPECT_THAT(words("say don't"), ElementsAre("say", "don", "'", "t"));
  EXPECT_THAT(words("a{b}(c)"), ElementsAre("a", "{", "b", "}", "(", "c", ")"));
  EXPECT_THAT(words("connect 10.0.0.1:26000"), ElementsAre("connect", "10.0.0.1:26000"));
  EXPECT_THAT(words(":a"), ElementsAre(":", "a"));
}

TEST(Args, RestIsAsWritten) {
  EXPECT_EQ(Args("say  \"hello  there\" you ").rest(), "\"hello  there\" you");
  EXPECT_EQ(Args("say").rest(), "");
  EXPECT_EQ(Args("a b  \"c d\" e").joined(2), "c d e");
  EXPECT_EQ(Args("a")[7], "");
}

TEST(Args, Numbers) {
  const Args args("x 1.5 2abc abc 1e30 -1e30 nan");
  EXPECT_EQ(args.number(1), 1.5f);
  EXPECT_EQ(args.number(2), 2.0f);
  EXPECT_EQ(args.integer(3), 0);
  EXPECT_EQ(args.integer(4), INT_MAX);
  EXPECT_EQ(args.integer(5), INT_MIN);
  EXPECT_EQ(args.integer(6), 0);
  EXPECT_EQ(args.integer(9), 0);
}

TEST(Args, CommandsEndAtNewlinesAndSemicolons) {
  const std::string_view text = "a \"b;c\" ; d // e;f\ng";
  EXPECT_EQ(text.substr(0, command_end(text, 0)), "a \"b;c\" ");
  const std::size_t second = command_end(text, 0) + 1;
  EXPECT_EQ(text.substr(second, command_end(text, second) - second), " d // e;f");
  EXPECT_EQ(command_end("a \"b\nc\"", 0), 4u) << "a newline ends a command, also inside quotes";
  EXPECT_EQ(command_end("http://x;y", 0), 8u);
  EXPECT_EQ(command_end("/* a;b */ c;d", 0), 11u);
  EXPECT_EQ(command_end("", 0), 0u);
}

TEST(Args, NamesIgnoreCase) {
  EXPECT_TRUE(same_name("r_SPP", "R_spp"));
  EXPECT_FALSE(same_name("r_spp", "r_spp2"));
  EXPECT_TRUE(name_starts_with("Timedemo", "tIME"));
  EXPECT_TRUE(name_contains("r_EmitSky", "sky"));
  EXPECT_FALSE(NameLess()("A", "a"));
  EXPECT_TRUE(NameLess()("a", "B"));
}

}  // namespace
}  // namespace fb::con
