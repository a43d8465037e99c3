#include "ui/scoreboard.h"

#include "ui/test_hud.h"

namespace fb::ui {
namespace {

class ScoreboardTest : public HudTest {
 protected:
  ScoreboardTest() {
    hud.max_clients = 8;
    hud.game_type = 1;
    hud.scores = {{"low", -3, 0x00}, {"", 99, 0}, {"own", 7, 0x4d}, {"top", 12, 0xc1}, {"even", 7, 0}};
    hud.player = 2;
  }
  // Draws with a painter on this canvas.
  template <typename Draw>
  Raster on(const HudView& view, const Canvas& canvas, const Draw& draw) {
    return drawn(view, [&](scene::DrawList& list, Atlas& images, const HudView& shown) {
      Painter painter(list, images, canvas);
      draw(painter, shown);
    });
  }
  Raster on_bar(const HudView& view, void (*draw)(Painter&, const HudView&)) {
    return on(view, status_bar_canvas(view.output, 1.0f, true), draw);
  }
  static int index_at(const Raster& raster, int x, int y) {
    return static_cast<int>(raster.at(x, y).x * 255.0f + 0.5f);
  }
};

TEST_F(ScoreboardTest, MostFragsFirstAndEqualOnesInTheirOrder) {
  EXPECT_EQ(ranking(hud), (std::vector<std::size_t>{3, 2, 4, 0}));
  cl::Hud many;
  std::vector<std::size_t> in_order;
  for (std::size_t i = 0; i < 40; ++i) {
    many.scores.push_back({"x", 5, 0});
    in_order.push_back(i);
  }
  EXPECT_EQ(ranking(many), in_order);
  EXPECT_EQ(color_index(0), 8);
  EXPECT_EQ(color_index(13), 216);
  EXPECT_EQ(color_index(0x4d), 216);  // trousers are the lower four bits
}

TEST_F(ScoreboardTest, LeadersInTheInventory) {
  const auto brackets = [&](const Raster& raster) {  // pixels of one's own in the gap before one's colours
    int lit = 0;
    for (int y = 152; y < 160; ++y)
      for (int x = 222; x < 226; ++x) lit += raster.lit(x, y) ? 1 : 0;
    return lit;
  };
  EXPECT_GT(brackets(on_bar(view(), draw_leaders)), 0);
  hud.player = -1;
  const Raster r = on_bar(view(), draw_leaders);
  EXPECT_EQ(brackets(r), 0);
  EXPECT_EQ(index_at(r, 194, 153), 12 * 16 + 8);
  EXPECT_EQ(index_at(r, 194, 157), 1 * 16 + 8);
  EXPECT_EQ(index_at(r, 194, 160), 0);
  EXPECT_EQ(index_at(r, 221, 153), 12 * 16 + 8);
  EXPECT_EQ(index_at(r, 222, 153), 0);
  EXPECT_EQ(index_at(r, 226, 153), 4 * 16 + 8);
  EXPECT_EQ(index_at(r, 226, 158), 13 * 16 + 8);
  EXPECT_EQ(index_at(r, 290, 153), 8);
}

TEST_F(ScoreboardTest, SmallOneBesideTheBar) {
  EXPECT_TRUE(fits_small_scoreboard(view(512, 200), 1.0f));
  EXPECT_FALSE(fits_small_scoreboard(view(511, 200), 1.0f));
  EXPECT_FALSE(fits_small_scoreboard(view(1000, 200), 2.0f));
  settings.view_size = 120.0f;
  EXPECT_FALSE(fits_small_scoreboard(view(512, 200), 1.0f));
  settings.view_size = 110.0f;  // three rows about oneself
  Raster r = on_bar(view(512, 200), draw_small_scoreboard);
  EXPECT_EQ(index_at(r, 330, 175), 0);
  EXPECT_EQ(index_at(r, 325, 177), 12 * 16 + 8);
  EXPECT_EQ(r.text(atlas, 324 + 48, 176, 8), "top");
  EXPECT_EQ(r.text(atlas, 324 + 48, 184, 8), "own");
  EXPECT_EQ(r.text(atlas, 324 + 48, 192, 8), "even");
  hud.player = 0;
  r = on_bar(view(512, 200), draw_small_scoreboard);
  EXPECT_EQ(r.text(atlas, 324 + 48, 176, 8), "own");
  EXPECT_EQ(r.text(atlas, 324 + 48, 192, 8), "low");
}

TEST_F(ScoreboardTest, LevelBoard) {
  hud.stats[net::kStatMonsters] = 3;
  hud.stats[net::kStatTotalMonsters] = 12;
  hud.stats[net::kStatSecrets] = 1;
  hud.stats[net::kStatTotalSecrets] = 10;
  HudView v = view();
  v.skill = 2;
  Raster r = on_bar(v, draw_level_board);
  EXPECT_EQ(r.text(atlas, 8, 188, 11), "Kills: 3/12");
  EXPECT_EQ(r.text(atlas, 312 - 13 * 8, 188, 13), "Secrets: 1/10");
  EXPECT_EQ(r.text(atlas, 160 - 7 * 4, 188, 7), "skill 2");
  EXPECT_EQ(r.text(atlas, 160 - 11 * 4, 180, 11), "Hall (e1m1)");
}

TEST_F(ScoreboardTest, LongLevelNamesGoRound) {
  hud.level_name = "A name that is far too long for one line of it";
  HudView v = view(400, 200);
  v.now = 2.0;  // 60 pixels
  const Raster r = on_bar(v, draw_level_board);
  EXPECT_EQ(r.text(atlas, 4, 180, 10), hud.level_name.substr(8, 10));
  for (int y = 180; y < 188; ++y) EXPECT_FALSE(r.lit(320, y));  // not beyond the bar
  v.now = 8.0;
  const std::string whole = hud.level_name + " (e1m1)";
  const int start = -(240 - static_cast<int>(whole.size()) * 8 - 40);
  EXPECT_EQ(on_bar(v, draw_level_board).text(atlas, start - 32, 180, 3), "///");
}

TEST_F(ScoreboardTest, AllPlayers) {
  const HudView v = view();
  const Raster r = on(v, menu_canvas(v.output, 1.0f), draw_rankings);
  EXPECT_EQ(picture_at(r, 80, 8), "gfx/ranking.lmp");
  EXPECT_EQ(index_at(r, 81, 40), 12 * 16 + 8);
  EXPECT_EQ(index_at(r, 81, 47), 1 * 16 + 8);
  EXPECT_EQ(r.text(atlas, 144, 40, 8), "top");
  EXPECT_EQ(r.text(atlas, 144, 50, 8), "own");
  EXPECT_EQ(r.text(atlas, 144, 70, 8), "low");
  EXPECT_EQ(index_at(r, 81, 50), 4 * 16 + 8);
}

TEST_F(ScoreboardTest, LevelEnd) {
  hud.completed_time = 754.9;
  hud.stats[net::kStatMonsters] = 3;
  hud.stats[net::kStatTotalMonsters] = 120;
  const HudView v = view();
  const Raster r = on(v, menu_canvas(v.output, 1.0f), draw_level_end);
  EXPECT_EQ(picture_at(r, 64, 24), "gfx/complete.lmp");
  EXPECT_EQ(picture_at(r, 0, 56), "gfx/inter.lmp");
  EXPECT_EQ(picture_at(r, 176, 64), "num_1");  // 12:34
  EXPECT_EQ(picture_at(r, 200, 64), "num_2");
  EXPECT_EQ(picture_at(r, 224, 64), "num_colon");
  EXPECT_EQ(picture_at(r, 240, 64), "num_3");
  EXPECT_EQ(picture_at(r, 264, 64), "num_4");
  EXPECT_EQ(picture_at(r, 200, 104), "num_0");
  EXPECT_EQ(picture_at(r, 200, 144), "num_3");
  EXPECT_EQ(picture_at(r, 224, 144), "num_slash");
  EXPECT_EQ(picture_at(r, 240, 144), "num_1");
  EXPECT_EQ(picture_at(r, 288, 144), "num_0");
}

}  // namespace
}  // namespace fb::ui
