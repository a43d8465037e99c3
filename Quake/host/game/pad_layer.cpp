#include "host/game/pad_layer.h"

#include "platform/keys.h"

namespace fb::host {

PadLayer::PadLayer(con::Console& console, const con::Bindings& bindings) : bindings_(bindings) {
  console.add_command("+altmodifier",
                      "+altmodifier: while held, a game controller's other buttons are ABUTTON_ALT and so on",
                      [this](const con::Args&) { alternate_ = true; });
  console.add_command("-altmodifier", "-altmodifier: a game controller's buttons are themselves again",
                      [this](const con::Args&) { alternate_ = false; });
}

int PadLayer::meaning(int key, bool game_has_keys) const {
  if (game_has_keys && alternate_) {
    if (const int alternate = platform::alternate_key(key); alternate != platform::kKeyNone) key = alternate;
  }
  const bool is_cross = key >= platform::kKeyDpadUp && key <= platform::kKeyDpadRight;
  if (!is_cross || (game_has_keys && !bindings_.command(key).empty())) return key;
  return platform::kKeyUpArrow + (key - platform::kKeyDpadUp);
}

platform::InputEvent PadLayer::meant(platform::InputEvent event, bool game_has_keys) {
  if (event.kind != platform::InputEvent::Kind::kKey) return event;
  if (event.down) {
    const int key = meaning(event.key, game_has_keys);
    if (key == event.key)
      pressed_.erase(key);
    else
      pressed_[event.key] = key;
    event.key = key;
  } else if (const auto pressed = pressed_.find(event.key); pressed != pressed_.end()) {
    event.key = pressed->second;
    pressed_.erase(pressed);
  }
  return event;
}

}  // namespace fb::host
