// Cvars of QuakeSpasm that have no effect in this engine. They exist so that QuakeSpasm's configurations run and mods
// can set and read them. Names and defaults are those of QuakeSpasm 0.96.3, and one name of 0.95 that 0.96 removed.
#pragma once

#include "console/console.h"

namespace fb::con {

// Leaves cvars that are registered already as they are. A later registration of the same name replaces the one made
// here (kCvarNoEffect).
void add_quakespasm_cvars(Console& console);

}  // namespace fb::con
