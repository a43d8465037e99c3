// What a game controller's button means just now, as in Ironwail. While a button that is bound to +altmodifier is held
// the others are a second set: ABUTTON is ABUTTON_ALT. The cross is DPAD_UP and on where that is bound and the game has
// the keys, else the arrow keys.
#pragma once

#include <map>

#include "console/bindings.h"
#include "console/console.h"
#include "platform/input_event.h"

namespace fb::host {

class PadLayer {
 public:
  // Registers +altmodifier and -altmodifier. Both must outlive it.
  PadLayer(con::Console& console, const con::Bindings& bindings);

  // The event with the key that it means; a button is let go as what it was pressed as.
  platform::InputEvent meant(platform::InputEvent event, bool game_has_keys);

 private:
  int meaning(int key, bool game_has_keys) const;

  const con::Bindings& bindings_;
  std::map<int, int> pressed_;  // what a button that is down was taken for
  bool alternate_ = false;
};

}  // namespace fb::host
