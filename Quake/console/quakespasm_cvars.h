// QuakeSpasm's cvars that nothing here listens to: they exist so that its configurations run and mods may set and read
// them. Names and defaults are those of QuakeSpasm 0.96.3; a name of 0.95's that it gave up is there, too.
#pragma once

#include "console/console.h"

namespace fb::con {

// Those that are there already stay as they are; whoever adds one of these later takes its place (kCvarNoEffect).
void add_quakespasm_cvars(Console& console);

}  // namespace fb::con
