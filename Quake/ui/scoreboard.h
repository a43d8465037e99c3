// Who leads: the players' frags and colours, in the forms that the screen has for them, and what a level's end tells.
// Layouts are QuakeSpasm's. A painter's canvas is the one that each names.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ui/hud_view.h"
#include "ui/painter.h"

namespace fb::ui {

// Indices of hud.scores that have a name, most frags first; of equal ones the earlier first.
std::vector<std::size_t> ranking(const cl::Hud& hud);
// Palette index of a player's colour (0 to 13).
int color_index(int color);

// Frags on the player's colours, and brackets about the player whose eyes these are.
struct FragsBox {
  float x = 0.0f, y = 0.0f, width = 28.0f;  // or 40, with room for the brackets
  float top = 4.0f, bottom = 3.0f;          // heights of shirt and trousers
};
void draw_frags(Painter& painter, const HudView& view, std::size_t player, const FragsBox& box, bool brackets);

// In the status bar's canvas: the four leaders in the inventory.
void draw_leaders(Painter& painter, const HudView& view);
// In the status bar's canvas: the players about oneself, right of the bar. Nothing where there is no room.
bool fits_small_scoreboard(const HudView& view, float scale);
void draw_small_scoreboard(Painter& painter, const HudView& view);
// In the status bar's canvas: kills, secrets, skill, the level's name.
void draw_level_board(Painter& painter, const HudView& view);
// In the menu's canvas: all players.
void draw_rankings(Painter& painter, const HudView& view);
// In the menu's canvas: time, secrets and kills at a level's end, and a finale's title.
void draw_level_end(Painter& painter, const HudView& view);
void draw_finale_title(Painter& painter);

}  // namespace fb::ui
