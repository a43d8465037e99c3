#include "ui/message_line.h"

#include <gtest/gtest.h>

#include "ui/test_raster.h"

namespace fb::ui {
namespace {

std::string drawn(const MessageLine& line, Atlas& atlas) {
  scene::DrawList list;
  {
    Painter painter(list, atlas, 240, 24, 1);
    line.draw(painter, 8.0f, 0.3);
  }
  Raster raster(240, 24);
  raster.draw(list);
  return raster.text(atlas, 8, 8, 28);
}

TEST(MessageLine, SaysToAllAndToTheTeam) {
  Atlas atlas;
  MessageLine line;
  EXPECT_EQ(drawn(line, atlas), "") << "closed";
  line.begin(false);
  line.input().insert("well; quit \"now\"");
  EXPECT_EQ(line.send(), "say \"well; quit 'now'\"\n") << "no command can be typed in it";
  EXPECT_FALSE(line.open());
  line.begin(true);
  EXPECT_EQ(line.input().text(), "") << "each begins empty";
  line.input().insert("go");
  EXPECT_EQ(line.send(), "say_team \"go\"\n");
  line.begin(false);
  EXPECT_EQ(line.send(), "");
}

TEST(MessageLine, ShowsTheEndOfALongText) {
  Atlas atlas;
  MessageLine line;
  line.begin(false);
  line.input().insert("hello there");
  EXPECT_EQ(drawn(line, atlas), "say: hello there");
  line.input().insert(", all of you who hear");
  EXPECT_EQ(drawn(line, atlas), "say: e, all of you who hear");
}

}  // namespace
}  // namespace fb::ui
