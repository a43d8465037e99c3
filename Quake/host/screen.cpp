#include "host/screen.h"

#include <algorithm>

#include "ui/console_view.h"
#include "ui/painter.h"
#include "ui/wrap.h"

namespace fb::host {
namespace {

constexpr double kCenterPrintSeconds = 2.0;  // scr_centertime's default

}  // namespace

Screen::Screen(con::Console& console, FileLoader files, KeyRouter& keys)
    : console_(console),
      keys_(keys),
      show_fps_(console.add_cvar("scr_showfps", "0", "1: show the frame rate, frames a second", con::kCvarArchive)),
      atlas_(std::move(files)) {}

// A scale of 1, the default, means as large as fits.
void Screen::draw_menu(uvec2 size, double now) {
  const con::Cvar* scale = console_.find_cvar("scr_menuscale");
  const bool smaller = scale != nullptr && scale->has_effect() && scale->value() >= 2.0f;
  keys_.begin_frame();
  keys_.menu().draw(list_, atlas_, static_cast<int>(size.x), static_cast<int>(size.y),
                    {now, smaller ? scale->integer() : 0});
}

const scene::DrawList& Screen::draw(const cl::Hud& hud, bool game, uvec2 size, double now) {
  list_.clear();
  rate_.frame(now);
  const int width = static_cast<int>(size.x), height = static_cast<int>(size.y);
  ui::Painter painter(list_, atlas_, width, height, ui::automatic_scale(width, height));
  const bool finale = hud.intermission == cl::Intermission::kFinale || hud.intermission == cl::Intermission::kCutscene;
  if (game && !hud.center_print.empty() && (finale || hud.time - hud.center_print_time < kCenterPrintSeconds)) {
    // A finale's text appears at eight characters a second.
    const double shown = finale ? 8.0 * (hud.time - hud.center_print_time) : 1e9;
    ui::draw_center_print(painter, hud.center_print, static_cast<std::size_t>(std::max(0.0, shown)));
  }
  if (keys_.console_open() || !game) {
    ui::ConsoleView view;
    view.fraction = game ? 0.5f : 1.0f;
    view.scrolled_up = keys_.scrolled_up();
    view.time = now;
    ui::draw_console(painter, console_.scrollback(), keys_.console_line(), view);
  } else {
    const auto lines = console_.scrollback().recent(ui::kNotifyLines, now, ui::kNotifySeconds);
    ui::draw_notify(painter, lines);
    const auto columns = static_cast<std::size_t>(std::max(painter.width() / 8 - 2, 1));
    std::size_t rows = 0;
    for (const con::ScrollLine& line : lines) rows += ui::wrap(line.text, columns).size();
    keys_.message().draw(painter, 8.0f * static_cast<float>(rows), now);
  }
  if (show_fps_.on()) ui::draw_fps(painter, rate_.value());
  draw_menu(size, now);
  return list_;
}

}  // namespace fb::host
