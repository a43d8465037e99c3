#include "host/screen.h"

#include <algorithm>

#include "platform/keys.h"
#include "ui/console_view.h"
#include "ui/painter.h"

namespace fb::host {
namespace {

constexpr int kKeyGrave = '`';
constexpr std::size_t kPageLines = 8;
constexpr double kCenterPrintSeconds = 2.0;  // scr_centertime's default

}  // namespace

Screen::Screen(con::Console& console, FileLoader files)
    : console_(console),
      bindings_(
          console, [](std::string_view name) { return platform::key_from_name(name); },
          [](int key) { return platform::key_name(key); }),
      show_fps_(console.add_cvar("scr_showfps", "0", "1: show the frame rate, frames a second", con::kCvarArchive)),
      atlas_(std::move(files)) {
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

const scene::DrawList& Screen::draw(const cl::Hud& hud, bool game, uvec2 size, double now) {
  in_game_ = game;
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
  if (open_ || !game) {
    ui::ConsoleView view;
    view.fraction = game ? 0.5f : 1.0f;
    view.scrolled_up = scrolled_up_;
    view.time = now;
    ui::draw_console(painter, console_.scrollback(), input_, view);
  } else {
    ui::draw_notify(painter, console_.scrollback().recent(ui::kNotifyLines, now, ui::kNotifySeconds));
  }
  if (show_fps_.on()) ui::draw_fps(painter, rate_.value());
  return list_;
}

}  // namespace fb::host
