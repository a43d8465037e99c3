#include "ui/hud.h"

#include "ui/test_hud.h"

namespace fb::ui {
namespace {

class WholeHudTest : public HudTest {
 protected:
  Raster shown(const HudView& view, Attention attention = Attention::kGame) {
    return drawn(view, [&](scene::DrawList& list, Atlas& images, const HudView& v) {
      lines_ = draw_hud(list, images, v, attention);
    });
  }
  bool lines_ = false;
};

TEST_F(WholeHudTest, DuringPlay) {
  settings.crosshair = 1.0f;
  hud.center_print = "You found\na secret!";
  hud.center_print_time = 98.5;
  Raster r = shown(view());
  EXPECT_TRUE(lines_);
  EXPECT_EQ(picture_at(r, 100, 180), "sbar");
  EXPECT_EQ(r.text(atlas, (320 - 72) / 2, 62, 9), "You found");  // a line higher, for the crosshair
  hud.time = 100.6;
  r = shown(view());
  EXPECT_EQ(r.text(atlas, (320 - 72) / 2, 62, 9), "");
  EXPECT_EQ(r.text(atlas, 156, 72, 1), "+");  // in the middle of the picture above the bar
  settings.center_seconds = 3.0f;
  EXPECT_EQ(shown(view()).text(atlas, (320 - 72) / 2, 62, 9), "You found");
  EXPECT_EQ(shown(view(), Attention::kElsewhere).text(atlas, (320 - 72) / 2, 62, 9), "");
  hud.paused = true;
  r = shown(view());
  EXPECT_EQ(r.text(atlas, (320 - 72) / 2, 62, 9), "");
  EXPECT_EQ(picture_at(r, 100, 90), "gfx/pause.lmp");
}

TEST_F(WholeHudTest, AtALevelsEnd) {
  hud.intermission = cl::Intermission::kLevel;
  hud.center_print = "late";
  hud.center_print_time = 100.0;
  Raster r = shown(view());
  EXPECT_FALSE(lines_);
  EXPECT_EQ(picture_at(r, 64, 24), "gfx/complete.lmp");
  EXPECT_EQ(picture_at(r, 100, 190), "gfx/inter.lmp");  // and no status bar
  r = shown(view(), Attention::kElsewhere);
  EXPECT_EQ(picture_at(r, 64, 24), "");
  EXPECT_EQ(picture_at(r, 100, 190), "");
  hud.game_type = 1;
  hud.scores = {{"a", 1, 0}};
  EXPECT_EQ(picture_at(shown(view()), 100, 10), "gfx/ranking.lmp");
}

TEST_F(WholeHudTest, FinalesAreTyped) {
  hud.intermission = cl::Intermission::kFinale;
  hud.center_print = "abcdefghijkl";
  hud.center_print_time = 99.5;
  Raster r = shown(view());
  EXPECT_EQ(picture_at(r, 16, 16), "gfx/finale.lmp");
  EXPECT_EQ(r.text(atlas, 160 - 48, 70, 12), "abcde");  // half a second at eight letters, and the first at once
  settings.print_speed = 16.0f;
  EXPECT_EQ(shown(view()).text(atlas, 160 - 48, 70, 12), "abcdefghi");
  hud.intermission = cl::Intermission::kCutscene;
  r = shown(view());
  EXPECT_EQ(picture_at(r, 16, 16), "");
  EXPECT_EQ(r.text(atlas, 160 - 48, 70, 12), "abcdefghi");
  EXPECT_EQ(picture_at(r, 100, 180), "");
}

TEST(HudSettings, AreReadAndScalesFollowThePicture) {
  con::Console console;
  console.add_cvar({"viewsize", "100", "", con::kCvarArchive, 30.0f, 120.0f});
  register_hud_cvars(console);
  console.execute("scr_sbarscale 3; hudstyle 2; sizeup; scr_conwidth 640");
  HudSettings s = read_hud_settings(console, 1920, 1080);
  EXPECT_EQ(s.bar_scale, 3.0f);
  EXPECT_EQ(s.menu_scale, 3.0f);
  EXPECT_EQ(s.crosshair_scale, 3.0f);
  EXPECT_EQ(s.style, 2.0f);
  EXPECT_EQ(s.view_size, 110.0f);
  EXPECT_EQ(s.console_width, 640.0f);
  EXPECT_EQ(read_hud_settings(console, 1280, 720).menu_scale, 2.0f);
  console.execute("scr_autoscale 0; sizeup; sizeup; sizeup; sizedown");
  s = read_hud_settings(console, 1920, 1080);
  EXPECT_EQ(s.menu_scale, 1.0f);
  EXPECT_EQ(s.view_size, 110.0f);
  console.execute("scr_hudstyle 9");
  EXPECT_EQ(read_hud_settings(console, 640, 480).style, 3.0f);
}

}  // namespace
}  // namespace fb::ui
