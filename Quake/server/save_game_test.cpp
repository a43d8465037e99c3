#include "server/save_game.h"

#include <gmock/gmock.h>

namespace fb::sv {
namespace {

using ::testing::HasSubstr;

std::string header(const std::string& version = "5", const std::string& time = "12.345678") {
  std::string text = version + "\nThe_Test______________kills:__3/_22____\n";
  for (int i = 0; i < 16; ++i) text += std::to_string(i) + ".500000\n";
  text += "2\ne1m1\n" + time + "\n";
  for (int i = 0; i < 64; ++i) text += i == 1 ? "azaz\n" : "m\n";
  return text;
}
std::string error_of(const std::string& text) {
  const auto save = parse_save(text, "s.sav");
  return save ? "" : save.error().message;
}

TEST(SaveGame, ReadsAHeader) {
  const auto save = parse_save(header() + "{\n}\n{\n}\n", "s.sav");
  ASSERT_TRUE(save.ok()) << save.error().message;
  EXPECT_EQ(save->header.spawn_parms[15], 15.5f);
  EXPECT_EQ(save->header.skill, 2);
  EXPECT_EQ(save->header.map, "e1m1");
  EXPECT_EQ(save->header.time, 12.345678);
  EXPECT_EQ(save->header.light_styles.at(1), "azaz");
  EXPECT_EQ(save->header.comment.size(), kSaveCommentLength);
  EXPECT_EQ(save->entities, "\n{\n}\n{\n}\n");
}

// The re-release's: the game's folder is on a line of its own, and what follows is as ever.
TEST(SaveGame, ReadsVersion6) {
  for (const std::string end : {"\n", "\r\n"}) {
    std::string text = header();
    text.replace(0, 2, "6" + end + "hipnotic" + end);
    const auto save = parse_save(text + "{\n}\n{\n}\n", "s.sav");
    ASSERT_TRUE(save.ok()) << save.error().message;
    EXPECT_EQ(save->header.game, "hipnotic");
    EXPECT_EQ(save->header.comment, "The_Test______________kills:__3/_22____");
    EXPECT_EQ(save->header.spawn_parms[15], 15.5f);
    EXPECT_EQ(save->header.map, "e1m1");
    EXPECT_EQ(save->entities, "\n{\n}\n{\n}\n");
    for (std::size_t length = 0; length + 2 < text.size(); ++length)
      EXPECT_NE(error_of(text.substr(0, length)), "") << length;
  }
  EXPECT_EQ(parse_save(header(), "s.sav")->header.game, "");
}

TEST(SaveGame, MayBeginWithAByteOrderMark) { EXPECT_EQ(error_of("\xef\xbb\xbf" + header()), ""); }

// Quake 1.0 has the skill as a float.
TEST(SaveGame, SkillMayBeAFloat) {
  std::string text = header();
  text.replace(text.find("\n2\ne1m1"), 3, "\n2.000000\n");
  const auto save = parse_save(text, "s.sav");
  ASSERT_TRUE(save.ok());
  EXPECT_EQ(save->header.skill, 2);
}

TEST(SaveGame, SaysWhatIsWrong) {
  EXPECT_EQ(error_of(""), "s.sav: no saved game");
  EXPECT_EQ(error_of("hello"), "s.sav: no saved game");
  EXPECT_THAT(error_of(header("7")), HasSubstr("version 7, not 5 or 6"));
  EXPECT_THAT(error_of("6\n\ncomment\n1\n"), HasSubstr("no game"));
  EXPECT_THAT(error_of(header("5", "nan")), HasSubstr("no time"));
  EXPECT_THAT(error_of(header("5", "-1")), HasSubstr("no time"));
  EXPECT_THAT(error_of(header("5", "1e999")), HasSubstr("no time"));
  EXPECT_THAT(error_of("5\nc\n1\n2\n"), HasSubstr("no spawn parms"));
  const std::string whole = header();
  for (std::size_t length = 0; length + 2 < whole.size(); ++length)
    EXPECT_NE(error_of(whole.substr(0, length)), "") << length;
}

TEST(SaveGame, Comments) {
  EXPECT_EQ(save_comment("the Slipgate Complex", 3, 22), "the_Slipgate_Complex__kills:__3/_22____");
  EXPECT_EQ(save_comment("a name of more than 22 letters", 1234, 5678), "a_name_of_more_than_22kills:1234/5678__");
  EXPECT_EQ(save_comment("two\nlines", 0, 0), "two___________________kills:__0/__0____");
  EXPECT_EQ(save_comment("", -2147483648, -2147483648).size(), kSaveCommentLength);
}

}  // namespace
}  // namespace fb::sv
