// What the forms of the status bar share.
#pragma once

#include "ui/atlas.h"
#include "ui/hud_view.h"
#include "ui/named_pictures.h"
#include "ui/painter.h"
#include "ui/scoreboard.h"

namespace fb::ui {

// The inventory with the four counts of ammunition is shown, or the bar alone, or neither.
inline bool shows_inventory(const HudView& view) { return view.settings.view_size < 110.0f; }
inline bool shows_bar(const HudView& view) { return view.settings.view_size < 120.0f; }
inline vec4 background(const HudView& view) { return vec4(1.0f, 1.0f, 1.0f, view.settings.bar_alpha); }

constexpr float kIconRow = 16.0f;  // height of a weapon's or an item's picture

// Numbers of up to three digits, red where little is left.
void draw_health(Painter& painter, const HudView& view, float x, float y);
void draw_ammo(Painter& painter, const HudView& view, float x, float y);

// The armour's number: with invulnerability it is 666.
struct Armor {
  int points = 0;
  bool red = false;
};
Armor armor_shown(const HudView& view);

// In the corners and at the sides of all of the output (1 and 2 of scr_hudstyle).
void draw_corner_bar(scene::DrawList& list, Atlas& atlas, const HudView& view);
// QuakeWorld's inventory: weapons and ammunition at the right (3).
void draw_side_inventory(scene::DrawList& list, Atlas& atlas, const HudView& view, bool small_scoreboard);

}  // namespace fb::ui
