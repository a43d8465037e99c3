#include "host/game/screen.h"

#include <algorithm>
#include <cmath>

#include "ui/console_view.h"
#include "ui/hud.h"
#include "ui/painter.h"
#include "ui/view_area.h"
#include "ui/wrap.h"

namespace fb::host {
namespace {

int number_of(const con::Console& console, std::string_view cvar) {
  const con::Cvar* const found = console.find_cvar(cvar);
  return found ? static_cast<int>(found->value() + 0.5f) : 0;
}

// A map that is only looked at has no player.
bool plays(const cl::Client& client) { return client.active() && (client.playing() || client.connected()); }

}  // namespace

Screen::Screen(con::Console& console, csqc::ModHudServices services, KeyRouter& keys, ui::Rules rules)
    : console_(console),
      keys_(keys),
      rules_(rules),
      atlas_(services.read_file),
      mod_hud_(console, atlas_, std::move(services)) {
  ui::register_hud_cvars(console);
  console.add_command("+showscores", "+showscores: show the scoreboard until -showscores",
                      [this](const con::Args&) { show_scores_ = true; });
  console.add_command("-showscores", "-showscores: hide the scoreboard",
                      [this](const con::Args&) { show_scores_ = false; });
}

// A scale of 1, the default, means as large as fits.
void Screen::draw_menu(uvec2 size, double now) {
  const con::Cvar* scale = console_.find_cvar("scr_menuscale");
  const bool smaller = scale != nullptr && scale->has_effect() && scale->value() >= 2.0f;
  keys_.begin_frame();
  keys_.menu().draw(list_, atlas_, static_cast<int>(size.x), static_cast<int>(size.y),
                    {now, smaller ? scale->integer() : 0});
}

ui::HudView Screen::view_of(const cl::Client& client, uvec2 size) {
  const ivec2 output(size);
  ui::HudView view{client.hud(), ui::read_hud_settings(console_, output.x, output.y), rules_, output};
  view.show_scores = show_scores_;
  view.skill = number_of(console_, "skill");
  view.teamplay = number_of(console_, "teamplay");
  view.silence = client.silence();
  view.slow = slow_.slow();
  view.speed = speed_.value();
  view.frame_rate = rate_.value();
  view.mod_bar = &mod_hud_;
  return view;
}

void Screen::follow_game(const cl::Client& client, const Moment& moment) {
  if (!plays(client)) return mod_hud_.end_game();
  mod_hud_.begin_frame(client.levels(), client.hud(),
                       {.now = moment.now,
                        .seconds = moment.seconds,
                        .view_angles = client.view_angles(),
                        .demo = client.playing(),
                        .local_server = client.serves_itself(),
                        .menu_open = keys_.menu_open()});
}

void Screen::draw_console(const ui::HudView& view, bool game, bool lines_too) {
  const ui::HudSettings& s = view.settings;
  const float scale = ui::console_scale(view.output, s.console_scale, s.console_width);
  ui::Painter painter(list_, atlas_, ui::screen_canvas(view.output, scale));
  if (keys_.console_open() || !game) {
    ui::ConsoleView console;
    console.fraction = game ? 0.5f : 1.0f;
    console.opacity = s.console_alpha;
    console.time = view.now;
    keys_.begin_console(ui::console_rows(painter.height(), console.fraction));
    console.scrolled_up = keys_.scrolled_up();
    ui::draw_console(painter, console_.scrollback(), keys_.console_line(), console);
    return;
  }
  std::size_t rows = 0;
  if (lines_too) {
    const auto lines = console_.scrollback().recent(ui::kNotifyLines, view.now, s.notify_seconds);
    ui::draw_notify(painter, lines);
    const auto columns = static_cast<std::size_t>(std::max(painter.width() / 8 - 2, 1));
    for (const con::ScrollLine& line : lines) rows += ui::wrap(line.text, columns).size();
  }
  keys_.message().draw(painter, 8.0f * static_cast<float>(rows), view.now);
}

scene::Area Screen::picture_area(const cl::Client& client, uvec2 size) {
  return plays(client) ? ui::view_area(view_of(client, size)) : scene::Area{uvec2(0), size};
}

const scene::DrawList& Screen::draw(const cl::Client& client, const Moment& moment) {
  const bool game = client.active();
  list_.clear();
  list_.atlas = atlas_.image();
  rate_.frame(moment.now);
  slow_.frame(moment.seconds);
  const vec3 velocity = client.velocity();
  speed_.frame(moment.now, std::sqrt(velocity.x * velocity.x + velocity.y * velocity.y));
  ui::HudView view = view_of(client, moment.size);
  view.now = moment.now;
  bool lines = moment.lines;
  const bool played = plays(client);
  follow_game(client, moment);
  const bool elsewhere = keys_.console_open() || keys_.menu_open();
  if (played) {
    list_.picture = ui::view_area(view);
    ui::draw_border(list_, atlas_, view);
  }
  if (played) lines &= ui::draw_hud(list_, atlas_, view, elsewhere ? ui::Attention::kElsewhere : ui::Attention::kGame);
  if (moment.demo_bar && !elsewhere) ui::draw_demo_bar(list_, atlas_, view, *moment.demo_bar);
  if (moment.panel) moment.panel(list_, atlas_);
  if (keys_.console_open() || moment.lines) draw_console(view, game, lines);
  draw_menu(moment.size, moment.now);
  return list_;
}

const scene::DrawList& Screen::draw_loading(const cl::Client& client, uvec2 size) {
  list_.clear();
  const ui::HudView view = view_of(client, size);
  if (plays(client)) {
    list_.picture = ui::view_area(view);
    ui::draw_border(list_, atlas_, view);
  }
  ui::draw_loading(list_, atlas_, view);
  ui::draw_current_bar(list_, atlas_, view);
  return list_;
}

const scene::DrawList& Screen::draw_start(const cl::Client& client, uvec2 size, double seconds, std::string_view what) {
  list_.clear();
  ui::draw_start(list_, atlas_, view_of(client, size), seconds, what);
  list_.atlas = atlas_.image();
  return list_;
}

}  // namespace fb::host
