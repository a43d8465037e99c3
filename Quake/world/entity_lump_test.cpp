// The entity lump: what Quake's parser forgives, what it does not, and values as numbers and colours.
#include "world/entity_lump.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fb::world {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(EntityLump, ReadsPairs) {
  const auto lump = parse_entity_lump(
      "{\n\"classname\" \"worldspawn\"\n\"message\" \"two words\"\n}\n"
      "// a comment \"{\"\n/* a block\n { } */{ classname light \"origin\" \"1 -2 3.5\" }",
      "m.bsp");
  ASSERT_TRUE(lump.ok());
  ASSERT_EQ(lump->size(), 2u);
  EXPECT_EQ((*lump)[0].text("message"), "two words");
  EXPECT_EQ((*lump)[1].classname(), "light");
  EXPECT_EQ((*lump)[1].vector("origin"), vec3(1, -2, 3.5f));
}

TEST(EntityLump, Forgives) {
  const auto lump = parse_entity_lump("{\"angle \" \"90\"\"light\"\"5\" \"light\" \"7\"}{}\0garbage", "m");
  ASSERT_TRUE(lump.ok());
  ASSERT_EQ(lump->size(), 2u);
  EXPECT_EQ((*lump)[0].number("angle", 0), 90) << "blanks after a key are dropped";
  EXPECT_EQ((*lump)[0].integer("light", 0), 7) << "the last of equal keys counts";
  EXPECT_TRUE((*lump)[1].values.empty());
  EXPECT_TRUE(parse_entity_lump("", "m")->empty());
  EXPECT_EQ(parse_entity_lump("\xef\xbb\xbf{}\r\n/* no end", "m")->size(), 1u) << "a byte order mark";
  EXPECT_TRUE(parse_entity_lump(std::string_view("{\"a\" \"b\"}\0}}}", 14), "m").ok()) << "text ends at a zero byte";
}

TEST(EntityLump, RefusesBrokenBraces) {
  for (const char* text : {"{\"a\" \"b\"", "{\"a\"", "{\"a\" }", "\"a\" \"b\"", "}", "{\"a\" \"b}", "{{}"}) {
    const auto lump = parse_entity_lump(text, "maps/x.bsp");
    ASSERT_FALSE(lump.ok()) << text;
    EXPECT_THAT(lump.error().message, HasSubstr("maps/x.bsp: entities: offset "));
  }
}

TEST(EntityLump, QuotedBracesAreText) {
  const auto lump = parse_entity_lump("{\"message\" \"}\"}", "m");
  ASSERT_TRUE(lump.ok());
  EXPECT_EQ((*lump)[0].text("message"), "}");
}

TEST(EntityLump, Colors) {
  Entity e;
  e.values = {{"unit", "0.5 1 0"}, {"bytes", "255 51 0"}, {"two", "1 2"}, {"below", "-3 1 1"}, {"word", "red"}};
  EXPECT_EQ(e.color("unit"), vec3(0.5f, 1, 0));
  EXPECT_EQ(e.color("bytes"), vec3(1, 51.0f / 255.0f, 0));
  EXPECT_EQ(e.color("two"), std::nullopt);
  EXPECT_EQ(e.color("below"), vec3(0, 1, 1));
  EXPECT_EQ(e.color("word"), std::nullopt);
  EXPECT_EQ(e.color("absent"), std::nullopt);
}

TEST(EntityLump, Numbers) {
  EXPECT_THAT(parse_numbers(" .75 +2  -3e1x 4", 9), ElementsAre(0.75f, 2.0f, -30.0f));
  EXPECT_THAT(parse_numbers("1 2 3", 2), ElementsAre(1.0f, 2.0f));
  EXPECT_THAT(parse_numbers("nan", 1), ElementsAre());
  EXPECT_THAT(parse_numbers("1e99", 1), ElementsAre());
  Entity e;
  e.values = {{"big", "1e20"}};
  EXPECT_EQ(e.integer("big", 4), 4);
}

}  // namespace
}  // namespace fb::world
