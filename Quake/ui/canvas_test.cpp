#include "ui/canvas.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fb::ui {
namespace {

TEST(Canvas, StatusBarStandsAtTheBottom) {
  const Canvas middle = status_bar_canvas({1280, 720}, 2.0f, false);
  EXPECT_EQ(middle.origin, vec2(320, 720 - 96));
  EXPECT_EQ(middle.scale, 2.0f);
  EXPECT_EQ(status_bar_canvas({1280, 720}, 2.0f, true).origin, vec2(0, 720 - 96));
  // As wide as the output at most, and never smaller than its own pixels.
  EXPECT_EQ(status_bar_canvas({1280, 720}, 100.0f, false).scale, 4.0f);
  EXPECT_EQ(status_bar_canvas({1280, 720}, 100.0f, false).origin, vec2(0, 720 - 192));
  EXPECT_EQ(status_bar_canvas({1280, 720}, 0.0f, false).scale, 1.0f);
  EXPECT_EQ(status_bar_canvas({200, 100}, 3.0f, false).scale, 1.0f);
  EXPECT_EQ(status_bar_canvas({1280, 720}, std::nanf(""), false).scale, 1.0f);
}

TEST(Canvas, MenuIsInTheMiddle) {
  const Canvas menu = menu_canvas({1280, 720}, 3.0f);
  EXPECT_EQ(menu.origin, vec2(160, 60));
  EXPECT_EQ(menu.scale, 3.0f);
  EXPECT_EQ(menu.width, 320);
  EXPECT_EQ(menu.height, 200);
  EXPECT_FLOAT_EQ(menu_canvas({1280, 720}, 100.0f).scale, 3.6f);
  EXPECT_EQ(menu_canvas({320, 180}, 1.0f).origin, vec2(0, -10));
}

TEST(Canvas, CornersAndCrosshair) {
  const Canvas low = corner_canvas({1280, 720}, 2.0f, true, true);
  EXPECT_EQ(low.origin + 2.0f * vec2(320, 200), vec2(1280, 720));
  EXPECT_EQ(corner_canvas({1280, 720}, 2.0f, true, false).origin, vec2(640, 0));
  EXPECT_EQ(crosshair_canvas({{0, 0}, {641, 481}}, 1.0f).origin, vec2(320, 240));
  EXPECT_EQ(crosshair_canvas({{10, 20}, {640, 480}}, 99.0f).scale, 10.0f);
}

TEST(Canvas, ConsoleByScaleOrWidth) {
  EXPECT_EQ(console_scale({1280, 720}, 1.0f, 0.0f), 1.0f);
  EXPECT_EQ(console_scale({1280, 720}, 2.0f, 0.0f), 2.0f);
  EXPECT_EQ(console_scale({1280, 720}, 2.0f, 320.0f), 4.0f);
  EXPECT_EQ(console_scale({1280, 720}, 50.0f, 0.0f), 4.0f);  // 320 pixels are the least
  EXPECT_EQ(console_scale({1280, 720}, 0.5f, 0.0f), 1.0f);   // and the output's own the most
  EXPECT_EQ(console_scale({160, 90}, 3.0f, 0.0f), 1.0f);
}

}  // namespace
}  // namespace fb::ui
