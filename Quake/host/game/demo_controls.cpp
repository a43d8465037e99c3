#include "host/game/demo_controls.h"

#include "platform/keys.h"
#include "ui/hud_settings.h"

namespace fb::host {

bool DemoControls::directs() const { return client_.playing() && !client_.timing(); }

bool DemoControls::press(int key) {
  const auto run = [this](const char* command) {
    console_.append(std::string(command) + "\n");
    return true;
  };
  switch (key) {
    case platform::kKeySpace:
      return run("demo_pause");
    case platform::kKeyUpArrow:
      return run("demo_faster");
    case platform::kKeyDownArrow:
      return run("demo_slower");
    case platform::kKeyLeftArrow:
    case platform::kKeyRightArrow:
      if (arrow_ != 0) release(arrow_);
      arrow_ = key;
      return run(key == platform::kKeyLeftArrow ? "+demo_rewind" : "+demo_forward");
    case ',':
      return run("demo_nudge -1");
    case '.':
      return run("demo_nudge 1");
    case platform::kKeyHome:
      return run("demo_jump 0");
    case platform::kKeyPageUp:
      return run("demo_prev");
    case platform::kKeyPageDown:
      return run("demo_next");
    default:
      return false;
  }
}

bool DemoControls::release(int key) {
  if (key != arrow_ || arrow_ == 0) return false;
  console_.append(arrow_ == platform::kKeyLeftArrow ? "-demo_rewind\n" : "-demo_forward\n");
  arrow_ = 0;
  return true;
}

void DemoControls::let_go() {
  if (line_held_) client_.pause_demo(was_paused_);
  line_held_ = false;
}

bool DemoControls::handle(const platform::InputEvent& event) {
  using Kind = platform::InputEvent::Kind;
  const bool mouse = event.kind == Kind::kKey && event.key == platform::kKeyMouse1;
  if (event.kind == Kind::kKey && !event.down) {
    if (mouse) let_go();
    return release(event.key);
  }
  if (!directs()) return false;
  if (event.kind == Kind::kMouseMotion) {
    touched_ |= pointer_ != vec2(event.x, event.y);
    pointer_ = {event.x, event.y};
    return false;
  }
  if (event.kind != Kind::kKey) return false;
  if (mouse && console_.cvar("scr_demobar_timeout").value() >= 0.0f) {
    const ui::HudSettings settings = ui::read_hud_settings(console_, output_.x, output_.y);
    const auto status = client_.demo_status();
    if (!status || !ui::demo_time_at(settings, output_, status->length, pointer_, false)) return false;
    was_paused_ = status->paused;
    line_held_ = touched_ = true;
    client_.pause_demo(true);
    return true;
  }
  // A key that is held down does its work once, but for frames.
  const bool again = event.key == ',' || event.key == '.';
  const bool taken = event.repeat && !again ? event.key == arrow_ : press(event.key);
  touched_ |= taken;
  return taken;
}

std::optional<ui::DemoBar> DemoControls::frame(uvec2 output, double now) {
  output_ = output;
  if (!directs()) {
    let_go();
    touched_ = false;
    return std::nullopt;
  }
  const double stays = console_.cvar("scr_demobar_timeout").value();
  if (touched_ || line_held_ || arrow_ != 0) shown_until_ = now + stays;
  touched_ = false;
  if (stays < 0.0 || (stays > 0.0 && now >= shown_until_)) return std::nullopt;
  auto status = client_.demo_status();  // reads the demo from end to end, once
  if (line_held_ && status) {
    const ui::HudSettings settings = ui::read_hud_settings(console_, output_.x, output_.y);
    client_.seek_demo(ui::demo_time_at(settings, output_, status->length, pointer_, true).value_or(status->seconds));
    status = client_.demo_status();
  }
  if (!status) return std::nullopt;
  return ui::DemoBar{client_.demo_name(), status->seconds, status->length, status->rate};
}

}  // namespace fb::host
