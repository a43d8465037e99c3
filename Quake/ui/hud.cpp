#include "ui/hud.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

}  // namespace

bool draw_hud(scene::DrawList& list, Atlas& atlas, const HudView& view, Attention attention) {
  const cl::Intermission over = view.hud.intermission;
  const bool game = attention == Attention::kGame;
  if (game && (over == cl::Intermission::kLevel || over == cl::Intermission::kFinale)) {
    {
      Painter painter(list, atlas, menu_canvas(view.output, view.settings.menu_scale));
      if (over == cl::Intermission::kFinale)
        draw_finale_title(painter);
      else if (view.deathmatch())
        draw_rankings(painter, view);
      else
        draw_level_end(painter, view);
    }
    if (over == cl::Intermission::kFinale) draw_message(list, atlas, view);
    return false;
  }
  draw_crosshair(list, atlas, view);
  draw_warnings(list, atlas, view);
  draw_pause(list, atlas, view);
  if (game && !view.hud.paused) draw_message(list, atlas, view);
  if (over == cl::Intermission::kNone) draw_status_bar(list, atlas, view);
  draw_readings(list, atlas, view);
  return true;
}

}  // namespace fb::ui
