#include "ui/signs.h"

#include "ui/test_hud.h"

namespace fb::ui {
namespace {

using SignsTest = HudTest;

TEST_F(SignsTest, CrosshairInTheMiddle) {
  settings.bar_alpha = 0.75f;
  EXPECT_EQ(drawn(view(), draw_crosshair).text(atlas, 156, 96, 1), "");
  settings.crosshair = 1.0f;
  EXPECT_EQ(drawn(view(), draw_crosshair).text(atlas, 156, 96, 1), "+");
  settings.crosshair_scale = 3.0f;
  EXPECT_EQ(drawn(view(), draw_crosshair).text(atlas, 160 - 12, 100 - 12, 1, 3), "+");
  settings.bar_alpha = 1.0f;  // of the picture above the bar's 48 lines
  EXPECT_EQ(drawn(view(), draw_crosshair).text(atlas, 160 - 12, 76 - 12, 1, 3), "+");
}

TEST_F(SignsTest, PlaquesAreALittleAboveTheMiddle) {
  EXPECT_EQ(picture_at(drawn(view(), draw_pause), 160, 90), "");
  hud.paused = true;
  Raster r = drawn(view(), draw_pause);
  EXPECT_EQ(picture_at(r, 96, 84), "gfx/pause.lmp");
  EXPECT_EQ(picture_at(r, 95, 84), "");
  EXPECT_EQ(picture_at(r, 223, 107), "gfx/pause.lmp");
  settings.show_pause = 0.0f;
  EXPECT_EQ(picture_at(drawn(view(), draw_pause), 160, 90), "");
  EXPECT_EQ(picture_at(drawn(view(), draw_loading), 88, 84), "gfx/loading.lmp");
}

TEST_F(SignsTest, AtTheStartABarGoesToAndFro) {
  const auto at = [&](double seconds) {
    return drawn(view(), [&](auto& list, auto& pictures, const HudView& v) {
      draw_start(list, pictures, v, seconds, "loading");
    });
  };
  const Raster first = at(0.0), last = at(1.6), back = at(3.2);
  EXPECT_EQ(picture_at(first, 160, 90), "gfx/loading.lmp");
  EXPECT_EQ(first.text(atlas, 160 - 28, 132, 7), "loading");
  EXPECT_NE(first.at(100, 125), first.at(220, 125)) << "it is at the left";
  EXPECT_EQ(last.at(220, 125), first.at(100, 125)) << "and at the right";
  EXPECT_EQ(back.at(100, 125), first.at(100, 125));
}

TEST_F(SignsTest, Warnings) {
  HudView v = view();
  v.silence = 0.29;
  v.slow = true;
  EXPECT_EQ(picture_at(drawn(v, draw_warnings), 64, 0), "");
  EXPECT_EQ(picture_at(drawn(v, draw_warnings), 0, 0), "");
  v.silence = 0.31;
  v.settings.show_turtle = 1.0f;
  EXPECT_EQ(picture_at(drawn(v, draw_warnings), 64, 0), "net");
  EXPECT_EQ(picture_at(drawn(v, draw_warnings), 31, 31), "turtle");
  v.slow = false;
  EXPECT_EQ(picture_at(drawn(v, draw_warnings), 31, 31), "");
}

TEST_F(SignsTest, ReadingsInTheCorner) {
  hud.time = 65.9;
  settings.clock = settings.show_fps = settings.show_speed = 1.0f;
  HudView v = view();
  v.frame_rate = 71.6;
  v.speed = 320.7f;
  Raster r = drawn(v, draw_readings);
  EXPECT_EQ(r.text(atlas, 320 - 32, 192, 4), "1:05");
  EXPECT_EQ(r.text(atlas, 320 - 48, 184, 6), "72 fps");
  EXPECT_EQ(r.text(atlas, 160 - 12, 80, 3), "320");  // of the picture above the bar
  v.settings.style = 2.0f;                           // whose lower corner is taken
  r = drawn(v, draw_readings);
  EXPECT_EQ(r.text(atlas, 320 - 48, 8, 4), "1:05");
  EXPECT_EQ(r.text(atlas, 320 - 64, 16, 6), "72 fps");
}

TEST(SpeedReading, HighestOfATwentiethOfASecond) {
  SpeedReading reading;
  EXPECT_LT(reading.value(), 0.0f);
  reading.frame(1.00, 100.0f);
  reading.frame(1.02, 300.0f);
  reading.frame(1.04, 200.0f);
  EXPECT_LT(reading.value(), 0.0f);
  reading.frame(1.06, 50.0f);
  EXPECT_EQ(reading.value(), 300.0f);
  reading.frame(1.12, 60.0f);
  EXPECT_EQ(reading.value(), 60.0f);
}

TEST(SlowFrames, FromTheThirdOn) {
  SlowFrames frames;
  frames.frame(0.1);
  frames.frame(0.2);
  EXPECT_FALSE(frames.slow());
  frames.frame(0.1);
  EXPECT_TRUE(frames.slow());
  frames.frame(0.05);
  EXPECT_FALSE(frames.slow());
}

}  // namespace
}  // namespace fb::ui
