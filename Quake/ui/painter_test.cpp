#include "ui/painter.h"

#include <gtest/gtest.h>

#include "ui/test_raster.h"

namespace fb::ui {
namespace {

TEST(Painter, ScaleFollowsTheOutput) {
  EXPECT_EQ(automatic_scale(320, 180), 1);
  EXPECT_EQ(automatic_scale(1280, 720), 2);
  EXPECT_EQ(automatic_scale(1920, 1080), 3);
  EXPECT_EQ(automatic_scale(3840, 2160), 6);
  EXPECT_EQ(automatic_scale(3840, 400), 1);
}

TEST(Painter, FillsExactlyItsRectangle) {
  Atlas atlas;
  scene::DrawList list;
  { Painter(list, atlas, 20, 10, 2).fill(1, 2, 3, 1, vec4(1, 0.5f, 0, 0.5f)); }
  Raster raster(20, 10);
  raster.draw(list);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) EXPECT_EQ(raster.lit(x, y), x >= 2 && x < 8 && y >= 4 && y < 6) << x << ' ' << y;
  }
  EXPECT_EQ(raster.at(2, 4), vec3(0.5f, 0.25f, 0.0f));
}

TEST(Painter, TextReadsBackAtEveryScale) {
  for (int scale = 1; scale <= 3; ++scale) {
    Atlas atlas;
    scene::DrawList list;
    const std::string line = "Hello, \"World\" 0123! {~}";
    { Painter(list, atlas, 256 * scale, 24 * scale, scale).text(8, 8, line); }
    Raster raster(256 * scale, 24 * scale);
    raster.draw(list);
    EXPECT_EQ(raster.text(atlas, 8 * scale, 8 * scale, 30, scale), line);
    EXPECT_EQ(raster.text(atlas, 0, 0, 30, scale), "");
  }
}

TEST(Painter, AllCharactersOfTheFallbackFontReadBack) {
  Atlas atlas;
  scene::DrawList list;
  std::string all;
  for (char c = '!'; c < 127; ++c) all += c;
  { Painter(list, atlas, 800, 8, 1).text(0, 0, all); }
  Raster raster(800, 8);
  raster.draw(list);
  EXPECT_EQ(raster.text(atlas, 0, 0, 94), all);
}

TEST(Painter, GoldAndColours) {
  Atlas atlas;
  scene::DrawList list;
  {
    Painter painter(list, atlas, 64, 8, 1);
    painter.text(0, 0, "T");
    painter.text(8, 0, "T", true);
    painter.text(16, 0, "T", false, vec4(1, 0, 0, 1));
    painter.text(24, 0, "\xd4");  // T + 128
  }
  Raster raster(64, 8);
  raster.draw(list);
  EXPECT_EQ(raster.text(atlas, 0, 0, 4), "TTTT");
  EXPECT_NE(raster.at(3, 2), raster.at(11, 2));
  EXPECT_EQ(raster.at(11, 2), raster.at(27, 2));
  EXPECT_GT(raster.at(19, 2).x, 0.5f);
  EXPECT_EQ(raster.at(19, 2).y, 0.0f);
}

TEST(Painter, CanvasPlacesAndClipCuts) {
  Atlas atlas;
  scene::DrawList list;
  {
    Painter painter(list, atlas, Canvas{{10.0f, 4.0f}, 2.0f, 50, 10});
    EXPECT_EQ(painter.width(), 50);
    painter.text(0, 0, "AB");
    painter.clip({20, 0}, {28, 8.5f});
    painter.text(16, 0, "CCC");  // the second half of one, the first of the next
    painter.fill(0, 8, 100, 1, vec4(1));
    painter.clip_nothing();
    painter.fill(40, 8, 1, 1, vec4(1));
  }
  Raster raster(120, 24), whole(120, 24);
  raster.draw(list);
  EXPECT_EQ(raster.text(atlas, 10, 4, 2, 2), "AB");
  scene::DrawList unclipped;
  { Painter(unclipped, atlas, Canvas{{10.0f, 4.0f}, 2.0f, 50, 10}).text(16, 0, "CCC"); }
  whole.draw(unclipped);
  int lit = 0;
  for (int y = 4; y < 20; ++y) {
    for (int x = 42; x < 90; ++x) {
      const bool inside = x >= 50 && x < 66;
      EXPECT_EQ(raster.lit(x, y), inside && whole.lit(x, y)) << x << ' ' << y;
      lit += raster.lit(x, y) ? 1 : 0;
    }
  }
  EXPECT_GT(lit, 20);
  EXPECT_FALSE(raster.lit(49, 20));
  EXPECT_TRUE(raster.lit(50, 20) && raster.lit(65, 20));
  EXPECT_FALSE(raster.lit(50, 21));
  EXPECT_FALSE(raster.lit(66, 20));
  EXPECT_TRUE(raster.lit(90, 20));
}

TEST(Painter, PicturesStretch) {
  Bytes palette(768, 0);
  palette[3] = 255;      // 1: red
  palette[6 + 1] = 255;  // 2: green
  const Bytes image = {2, 0, 0, 0, 1, 0, 0, 0, 1, 2};
  Atlas atlas([&](std::string_view name) -> std::optional<Bytes> {
    if (name == "gfx/palette.lmp") return palette;
    if (name == "gfx/two.lmp") return image;
    return std::nullopt;
  });
  scene::DrawList list;
  {
    Painter painter(list, atlas, 16, 8, 2);
    ASSERT_NE(atlas.picture("gfx/two.lmp"), nullptr);
    painter.picture(1, 0, 4, 2, *atlas.picture("gfx/two.lmp"));
    painter.picture(0, 3, *atlas.picture("gfx/two.lmp"));
  }
  Raster raster(16, 8);
  raster.draw(list);
  EXPECT_FALSE(raster.lit(1, 0));
  EXPECT_EQ(raster.at(2, 0), vec3(1, 0, 0));
  EXPECT_EQ(raster.at(5, 3), vec3(1, 0, 0));
  EXPECT_EQ(raster.at(6, 3), vec3(0, 1, 0));
  EXPECT_EQ(raster.at(9, 0), vec3(0, 1, 0));
  EXPECT_FALSE(raster.lit(10, 0));
  EXPECT_EQ(raster.at(1, 6), vec3(1, 0, 0));
  EXPECT_EQ(raster.at(2, 7), vec3(0, 1, 0));
}

}  // namespace
}  // namespace fb::ui
