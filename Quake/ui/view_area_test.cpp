// Where the game's picture is: QuakeSpasm's rectangles, and tiles around them.
#include "ui/view_area.h"

#include <gtest/gtest.h>

#include "ui/mod_bar.h"
#include "ui/test_hud.h"

namespace fb::ui {
namespace {

using scene::Area;

class ViewAreaTest : public HudTest {
 protected:
  Area area(float view_size, int width = 640, int height = 400) {
    settings.view_size = view_size;
    return view_area(view(width, height));
  }
};

class ModsBar : public ModBar {
 public:
  bool has_bar() const override { return true; }
  Drawn draw_bar(scene::DrawList&, const HudView&) override { return Drawn::kBar; }
  bool draw_level_end(scene::DrawList&, const HudView&) override { return false; }
};

TEST_F(ViewAreaTest, AnOpaqueBarTakesItsLines) {
  EXPECT_EQ(area(120), (Area{{0, 0}, {640, 400}}));
  EXPECT_EQ(area(110), (Area{{0, 0}, {640, 376}}));
  EXPECT_EQ(area(100), (Area{{0, 0}, {640, 352}}));
  settings.bar_scale = 2.0f;
  EXPECT_EQ(area(100), (Area{{0, 0}, {640, 304}}));
  settings.bar_scale = 9.0f;  // as large as fits
  EXPECT_EQ(area(110), (Area{{0, 0}, {640, 352}}));
}

TEST_F(ViewAreaTest, WhatCanBeSeenThroughOrStandsElsewhereTakesNone) {
  settings.bar_alpha = 0.75f;
  EXPECT_EQ(area(100), (Area{{0, 0}, {640, 400}}));
  settings.bar_alpha = 1.0f;
  settings.style = 1.0f;
  EXPECT_EQ(area(100), (Area{{0, 0}, {640, 400}}));
  settings.style = 0.0f;
  settings.view_size = 100.0f;
  ModsBar bar;
  HudView mods = view(640, 400);
  mods.mod_bar = &bar;
  EXPECT_EQ(view_area(mods), (Area{{0, 0}, {640, 400}}));
  hud.intermission = cl::Intermission::kLevel;
  EXPECT_EQ(area(50), (Area{{0, 0}, {640, 400}}));
}

TEST_F(ViewAreaTest, ASmallerViewIsInTheMiddleAboveTheBar) {
  EXPECT_EQ(area(70), (Area{{96, 36}, {448, 280}}));  // of 352 lines
  EXPECT_EQ(area(90), (Area{{32, 0}, {576, 352}})) << "no higher than what the bar leaves";
  EXPECT_EQ(area(0), area(30));
  EXPECT_EQ(area(30, 200, 100), (Area{{52, 11}, {96, 30}})) << "96 pixels wide at least";
  EXPECT_EQ(area(50, 60, 2).size, uvec2(60, 1)) << "in an output of any size something is left";
}

TEST_F(ViewAreaTest, TilesAreAroundIt) {
  settings.view_size = 70.0f;
  const HudView v = view(640, 400);
  const Raster r =
      drawn(v, [](scene::DrawList& list, Atlas& images, const HudView& what) { draw_border(list, images, what); });
  for (const ivec2 at :
       {ivec2(0, 0), ivec2(95, 200), ivec2(320, 35), ivec2(544, 100), ivec2(639, 351), ivec2(320, 316)})
    EXPECT_EQ(picture_at(r, at.x, at.y), "backtile") << at.x << " " << at.y;
  for (const ivec2 at : {ivec2(96, 36), ivec2(543, 315), ivec2(320, 200), ivec2(320, 352), ivec2(0, 399)})
    EXPECT_EQ(picture_at(r, at.x, at.y), "") << at.x << " " << at.y;
}

}  // namespace
}  // namespace fb::ui
