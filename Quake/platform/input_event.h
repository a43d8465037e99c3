// The user's input events, in the order in which they happened.
#pragma once

#include <cstdint>
#include <string>

#include "platform/keys.h"

namespace fb::platform {

struct InputEvent {
  enum class Kind {
    kKey,   // key, down, repeat, letter; keyboard, mouse buttons and wheel steps (a step goes down and up at once)
    kText,  // text: UTF-8 by the keyboard layout and the input method
    kMouseMotion,  // dx to the right, dy downwards: counts of the mouse while grabbed, else pixels; x, y where it is
    kFocus,        // focused
    kResize,       // width, height: the window's new size in pixels; 0, 0 while it is minimised. by_user: the user or
                   // the window manager has chosen it
    kQuit,         // the user closed the window or the system asks the program to end
  };
  Kind kind = Kind::kQuit;
  int key = kKeyNone;
  char letter =
      0;  // what the layout has at the key, lower-case ASCII, for Ctrl+V and the like; 0: nothing of that kind
  bool down = false, repeat = false, focused = false, by_user = false;
  int dx = 0, dy = 0;
  float x = 0.0f, y = 0.0f;  // pixels of the window's contents; of no meaning while grabbed
  std::uint32_t width = 0, height = 0;
  std::string text;
};

}  // namespace fb::platform
