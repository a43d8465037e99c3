// SDL's events in our words; for this module alone.
#pragma once

#include <SDL_events.h>

#include <vector>

#include "platform/input_event.h"

namespace fb::platform {

// The key at a place of the keyboard; kKeyNone for places that Quake has no key for.
int key_from_scancode(SDL_Scancode code);

// Appends what the event means, which may be nothing or several things. Resizes come without a size: the window fills
// it in.
void translate_event(const SDL_Event& event, std::vector<InputEvent>& to);

}  // namespace fb::platform
