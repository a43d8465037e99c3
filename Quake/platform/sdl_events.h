// Converts SDL's events; used by this module only.
#pragma once

#include <SDL_events.h>

#include <vector>

#include "platform/input_event.h"

namespace fb::platform {

// The key at a position of the keyboard; kKeyNone if Quake has no key there.
int key_from_scancode(SDL_Scancode code);

// Appends the event's meaning, which may be none or several events. Resizes come without a size, and the pointer's
// place in the window's units: the window sets and converts them.
void translate_event(const SDL_Event& event, std::vector<InputEvent>& to);

}  // namespace fb::platform
