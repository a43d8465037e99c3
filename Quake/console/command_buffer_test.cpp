#include "console/command_buffer.h"

#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

namespace fb::con {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Inserted = CommandBuffer::Inserted;
using Origin = CommandBuffer::Origin;

CommandBuffer::Source alias(std::string name) { return {Origin::kAlias, std::move(name)}; }
CommandBuffer::Source script(std::string name) { return {Origin::kFile, std::move(name)}; }

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
  EXPECT_EQ(buffer.insert("x;y", alias("first")), Inserted::kYes);
  EXPECT_EQ(buffer.next(), "x");
  EXPECT_EQ(buffer.insert("z", alias("second")), Inserted::kYes);
  buffer.append(";c");
  EXPECT_THAT(drain(buffer), ElementsAre("z", "y", "b", "c"));
}

TEST(CommandBuffer, ItsRestIsATextThatMeansTheSame) {
  CommandBuffer buffer;
  buffer.append("a;b");
  EXPECT_EQ(buffer.next(), "a");
  buffer.insert("x;y \"1;2\";z", alias("first"));
  EXPECT_EQ(buffer.next(), "x");
  buffer.append(";c");
  CommandBuffer other;
  other.append(buffer.rest());
  EXPECT_THAT(drain(other), ElementsAre("y \"1;2\"", "z", "b", "c"));
  EXPECT_THAT(drain(buffer), ElementsAre("y \"1;2\"", "z", "b", "c")) << "nothing was taken out";
  EXPECT_EQ(buffer.rest(), "");
}

TEST(CommandBuffer, NestingEndsUnlessItIsForgotten) {
  CommandBuffer buffer;
  buffer.append("a\nkept\n");
  int depth = 0;
  while (buffer.next() && buffer.insert("a;rest", alias("a")) == Inserted::kYes) ++depth;
  EXPECT_EQ(depth, CommandBuffer::kMaxDepth);
  EXPECT_EQ(buffer.insert("x", script("x.cfg")), Inserted::kTooDeep);
  const auto dropped = buffer.drop_what_calls_itself();
  ASSERT_TRUE(dropped);
  EXPECT_EQ(dropped->name, "a");
  EXPECT_THAT(drain(buffer), ElementsAre("kept"));
  EXPECT_TRUE(buffer.empty());

  buffer.append("a");
  for (int i = 0; i < 10 * CommandBuffer::kMaxDepth; ++i) {
    ASSERT_TRUE(buffer.next());
    ASSERT_EQ(buffer.insert("a", alias("a")), Inserted::kYes) << i;
    buffer.forget_nesting();
  }
}

TEST(CommandBuffer, WhatIsInsertedFromOutsideStartsAnew) {
  CommandBuffer buffer;
  buffer.append("a");
  while (buffer.next() && buffer.insert("a", alias("a")) == Inserted::kYes) {}
  EXPECT_EQ(buffer.insert("x", script("x.cfg")), Inserted::kTooDeep);
  buffer.forget_nesting();
  EXPECT_EQ(buffer.insert("x", script("x.cfg")), Inserted::kYes);
}

TEST(CommandBuffer, ACommandKnowsTheTextsThatItStandsIn) {
  CommandBuffer buffer;
  buffer.append("1;last");
  ASSERT_TRUE(buffer.next());
  EXPECT_THAT(buffer.names_from(Origin::kFile, "a.cfg"), IsEmpty());
  buffer.insert("2;after", script("a.cfg"));
  ASSERT_TRUE(buffer.next());
  buffer.insert("3", alias("go"));
  EXPECT_EQ(buffer.next(), "3");  // the alias's last command: nothing of it waits any more
  EXPECT_EQ(buffer.origin(), Origin::kAlias);
  EXPECT_THAT(buffer.names_from(Origin::kFile, "A.CFG"), ElementsAre("a.cfg", "go"));
  EXPECT_THAT(buffer.names_from(Origin::kAlias, "go"), ElementsAre("go"));
  EXPECT_THAT(buffer.names_from(Origin::kAlias, "a.cfg"), IsEmpty());
  EXPECT_EQ(buffer.next(), "after");
  EXPECT_THAT(buffer.names_from(Origin::kFile, "a.cfg"), ElementsAre("a.cfg"));
  buffer.forget_nesting();
  EXPECT_THAT(buffer.names_from(Origin::kFile, "a.cfg"), IsEmpty()) << "a script that waits may run itself";
}

// config.cfg runs an alias that runs itself: the commands around it are kept.
TEST(CommandBuffer, OnlyWhatCallsItselfIsDropped) {
  CommandBuffer buffer;
  buffer.append("1;appended\n");
  ASSERT_TRUE(buffer.next());
  buffer.insert("2;quake.rc's rest", script("quake.rc"));
  ASSERT_TRUE(buffer.next());
  buffer.insert("3;config's rest", script("config.cfg"));
  while (buffer.next() && buffer.insert("4;never", alias("loop")) == Inserted::kYes) {}
  EXPECT_EQ(buffer.drop_what_calls_itself()->name, "loop");
  EXPECT_THAT(drain(buffer), ElementsAre("config's rest", "quake.rc's rest", "appended"));
}

TEST(CommandBuffer, WhatNestsWithoutCallingItselfStays) {
  CommandBuffer buffer;
  buffer.append("a;rest");
  for (int i = 0; i < CommandBuffer::kMaxDepth; ++i) {
    ASSERT_TRUE(buffer.next());
    ASSERT_EQ(buffer.insert("a;b", alias(std::to_string(i))), Inserted::kYes);
  }
  ASSERT_TRUE(buffer.next());
  EXPECT_EQ(buffer.insert("x", alias("one more")), Inserted::kTooDeep);
  EXPECT_FALSE(buffer.drop_what_calls_itself());
  EXPECT_EQ(buffer.next(), "b");
}

TEST(CommandBuffer, OfWhatMultipliesTheOutermostAliasIsDropped) {
  CommandBuffer buffer;
  const auto nest = [&buffer](const std::vector<CommandBuffer::Source>& sources) {
    buffer.clear();
    buffer.append("x;appended\n");
    for (const CommandBuffer::Source& source : sources) {
      buffer.next();
      buffer.insert("x;" + source.name + "'s rest", source);
    }
    buffer.next();
    return buffer.drop_what_multiplies();
  };
  EXPECT_EQ(nest({script("quake.rc"), script("b.cfg"), alias("m2"), alias("m1")})->name, "m2");
  EXPECT_THAT(drain(buffer), ElementsAre("b.cfg's rest", "quake.rc's rest", "appended"));
  EXPECT_EQ(nest({script("quake.rc"), script("b.cfg"), script("c.cfg")})->name, "b.cfg");
  EXPECT_THAT(drain(buffer), ElementsAre("quake.rc's rest", "appended"));
  EXPECT_FALSE(nest({script("long.cfg")})) << "a script is as long as its file";
  EXPECT_FALSE(nest({}));
}

TEST(CommandBuffer, FullIsRefused) {
  CommandBuffer buffer;
  const std::string half(CommandBuffer::kMaxBytes / 2, ' ');
  EXPECT_TRUE(buffer.append(half));
  EXPECT_TRUE(buffer.append(half));
  EXPECT_FALSE(buffer.append("x"));
  EXPECT_EQ(buffer.insert("x", script("x.cfg")), Inserted::kBufferIsFull);
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
