#include "ui/demo_bar.h"

#include "ui/test_hud.h"

namespace fb::ui {
namespace {

class DemoBarTest : public HudTest {
 protected:
  Raster drawn_bar(const DemoBar& bar, int width = 320, int height = 200) {
    return drawn(view(width, height),
                 [&](auto& list, auto& letters, const HudView& v) { draw_demo_bar(list, letters, v, bar); });
  }
  // How many pixels of the line's middle are as bright as what has been played.
  static int past(const Raster& raster, int y) {
    int count = 0;
    for (int x = 14; x < 306; ++x) count += raster.at(x, y).x > 0.7f;
    return count;
  }
};

// In the lower 320x48 of 320x200 the bar is 36 above: its text at 120, its line from 132 to 138.
TEST_F(DemoBarTest, SaysWhereTheDemoIs) {
  const Raster r = drawn_bar({"demo1.dem", 65.0, 130.0, 1.0});
  EXPECT_EQ(r.text(atlas, 124, 120, 9), "demo1.dem");
  EXPECT_EQ(r.text(atlas, 306 - 9 * 8, 120, 9), "1:05/2:10");
  EXPECT_NEAR(past(r, 135), 146, 3) << "half of the line";
  EXPECT_LT(past(drawn_bar({"x", 0.0, 130.0, 1.0}), 135), 4);
  EXPECT_LT(past(drawn_bar({"x", 0.0, 0.0, 1.0}), 135), 4) << "a demo without a length";
  EXPECT_NEAR(past(drawn_bar({"x", 1e9, 130.0, 1.0}), 135), 292, 2);
}

TEST_F(DemoBarTest, SaysHowFastItPlays) {
  const auto says = [&](double rate, int letters) {
    return drawn_bar({"x", 1.0, 2.0, rate}).text(atlas, 14, 120, letters);
  };
  EXPECT_EQ(says(1.0, 4), "> 1x");
  EXPECT_EQ(says(0.25, 6), "> 1/4x");
  EXPECT_EQ(says(32.0, 6), ">> 32x");
  EXPECT_EQ(says(-5.0, 6), "<< -5x");
  EXPECT_EQ(says(-0.5, 7), "< -1/2x");
  EXPECT_EQ(says(0.0, 6), "paused");
}

TEST_F(DemoBarTest, ItsLineCanBePointedAt) {
  const auto at = [&](float x, float y, bool held = false) {
    return demo_time_at(settings, {320, 200}, 100.0, {x, y}, held);
  };
  ASSERT_TRUE(at(160, 135));
  EXPECT_NEAR(*at(160, 135), 50.0, 0.1);
  EXPECT_NEAR(*at(14, 135), 0.0, 1e-3);
  EXPECT_NEAR(*at(306, 135), 100.0, 1e-3);
  EXPECT_FALSE(at(160, 110));
  EXPECT_FALSE(at(160, 150));
  EXPECT_FALSE(at(2, 135));
  EXPECT_NEAR(*at(160, 20, true), 50.0, 0.1) << "held, it may be anywhere";
  EXPECT_EQ(*at(-900, 20, true), 0.0);
  settings.bar_scale = 2.0f;
  EXPECT_NEAR(*demo_time_at(settings, {640, 400}, 100.0, {320, 270}, false), 50.0, 0.1);
  settings.bar_scale = 1.0f;
  EXPECT_NEAR(*demo_time_at(settings, {960, 400}, 100.0, {480, 335}, false), 50.0, 0.1) << "in the middle";
}

}  // namespace
}  // namespace fb::ui
