#include "ui/status_bar.h"

#include "client/session/items.h"
#include "ui/test_hud.h"

namespace fb::ui {
namespace {

class StatusBarTest : public HudTest {
 protected:
  Raster bar(int width = 320, int height = 200) { return bar(view(width, height)); }
  Raster bar(const HudView& view) { return drawn(view, draw_status_bar); }
  void give(std::uint32_t items) { hud.items |= static_cast<std::int32_t>(items); }
};

TEST_F(StatusBarTest, EverythingStandsInItsPlace) {
  give(cl::kItemShotgun | 4u | cl::kItemArmor2 | cl::kItemShells << 1u | cl::kItemKey2 | cl::kItemQuad |
       cl::kItemSigil1 << 1u);
  hud.stats[net::kStatActiveWeapon] = 4;
  hud.stats[net::kStatArmor] = 26;
  hud.stats[net::kStatHealth] = 25;
  hud.stats[net::kStatAmmo] = 11;
  hud.stats[net::kStatShells] = 7;
  hud.stats[net::kStatCells] = 1234;
  const Raster r = bar();
  const auto at = [&](int x, int y) { return picture_at(r, x, 152 + y); };
  EXPECT_EQ(picture_at(r, 100, 151), "");
  EXPECT_EQ(at(45, 10), "ibar");  // no super shotgun
  EXPECT_EQ(at(0, 8), "inv_shotgun");
  EXPECT_EQ(at(23, 23), "inv_shotgun");
  EXPECT_EQ(at(48, 8), "inv2_nailgun");
  EXPECT_EQ(at(192, 12), "ibar");
  EXPECT_EQ(at(208, 12), "sb_key2");
  EXPECT_EQ(at(287, 23), "sb_quad");
  EXPECT_EQ(at(296, 8), "sb_sigil2");
  EXPECT_EQ(at(0, 24), "sb_armor2");
  EXPECT_EQ(at(25, 30), "sbar");  // a number of two digits
  EXPECT_EQ(at(48, 30), "num_2");
  EXPECT_EQ(at(95, 47), "num_6");
  EXPECT_EQ(at(112, 30), "face_quad");
  EXPECT_EQ(at(160, 30), "anum_2");
  EXPECT_EQ(at(184, 30), "anum_5");
  EXPECT_EQ(at(224, 30), "sb_nails");
  EXPECT_EQ(at(272, 30), "num_1");
  EXPECT_EQ(at(296, 30), "num_1");
  EXPECT_EQ(at(319, 47), "num_1");
}

TEST_F(StatusBarTest, SmallCountsOfAmmunition) {
  atlas = Atlas();  // no pictures, so that letters read back
  hud.stats[net::kStatShells] = -5;
  hud.stats[net::kStatNails] = 42;
  hud.stats[net::kStatRockets] = 1000;
  const Raster r = bar();
  const auto same = [&](int x, unsigned char code) {
    for (int row = 0; row < 8; ++row)
      for (int column = 0; column < 8; ++column) {
        const Picture glyph = atlas.glyph(code);
        const auto texel =
            atlas.image()->texels[static_cast<std::size_t>((glyph.y + row) * Atlas::kWidth + glyph.x + column)];
        if ((texel >> 24u != 0) != r.lit(x + column, 152 + row)) return false;
      }
    return true;
  };
  EXPECT_TRUE(same(26, 18));                                     // 0
  EXPECT_TRUE(same(66, 22));                                     // 4
  EXPECT_TRUE(same(74, 20));                                     // 2
  EXPECT_TRUE(same(106, 27) && same(114, 27) && same(122, 27));  // 999
}

TEST_F(StatusBarTest, ViewsizeHidesItByParts) {
  settings.view_size = 100.0f;
  EXPECT_EQ(picture_at(bar(), 200, 155), "ibar");
  settings.view_size = 110.0f;
  EXPECT_EQ(picture_at(bar(), 200, 155), "");
  EXPECT_EQ(picture_at(bar(), 100, 180), "sbar");
  settings.view_size = 120.0f;
  EXPECT_EQ(picture_at(bar(), 100, 180), "");
  HudView scores = view();
  scores.show_scores = true;
  EXPECT_EQ(picture_at(bar(scores), 0, 180), "scorebar");
  hud.stats[net::kStatHealth] = 0;  // the dead see it, too
  EXPECT_EQ(picture_at(bar(), 0, 180), "scorebar");
}

TEST_F(StatusBarTest, PlaceScaleAndTiles) {
  Raster r = bar(640, 400);
  EXPECT_EQ(picture_at(r, 160 + 100, 380), "sbar");
  EXPECT_EQ(picture_at(r, 159, 380), "backtile");
  EXPECT_EQ(picture_at(r, 0, 352), "backtile");
  EXPECT_EQ(picture_at(r, 0, 351), "");
  EXPECT_EQ(picture_at(r, 480, 399), "backtile");
  settings.view_size = 110.0f;
  EXPECT_EQ(picture_at(bar(640, 400), 0, 375), "");
  settings.bar_scale = 1.5f;
  r = bar(640, 400);
  EXPECT_EQ(picture_at(r, 80, 364), "sbar");
  EXPECT_EQ(picture_at(r, 79, 364), "backtile");
  EXPECT_EQ(picture_at(r, 80, 363), "");
  hud.game_type = 1;  // deathmatch: at the left
  r = bar(640, 400);
  EXPECT_EQ(picture_at(r, 10, 364), "sbar");
  EXPECT_EQ(picture_at(r, 480, 364), "backtile");
  settings.bar_alpha = 0.5f;  // what can be seen through has no tiles
  r = bar(640, 400);
  EXPECT_EQ(picture_at(r, 480, 364), "");
  EXPECT_NEAR(r.at(5, 396).y, 0.5f * 254.0f / 255.0f, 0.003f);
  EXPECT_EQ(picture_at(r, 168, 370), "face1");  // the face itself is opaque
}

TEST_F(StatusBarTest, InvulnerabilityShows666) {
  give(cl::kItemInvulnerability);
  hud.stats[net::kStatArmor] = 200;
  const Raster r = bar();
  EXPECT_EQ(picture_at(r, 24, 180), "anum_6");
  EXPECT_EQ(picture_at(r, 0, 180), "disc");
}

TEST_F(StatusBarTest, NumbersLoseNoFirstDigit) {
  hud.stats[net::kStatHealth] = 5000;
  hud.stats[net::kStatAmmo] = -12;
  const Raster r = bar();
  EXPECT_EQ(picture_at(r, 136, 180), "num_9");
  EXPECT_EQ(picture_at(r, 248, 180), "anum_minus");
  EXPECT_EQ(picture_at(r, 296, 180), "anum_2");
}

TEST_F(StatusBarTest, HipnoticAndRogue) {
  rules = Rules::kHipnotic;
  give(cl::kItemKey1 | cl::kItemKey2 | 1u << cl::kHipnoticLaserCannon | 1u << cl::kHipnoticWetsuit);
  Raster r = bar();
  EXPECT_EQ(picture_at(r, 224, 179), "sb_key1");
  EXPECT_EQ(picture_at(r, 209, 199), "sb_key2");
  EXPECT_EQ(picture_at(r, 176, 160), "inv_laser");
  EXPECT_EQ(picture_at(r, 288, 160), "sb_wsuit");
  rules = Rules::kRogue;
  hud.items = static_cast<std::int32_t>(cl::kRogueShield);
  hud.stats[net::kStatActiveWeapon] = 12;
  r = bar();
  EXPECT_EQ(picture_at(r, 1, 153), "r_invbar1");
  EXPECT_EQ(picture_at(r, 48, 160), "r_lava");
  EXPECT_EQ(picture_at(r, 288, 160), "r_shield1");
  // Team games of rogue's have the team's colours in the face's place.
  hud.max_clients = 4;
  hud.scores = {{"a", 3, 0x4d}};
  hud.player = 0;
  HudView teams = view();
  teams.teamplay = 4;
  r = bar(teams);
  EXPECT_EQ(picture_at(r, 112, 176), "r_teambord");
  EXPECT_EQ(r.at(114, 187).x * 255.0f, 4 * 16 + 8);
  EXPECT_EQ(r.at(114, 195).x * 255.0f, 13 * 16 + 8);
  teams.teamplay = 1;
  EXPECT_EQ(picture_at(bar(teams), 120, 180), "face1");
}

TEST_F(StatusBarTest, InTheCorners) {
  settings.style = 1.0f;
  give(cl::kItemShotgun | 4u | cl::kItemShells | cl::kItemKey1 | cl::kItemQuad | cl::kItemSigil1);
  hud.item_time.fill(-100.0);
  hud.stats[net::kStatActiveWeapon] = 4;
  hud.stats[net::kStatAmmo] = 25;
  Raster r = bar(400, 225);
  EXPECT_EQ(picture_at(r, 16, 191), "face_quad");
  EXPECT_EQ(picture_at(r, 48, 191), "num_1");
  EXPECT_EQ(picture_at(r, 16, 190), "");  // no armour
  EXPECT_EQ(picture_at(r, 360, 191), "sb_shells");
  EXPECT_EQ(picture_at(r, 304, 191), "num_2");
  EXPECT_EQ(picture_at(r, 105, 224), "ibar");
  EXPECT_EQ(picture_at(r, 364, 171), "sb_key1");
  EXPECT_EQ(picture_at(r, 20, 173), "sb_quad");
  EXPECT_EQ(picture_at(r, 383, 120), "inv_shotgun");  // (225 - 148) / 2 + 56 + 24
  EXPECT_EQ(picture_at(r, 382, 120), "");
  EXPECT_EQ(picture_at(r, 377, 95), "inv2_nailgun");
  EXPECT_EQ(picture_at(r, 190, 215 - 15), "");  // the rune is not new
  settings.style = 2.0f;
  hud.item_time[28] = 98.0;
  hud.stats[net::kStatArmor] = 50;
  give(cl::kItemArmor1);
  r = bar(400, 225);
  EXPECT_EQ(picture_at(r, 105, 224), "");
  EXPECT_EQ(picture_at(r, 283, 180), "ibar");
  EXPECT_EQ(picture_at(r, 16, 167), "sb_armor1");
  EXPECT_EQ(picture_at(r, 368, 151), "sb_key1");
  EXPECT_EQ(picture_at(r, 20, 149), "sb_quad");
  EXPECT_EQ(picture_at(r, 184, 177 + 20), "sb_sigil1");
  settings.view_size = 110.0f;  // health, ammunition, keys
  r = bar(400, 225);
  EXPECT_EQ(picture_at(r, 48, 191), "num_1");
  EXPECT_EQ(picture_at(r, 383, 120), "");
  EXPECT_EQ(picture_at(r, 364, 171), "sb_key1");
  EXPECT_EQ(picture_at(r, 20, 149), "");
  HudView scores = view(400, 225);
  scores.show_scores = true;
  EXPECT_EQ(picture_at(bar(scores), 41, 210), "scorebar");
}

TEST_F(StatusBarTest, QuakeWorlds) {
  settings.style = 3.0f;
  give(cl::kItemShotgun | cl::kItemKey1 | cl::kItemSigil1 << 3u);
  Raster r = bar(640, 400);
  EXPECT_EQ(picture_at(r, 159, 390), "");  // no tiles, no background
  EXPECT_EQ(picture_at(r, 261, 380), "");
  EXPECT_EQ(picture_at(r, 160 + 112, 380), "face1");
  EXPECT_EQ(picture_at(r, 160 + 192, 360), "sb_key1");
  EXPECT_EQ(picture_at(r, 592 + 24, 352 - 45 - 112), "inv_shotgun");
  EXPECT_EQ(picture_at(r, 592 + 7, 352 - 45), "ibar");
  EXPECT_EQ(picture_at(r, 592 + 40, 352 + 8), "sb_sigil4");
  settings.view_size = 110.0f;
  r = bar(640, 400);
  EXPECT_EQ(picture_at(r, 592 + 24, 352 - 45 - 112), "");
  EXPECT_EQ(picture_at(r, 160 + 192, 360), "sb_key1");
}

TEST_F(StatusBarTest, WhatIsMissingIsLeftOut) {
  atlas = Atlas();
  give(~0u);
  for (const float style : {0.0f, 1.0f, 2.0f, 3.0f}) {
    settings.style = style;
    for (const Rules game : {Rules::kQuake, Rules::kHipnotic, Rules::kRogue}) {
      rules = game;
      hud.stats[net::kStatActiveWeapon] = 200;
      EXPECT_FALSE(picture_at(bar(), 160, 100) == "?");
    }
  }
}

}  // namespace
}  // namespace fb::ui
