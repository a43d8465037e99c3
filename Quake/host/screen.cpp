#include "host/screen.h"

#include <algorithm>
#include <cmath>

#include "platform/keys.h"
#include "ui/console_view.h"
#include "ui/hud.h"
#include "ui/painter.h"
#include "ui/status_bar.h"

namespace fb::host {
namespace {

constexpr int kKeyGrave = '`';
constexpr std::size_t kPageLines = 8;

int number_of(const con::Console& console, std::string_view cvar) {
  const con::Cvar* const found = console.find_cvar(cvar);
  return found ? static_cast<int>(found->value() + 0.5f) : 0;
}

}  // namespace

Screen::Screen(con::Console& console, FileLoader files, ui::Rules rules)
    : console_(console),
      bindings_(
          console, [](std::string_view name) { return platform::key_from_name(name); },
          [](int key) { return platform::key_name(key); }),
      rules_(rules),
      atlas_(std::move(files)) {
  ui::register_hud_cvars(console);
  console.add_command("+showscores", "+showscores: show the scoreboard until -showscores",
                      [this](const con::Args&) { show_scores_ = true; });
  console.add_command("-showscores", "-showscores: hide the scoreboard",
                      [this](const con::Args&) { show_scores_ = false; });
  console.add_command("toggleconsole", "toggleconsole: open or close the console", [this](const con::Args&) {
    open_ = !open_;
    bindings_.release_all();
  });
  bindings_.bind(kKeyGrave, "toggleconsole");
}

void Screen::close_console() { open_ = false; }

void Screen::type(const platform::InputEvent& event) {
  switch (event.key) {
    case platform::kKeyEnter:
      input_.enter(console_);
      scrolled_up_ = 0;
      break;
    case platform::kKeyTab:
      input_.complete(console_);
      break;
    case platform::kKeyBackspace:
      input_.erase_before();
      break;
    case platform::kKeyDelete:
      input_.erase_at();
      break;
    case platform::kKeyLeftArrow:
      input_.move(-1);
      break;
    case platform::kKeyRightArrow:
      input_.move(1);
      break;
    case platform::kKeyHome:
      input_.home();
      break;
    case platform::kKeyEnd:
      input_.end();
      break;
    case platform::kKeyUpArrow:
      input_.recall(1);
      break;
    case platform::kKeyDownArrow:
      input_.recall(-1);
      break;
    case platform::kKeyPageUp:
    case platform::kKeyWheelUp:
      scrolled_up_ += kPageLines;
      break;
    case platform::kKeyPageDown:
    case platform::kKeyWheelDown:
      scrolled_up_ -= std::min(scrolled_up_, kPageLines);
      break;
    default:
      break;
  }
  scrolled_up_ = std::min(scrolled_up_, console_.scrollback().size());
}

void Screen::handle(const platform::InputEvent& event) {
  using Kind = platform::InputEvent::Kind;
  if (event.kind == Kind::kFocus && !event.focused) bindings_.release_all();
  const bool typing = open_ || !in_game_;
  if (event.kind == Kind::kText && typing && event.text != "`" && event.text != "~") input_.insert(event.text);
  if (event.kind != Kind::kKey) return;
  const bool toggles = event.key == kKeyGrave || (event.key == platform::kKeyEscape);
  if (toggles) {
    if (event.down && !event.repeat) console_.append("toggleconsole\n");
  } else if (typing) {
    if (event.down) type(event);
  } else if (!event.repeat) {
    bindings_.key_event(event.key, event.down);
  }
}

ui::HudView Screen::view_of(const cl::Client& client, uvec2 size) const {
  const ivec2 output(size);
  ui::HudView view{client.hud(), ui::read_hud_settings(console_, output.x, output.y), rules_, output};
  view.show_scores = show_scores_;
  view.skill = number_of(console_, "skill");
  view.teamplay = number_of(console_, "teamplay");
  view.silence = client.silence();
  view.slow = slow_.slow();
  view.speed = speed_.value();
  view.frame_rate = rate_.value();
  return view;
}

void Screen::draw_console(const ui::HudView& view, bool game, bool lines_too) {
  const ui::HudSettings& s = view.settings;
  const float scale = ui::console_scale(view.output, s.console_scale, s.console_width);
  ui::Painter painter(list_, atlas_, ui::screen_canvas(view.output, scale));
  if (open_ || !game) {
    ui::ConsoleView console;
    console.fraction = game ? 0.5f : 1.0f;
    console.opacity = s.console_alpha;
    console.scrolled_up = scrolled_up_;
    console.time = view.now;
    ui::draw_console(painter, console_.scrollback(), input_, console);
  } else if (lines_too) {
    ui::draw_notify(painter, console_.scrollback().recent(ui::kNotifyLines, view.now, s.notify_seconds));
  }
}

const scene::DrawList& Screen::draw(const cl::Client& client, const Moment& moment) {
  const bool game = client.active();
  in_game_ = game;
  list_.clear();
  list_.atlas = atlas_.image();
  rate_.frame(moment.now);
  slow_.frame(moment.seconds);
  const vec3 velocity = client.velocity();
  speed_.frame(moment.now, std::sqrt(velocity.x * velocity.x + velocity.y * velocity.y));
  ui::HudView view = view_of(client, moment.size);
  view.now = moment.now;
  bool lines = moment.lines;
  // A map that is only looked at has no player.
  const bool played = game && (client.playing() || client.connected());
  if (played) lines &= ui::draw_hud(list_, atlas_, view, open_ ? ui::Attention::kElsewhere : ui::Attention::kGame);
  if (open_ || moment.lines) draw_console(view, game, lines);
  return list_;
}

const scene::DrawList& Screen::draw_loading(const cl::Client& client, uvec2 size) {
  list_.clear();
  const ui::HudView view = view_of(client, size);
  ui::draw_loading(list_, atlas_, view);
  ui::draw_status_bar(list_, atlas_, view);
  return list_;
}

}  // namespace fb::host
