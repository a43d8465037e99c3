#include "console/command_buffer.h"

#include <gmock/gmock.h>

namespace fb::con {
namespace {

using testing::ElementsAre;
using Origin = CommandBuffer::Origin;

std::vector<std::string> drain(CommandBuffer& buffer) {
  std::vector<std::string> commands;
  while (auto command = buffer.next()) commands.push_back(*command);
  return commands;
}

TEST(CommandBuffer, AppendsInOrderAndJoinsLines) {
  CommandBuffer buffer;
  EXPECT_TRUE(buffer.append("one;tw"));
  EXPECT_TRUE(buffer.append("o\nthree"));
  EXPECT_THAT(drain(buffer), ElementsAre("one", "two", "three"));
  EXPECT_TRUE(buffer.empty());
}

TEST(CommandBuffer, InsertedTextComesNextAsItsOwnLine) {
  CommandBuffer buffer;
  buffer.append("a;b");
  EXPECT_EQ(buffer.next(), "a");
  EXPECT_TRUE(buffer.insert("x;y", Origin::kAlias));
  EXPECT_EQ(buffer.next(), "x");
  EXPECT_TRUE(buffer.insert("z", Origin::kAlias));
  buffer.append(";c");
  EXPECT_THAT(drain(buffer), ElementsAre("z", "y", "b", "c"));
}

TEST(CommandBuffer, NestingEndsUnlessItIsForgotten) {
  CommandBuffer buffer;
  buffer.append("a");
  int depth = 0;
  while (buffer.next() && buffer.insert("a;rest", Origin::kAlias)) ++depth;
  EXPECT_EQ(depth, CommandBuffer::kMaxDepth);
  buffer.append("kept\n");
  buffer.drop(Origin::kAlias);
  EXPECT_THAT(drain(buffer), ElementsAre("kept"));
  EXPECT_TRUE(buffer.empty());

  buffer.append("a");
  for (int i = 0; i < 10 * CommandBuffer::kMaxDepth; ++i) {
    ASSERT_TRUE(buffer.next());
    ASSERT_TRUE(buffer.insert("a", Origin::kAlias)) << i;
    buffer.forget_depth();
  }
}

TEST(CommandBuffer, WhatIsInsertedFromOutsideStartsAnew) {
  CommandBuffer buffer;
  buffer.append("a");
  while (buffer.next() && buffer.insert("a", Origin::kAlias)) {}
  EXPECT_FALSE(buffer.insert("x", Origin::kScript));
  buffer.forget_depth();
  EXPECT_TRUE(buffer.insert("x", Origin::kScript));
}

TEST(CommandBuffer, DropsAliasesAloneOrScriptsToo) {
  CommandBuffer buffer;
  buffer.append("appended\n");
  buffer.insert("script", Origin::kScript);
  buffer.insert("alias", Origin::kAlias);
  CommandBuffer copy = buffer;
  buffer.drop(Origin::kAlias);
  EXPECT_THAT(drain(buffer), ElementsAre("script", "appended"));
  copy.drop(Origin::kScript);
  EXPECT_THAT(drain(copy), ElementsAre("appended"));
}

TEST(CommandBuffer, FullIsRefused) {
  CommandBuffer buffer;
  const std::string half(CommandBuffer::kMaxBytes / 2, ' ');
  EXPECT_TRUE(buffer.append(half));
  EXPECT_TRUE(buffer.append(half));
  EXPECT_FALSE(buffer.append("x"));
  EXPECT_FALSE(buffer.insert("x", Origin::kScript));
  drain(buffer);
  EXPECT_TRUE(buffer.append("x"));
}

TEST(CommandLine, CommandsStartWithPlusAndEndAtOptions) {
  EXPECT_EQ(commands_of_arguments({}), "");
  EXPECT_EQ(commands_of_arguments({"-basedir", "x", "+map", "start", "-game", "ad", "+skill", "3", "+quit"}),
            "map start\nskill 3\nquit\n");
  EXPECT_EQ(commands_of_arguments({"loose", "words"}), "");
  EXPECT_EQ(commands_of_arguments({"+timedemo", "demo1", "+quit"}), "timedemo demo1\nquit\n");
}

TEST(CommandLine, QuotesAndNumbers) {
  EXPECT_EQ(commands_of_arguments({"+name", "Ranger Rick", "+echo", "a;b", ""}),
            "name \"Ranger Rick\"\necho \"a;b\" \"\"\n");
  EXPECT_EQ(commands_of_arguments({"+map start"}), "map start\n");
  EXPECT_EQ(commands_of_arguments({"+r_jitter", "-1", "-.5", "-window", "2"}), "r_jitter -1 -.5\n");
  EXPECT_EQ(commands_of_arguments({"+map", "lq-e1m1"}), "map lq-e1m1\n");
  EXPECT_EQ(commands_of_arguments({"+say", "a \"b\" c"}), "say a \"b\" c\n") << "the user's own quotes stay";
}

}  // namespace
}  // namespace fb::con
