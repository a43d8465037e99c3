// Cvars that the engine keeps for mods and does nothing with itself, under Quake's names.
#pragma once

#include "console/console.h"

namespace fb::sv {

// Those that are there already stay as they are. `registered`: whether this is the whole game, which QuakeC asks before
// it lets players on (cvar `registered`, which the console does not set).
void add_mod_cvars(con::Console& console, bool registered);

}  // namespace fb::sv
