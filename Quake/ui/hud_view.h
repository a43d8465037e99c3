// What the status bar and its relatives are drawn from.
#pragma once

#include <cstdint>

#include "base/maths.h"
#include "client/session/hud.h"
#include "ui/hud_settings.h"

namespace fb::ui {

class ModBar;

// Which rules' items the bits of a player mean: Quake's, Scourge of Armagon's, Dissolution of Eternity's.
enum class Rules { kQuake, kHipnotic, kRogue };

struct HudView {
  const cl::Hud& hud;
  HudSettings settings;
  Rules rules = Rules::kQuake;
  ivec2 output{0, 0};        // pixels
  bool show_scores = false;  // +showscores
  int skill = 1;
  int teamplay = 0;
  double now = 0.0;           // seconds of a clock that never stops, for what scrolls
  double silence = 0.0;       // seconds since the server was heard
  bool slow = false;          // three frames in a row took a tenth of a second or more
  float speed = -1.0f;        // over ground, units a second; negative: not known
  double frame_rate = 0.0;    // frames a second; 0: not known
  ModBar* mod_bar = nullptr;  // what a mod draws in the status bar's place; null: nothing

  bool has(std::uint32_t bits) const { return (static_cast<std::uint32_t>(hud.items) & bits) != 0; }
  int stat(int index) const { return hud.stats[static_cast<std::size_t>(index)]; }
  bool deathmatch() const { return hud.game_type == 1; }
  // The scoreboard is shown in the status bar's place.
  bool scores_shown() const { return show_scores || stat(net::kStatHealth) <= 0; }
  // The bit of the weapon in hand: mission packs' servers send its number.
  std::uint32_t active_weapon() const;
};

}  // namespace fb::ui
