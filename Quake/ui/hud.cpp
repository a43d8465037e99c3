#include "ui/hud.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/mod_bar.h"
#include "ui/overlays.h"
#include "ui/painter.h"
#include "ui/scoreboard.h"
#include "ui/signs.h"
#include "ui/status_bar.h"

namespace fb::ui {
namespace {

// A message of the server's. Between levels it stays, and is typed letter by letter.
void draw_message(scene::DrawList& list, Atlas& atlas, const HudView& view) {
  const cl::Hud& hud = view.hud;
  if (hud.center_print.empty()) return;
  const double age = hud.time - hud.center_print_time;
  const bool over = hud.intermission != cl::Intermission::kNone;
  if (!over && age >= static_cast<double>(view.settings.center_seconds)) return;
  std::size_t letters = std::numeric_limits<std::size_t>::max();
  if (over) {
    const double typed = std::clamp(static_cast<double>(view.settings.print_speed) * age, 0.0, 1e9);
    letters = static_cast<std::size_t>(typed) + 1;
  }
  Painter painter(list, atlas, menu_canvas(view.output, view.settings.menu_scale));
  draw_center_print(painter, hud.center_print, letters, view.settings.crosshair != 0.0f ? 8.0f : 0.0f);
}

void draw_level_end_board(scene::DrawList& list, Atlas& atlas, const HudView& view) {
  if (view.mod_bar && view.mod_bar->draw_level_end(list, view)) return;
  Painter painter(list, atlas, menu_canvas(view.output, view.settings.menu_scale));
  if (view.deathmatch())
    draw_rankings(painter, view);
  else
    draw_level_end(painter, view);
}

}  // namespace

// A mod's bar is drawn between levels, too, where the game's own is not (vkQuake).
void draw_current_bar(scene::DrawList& list, Atlas& atlas, const HudView& view) {
  const auto drawn = view.mod_bar ? view.mod_bar->draw_bar(list, view) : ModBar::Drawn::kNothing;
  if (drawn == ModBar::Drawn::kNothing) {
    if (view.hud.intermission == cl::Intermission::kNone) draw_status_bar(list, atlas, view);
  } else if (drawn == ModBar::Drawn::kBar && view.scores_shown() && view.deathmatch()) {
    Painter painter(list, atlas, menu_canvas(view.output, view.settings.menu_scale));
    draw_rankings(painter, view);
  }
}

bool draw_hud(scene::DrawList& list, Atlas& atlas, const HudView& view, Attention attention) {
  const cl::Intermission over = view.hud.intermission;
  const bool game = attention == Attention::kGame;
  if (game && (over == cl::Intermission::kLevel || over == cl::Intermission::kFinale)) {
    if (over == cl::Intermission::kLevel) {
      draw_level_end_board(list, atlas, view);
      return false;
    }
    {
      Painter painter(list, atlas, menu_canvas(view.output, view.settings.menu_scale));
      draw_finale_title(painter);
    }
    draw_message(list, atlas, view);
    return false;
  }
  draw_crosshair(list, atlas, view);
  draw_warnings(list, atlas, view);
  draw_pause(list, atlas, view);
  if (game && !view.hud.paused) draw_message(list, atlas, view);
  draw_current_bar(list, atlas, view);
  draw_readings(list, atlas, view);
  return true;
}

}  // namespace fb::ui
