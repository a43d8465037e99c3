#include "csqc/mod_hud.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "client/session/items.h"
#include "csqc/test_bar.h"

namespace fb::csqc {
namespace {

using ::testing::HasSubstr;

std::string test_mod() {
  std::stringstream text;
  text << std::ifstream("Quake/csqc/testmod/bar.qc").rdbuf();
  return text.str();
}

class ModHudTest : public BarTest {
 protected:
  // The letters of a row from here on; blanks are not drawn.
  std::string text_at(const scene::DrawList& list, float x, float y) const {
    std::string text;
    for (const scene::DrawQuad& quad : list.quads) {
      if (quad.min.y != y || quad.min.x < x || quad.uv_min == quad.uv_max) continue;
      for (int code = 0; code < 256; ++code) {
        const ui::Picture glyph = atlas.glyph(static_cast<unsigned char>(code));
        if (vec2(glyph.x, glyph.y) == quad.uv_min) text += static_cast<char>(code);
      }
    }
    return text;
  }
  static const scene::DrawQuad* fill_at(const scene::DrawList& list, const vec2& min) {
    for (const scene::DrawQuad& quad : list.quads)
      if (quad.min == min && quad.uv_min == quad.uv_max) return &quad;
    return nullptr;
  }
};

TEST_F(ModHudTest, TheTestModsBarIsDrawnInThePlaceOfTheGames) {
  put_program(test_mod());
  hud.stats[net::kStatHealth] = 75;
  hud.stats[net::kStatArmor] = 50;
  hud.stats[net::kStatAmmo] = 42;
  hud.stats[net::kStatMonsters] = 3;
  hud.stats[net::kStatTotalMonsters] = 12;
  hud.items = static_cast<std::int32_t>(cl::kItemKey2);
  const scene::DrawList list = frame();
  EXPECT_FALSE(shows_games_bar(list));
  // Health: 75 of 100 pixels red, over black of half the opacity.
  const scene::DrawQuad* under = fill_at(list, {8, 168});
  ASSERT_NE(under, nullptr);
  EXPECT_EQ(under->max, vec2(108, 178));
  EXPECT_EQ(under->color, vec4(0.0f, 0.0f, 0.0f, 0.5f));
  const ui::Raster picture = raster(list);
  EXPECT_EQ(picture.at(82, 177), vec3(0.8f, 0.1f, 0.1f));
  EXPECT_EQ(picture.at(83, 177), vec3(0.0f));
  EXPECT_EQ(text_at(list, 10, 169), "75");
  EXPECT_EQ(text_at(list, 10, 183), "50of200");
  EXPECT_EQ(picture_at(picture, 112, 168), "sb_armor1");
  EXPECT_EQ(text_at(list, 280, 168), "42");
  EXPECT_EQ(text_at(list, 280, 182), "3/12");
  // The second key alone, and the right half of a picture of which there is none (told once).
  EXPECT_EQ(picture_at(picture, 150, 180), "");
  EXPECT_EQ(picture_at(picture, 162, 180), "sb_key2");
  // "e1m1" and what the clip area leaves.
  EXPECT_EQ(text_at(list, 8, 8), "e1m1");
}

TEST_F(ModHudTest, PartsOfPicturesAndClips) {
  put_program(R"(void(vector size, float scores) CSQC_DrawHud = {
    drawsubpic('0 0 0', '24 48 0', "gfx/sb_armor1", '0.5 0.25 0', '0.5 0.5 0', '1 1 1', 1, 0);
    drawsetcliparea(100, 100, 10, 10);
    drawpic('96 96 0', "gfx/sb_armor1", '24 24 0', '0.5 1 1', 0.25, 0);
    drawresetcliparea();
    drawpic('200 0 0', "gfx/sb_armor1", '24 24 0', '1 1 1', 1, 0);
  };)");
  const scene::DrawList list = frame();
  ASSERT_EQ(list.quads.size(), 3u);
  const ui::Picture picture = *atlas.picture("sb_armor1");
  const vec2 corner(picture.x, picture.y);
  EXPECT_EQ(list.quads[0].max, vec2(24, 48));
  EXPECT_EQ(list.quads[0].uv_min, corner + vec2(12, 6));
  EXPECT_EQ(list.quads[0].uv_max, corner + vec2(24, 18));
  EXPECT_EQ(list.quads[1].min, vec2(100, 100));
  EXPECT_EQ(list.quads[1].max, vec2(110, 110));
  EXPECT_EQ(list.quads[1].uv_min, corner + vec2(4, 4));
  EXPECT_EQ(list.quads[1].color, vec4(0.5f, 1.0f, 1.0f, 0.25f));
  EXPECT_EQ(list.quads[2].min, vec2(200, 0));
}

TEST_F(ModHudTest, VirtualPixelsHaveTheStatusBarsScale) {
  put_program(
      "vector seen; void(vector size, float scores) CSQC_DrawHud = { drawfill(size - '10 10 0', '10 10 0', '1 0 0', 1, "
      "0); };");
  settings.bar_scale = 2.0f;
  const scene::DrawList list = frame(800, 600);
  ASSERT_FALSE(list.quads.empty());
  EXPECT_EQ(list.quads.back().min, vec2(780, 580));
  EXPECT_EQ(list.quads.back().max, vec2(800, 600));
  settings.bar_scale = 100.0f;  // at most what makes 320 pixels of the width
  EXPECT_EQ(frame(640, 480).quads.back().min, vec2(620, 460));
}

TEST_F(ModHudTest, GlobalsSayWhereTheGameIs) {
  put_program(
      R"(float cltime, clframetime, maxclients, player_localnum, player_localentnum, intermission, intermission_time;
    vector view_angles;
    void(vector size, float scores) CSQC_DrawHud = {
      drawstring('0 0 0', sprintf("%g,%g,%g,%g,%g,%g,%g", time, cltime, clframetime, maxclients, player_localnum,
        player_localentnum, intermission), '8 8 0', '1 1 1', 1, 0);
      drawstring('0 8 0', sprintf("%v,%g,%g,%s,%s", view_angles, deathmatch, total_monsters, world.message, mapname),
        '8 8 0', '1 1 1', 1, 0);
    };)");
  hud.max_clients = 8;
  hud.player = 2;
  hud.game_type = 1;
  hud.stats[net::kStatTotalMonsters] = 5;
  moment.view_angles = vec3(1, 2, 3);
  EXPECT_EQ(text_at(frame(), 0, 0), "100,500,0.05,8,2,3,0");
  EXPECT_EQ(text_at(frame(), 0, 8), "123,1,5,Hall,e1m1");
}

TEST_F(ModHudTest, AnErrorEndsTheBarWithOneSentenceAndTheGamesOwnIsShown) {
  put_program(R"(void() nothing;
    void(vector size, float scores) CSQC_DrawHud = { drawfill('0 0 0', '320 200 0', '1 1 1', 1, 0); if (time > 101) nothing(); };)");
  EXPECT_FALSE(shows_games_bar(frame()));
  hud.time = 102.0;
  fs::LogLines log;
  const scene::DrawList list = frame();
  EXPECT_TRUE(shows_games_bar(list));
  EXPECT_EQ(picture_at(raster(list), 100, 100), "") << "what it had drawn is gone";
  ASSERT_EQ(log.lines.size(), 2u) << "the trace, and the sentence";
  EXPECT_THAT(log.lines[1],
              HasSubstr("call of a NULL function: the game's own status bar is shown until the next level"));
  EXPECT_THAT(log.lines[1], HasSubstr("csprogs.dat: CSQC_DrawHud"));
  EXPECT_TRUE(shows_games_bar(frame()));
  EXPECT_EQ(log.lines.size(), 2u) << "said once";
  hud.time = 100.0;
  level = 2;
  EXPECT_FALSE(shows_games_bar(frame())) << "the next level begins anew";
}

TEST_F(ModHudTest, LoopsWithoutEndAndTooMuchDrawingAreStopped) {
  fs::LogLines log;
  put_program("void(vector size, float scores) CSQC_DrawHud = { while (1) {} };");
  EXPECT_TRUE(shows_games_bar(frame()));
  EXPECT_THAT(log.lines.back(), HasSubstr("a loop without end"));
  put_program(
      "void(vector size, float scores) CSQC_DrawHud = { while (1) drawfill('0 0 0', '1 1 0', '1 1 1', 1, 0); };");
  level = 2;
  EXPECT_TRUE(shows_games_bar(frame()));
  EXPECT_THAT(log.lines.back(), HasSubstr("draws more than 65536"));
  put_program("void(vector size, float scores) CSQC_DrawHud = { CSQC_DrawHud(size, scores); };");
  level = 3;
  EXPECT_TRUE(shows_games_bar(frame()));
  EXPECT_THAT(log.lines.back(), HasSubstr("stack overflow"));
}

TEST_F(ModHudTest, WhatIsNoBarLeavesTheGames) {
  fs::LogLines log;
  EXPECT_TRUE(shows_games_bar(frame()));
  EXPECT_TRUE(log.lines.empty()) << "most games have none";
  files["csprogs.dat"] = Bytes{1, 2, 3};
  level = 2;
  EXPECT_TRUE(shows_games_bar(frame()));
  EXPECT_THAT(log.lines.back(), HasSubstr("csprogs.dat"));
  put_program("void() CSQC_UpdateView = {};");
  level = 3;
  EXPECT_TRUE(shows_games_bar(frame()));
  const std::size_t said = log.lines.size();
  EXPECT_EQ(log.lines.back(), "csprogs.dat has no function CSQC_DrawHud: the game's own status bar is shown");
  frame();
  EXPECT_EQ(log.lines.size(), said) << "looked for once a level";
  // The one for both.
  put_program("void(vector size, float scores) CSQC_DrawHud = { drawfill('0 0 0', '9 9 0', '1 1 1', 1, 0); };",
              "progs.dat");
  level = 4;
  EXPECT_FALSE(shows_games_bar(frame()));
}

TEST_F(ModHudTest, CvarsSwitchItOff) {
  put_program("void(vector size, float scores) CSQC_DrawHud = {};");
  EXPECT_FALSE(shows_games_bar(frame()));
  console.set("cl_nocsqc", "1");
  EXPECT_TRUE(shows_games_bar(frame()));
  console.set("cl_nocsqc", "0");
  EXPECT_FALSE(shows_games_bar(frame()));
  console.add_cvar("pr_checkextension", "0", "");
  EXPECT_TRUE(shows_games_bar(frame()));
  level = 2;
  EXPECT_TRUE(shows_games_bar(frame()));
  console.set("pr_checkextension", "1");
  EXPECT_FALSE(shows_games_bar(frame()));
}

TEST_F(ModHudTest, CvarsThatItNames) {
  put_program(R"(var float autocvar_hud_width = 20;
    void(vector size, float scores) CSQC_DrawHud = { vector s; s = '0 5 0'; s_x = autocvar_hud_width; drawfill('0 0 0', s, '1 0 0', 1, 0); };)");
  EXPECT_EQ(frame().quads.back().max, vec2(20, 5));
  console.set("hud_width", "30");
  EXPECT_EQ(frame().quads.back().max, vec2(30, 5));
}

TEST_F(ModHudTest, Scores) {
  put_program(test_mod());
  hud.game_type = 1;
  hud.max_clients = 4;
  hud.scores = {{"ann", 3, 0x10}, {"", 0, 0}, {"bob", 7, 0xd0}};
  EXPECT_EQ(fill_at(frame(), {40, 40}), nullptr);
  ui::HudView scores = view();
  scores.show_scores = true;
  const scene::DrawList list = frame(scores);
  EXPECT_EQ(text_at(list, 40, 40), "7bob");
  EXPECT_EQ(text_at(list, 40, 50), "3ann");
  ASSERT_NE(fill_at(list, {40, 40}), nullptr);
  EXPECT_LT(glm::distance(fill_at(list, {40, 40})->color, atlas.color(0xd8)), 1e-5f);
  moment.menu_open = true;
  EXPECT_EQ(fill_at(frame(scores), {40, 40}), nullptr) << "not over a menu";
  moment.menu_open = false;
  // At a level's end they stand in the place of the game's board.
  hud.intermission = cl::Intermission::kLevel;
  EXPECT_EQ(text_at(frame(), 40, 40), "7bob");
  EXPECT_EQ(picture_at(raster(frame()), 70, 30), "");
  console.set("cl_nocsqc", "1");
  hud.game_type = 0;
  EXPECT_EQ(picture_at(raster(frame()), 70, 30), "gfx/complete.lmp");
}

TEST_F(ModHudTest, WithoutScoresOfItsOwnTheGamesAreShown) {
  put_program("void(vector size, float scores) CSQC_DrawHud = {};");
  hud.game_type = 1;
  hud.scores = {{"ann", 3, 0}};
  ui::HudView scores = view();
  scores.show_scores = true;
  EXPECT_EQ(picture_at(raster(frame(scores)), 100, 10), "gfx/ranking.lmp");
  hud.intermission = cl::Intermission::kLevel;
  EXPECT_EQ(picture_at(raster(frame()), 100, 10), "gfx/ranking.lmp");
}

TEST_F(ModHudTest, CommandsOfTheBarGoToItAndEndWithIt) {
  put_program(test_mod());
  frame();
  console.execute("bar_color \"0 0 1\"");
  EXPECT_EQ(raster(frame()).at(20, 177), vec3(0, 0, 1));
  level = 2;
  EXPECT_EQ(raster(frame()).at(20, 177), vec3(0.8f, 0.1f, 0.1f)) << "a level begins anew";
  EXPECT_TRUE(console.has_command("bar_color"));
  bar->end_game();
  EXPECT_FALSE(console.has_command("bar_color"));
}

TEST_F(ModHudTest, ShutdownIsToldAndCommandsOfOthersStay) {
  console.add_command("mine", "", [](const con::Args&) {});
  put_program(R"(void(vector size, float scores) CSQC_DrawHud = {};
    void(float api, string engine, float version) CSQC_Init = { registercommand("mine"); localcmd("echo ", engine, "\n"); };
    void() CSQC_Shutdown = { localsound("gone.wav"); };)");
  fs::LogLines log;
  frame();
  EXPECT_THAT(log.lines.back(), HasSubstr("registercommand mine: the console has that name already"));
  console.execute();
  EXPECT_EQ(log.lines.back(), "Fullbright");
  EXPECT_TRUE(sounds.empty());
  bar.reset();
  EXPECT_EQ(sounds, std::vector<std::string>{"gone.wav"});
  EXPECT_TRUE(console.has_command("mine"));
}

}  // namespace
}  // namespace fb::csqc
