#include "ui/overlays.h"

#include <gtest/gtest.h>

#include <functional>

#include "ui/test_raster.h"

namespace fb::ui {
namespace {

constexpr int kWidth = 320, kHeight = 200;

class OverlaysTest : public testing::Test {
 protected:
  Raster drawn(const std::function<void(Painter&)>& draw) {
    scene::DrawList list;
    {
      Painter painter(list, atlas, kWidth, kHeight, 1);
      draw(painter);
    }
    Raster raster(kWidth, kHeight);
    raster.draw(list);
    return raster;
  }
  Atlas atlas;
};

TEST_F(OverlaysTest, NotifyLinesFromTheTop) {
  const Raster raster = drawn([](Painter& painter) {
    draw_notify(painter, {{"You got the shells", LogLevel::kInfo, 0.0}, {"a\nb", LogLevel::kInfo, 0.0}});
  });
  EXPECT_EQ(raster.text(atlas, 8, 0, 30), "You got the shells");
  EXPECT_EQ(raster.text(atlas, 8, 8, 30), "a");
  EXPECT_EQ(raster.text(atlas, 8, 16, 30), "b");
}

TEST_F(OverlaysTest, FpsEndsWhereItIsTold) {
  Raster raster = drawn([](Painter& painter) { draw_fps(painter, kWidth - 8, kHeight - 16, 71.6); });
  EXPECT_EQ(raster.text(atlas, kWidth - 7 * 8, kHeight - 16, 6), "72 fps");
  raster = drawn([](Painter& painter) { draw_fps(painter, kWidth - 8, kHeight - 16, 3.14159); });
  EXPECT_EQ(raster.text(atlas, kWidth - 8 * 8, kHeight - 16, 7), "3.1 fps");
  scene::DrawList list;
  {
    Painter painter(list, atlas, kWidth, kHeight, 1);
    draw_fps(painter, kWidth, 0, 0.0);
  }
  EXPECT_TRUE(list.quads.empty());
}

TEST_F(OverlaysTest, CenterPrintIsCentredLineByLine) {
  const Raster raster = drawn([](Painter& painter) { draw_center_print(painter, "You found\na secret!!!\n"); });
  EXPECT_EQ(raster.text(atlas, (kWidth - 9 * 8) / 2, 70, 9), "You found");
  EXPECT_EQ(raster.text(atlas, (kWidth - 11 * 8) / 2, 78, 11), "a secret!!!");
}

TEST_F(OverlaysTest, LongTextsStartHigherAndAreTyped) {
  const std::string text = "1\n22\n3\n4\n5\n6";
  Raster raster = drawn([&](Painter& painter) { draw_center_print(painter, text); });
  EXPECT_EQ(raster.text(atlas, (kWidth - 8) / 2, 48, 1), "1");
  EXPECT_EQ(raster.text(atlas, (kWidth - 8) / 2, 48 + 5 * 8, 1), "6");
  raster = drawn([&](Painter& painter) { draw_center_print(painter, text, 2); });
  EXPECT_EQ(raster.text(atlas, (kWidth - 16) / 2, 56, 2), "2");
  EXPECT_EQ(raster.text(atlas, (kWidth - 8) / 2, 64, 1), "");
}

TEST_F(OverlaysTest, FrameRateOverHalfASecond) {
  FrameRate rate;
  EXPECT_EQ(rate.value(), 0.0);
  for (int i = 0; i <= 60; ++i) rate.frame(10.0 + i / 50.0);
  EXPECT_NEAR(rate.value(), 50.0, 1e-6);
  rate.frame(0.0);  // the clock started anew
  for (int i = 1; i <= 30; ++i) rate.frame(i / 10.0);
  EXPECT_NEAR(rate.value(), 10.0, 1e-6);
}

}  // namespace
}  // namespace fb::ui
