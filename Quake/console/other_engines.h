// Names of other engines (Ironwail, vkQuake, FTEQW, DarkPlaces, ezQuake) that configurations of games and mods use
// beside QuakeSpasm's. They exist without effect, so that such a configuration runs without a complaint about each.
#pragma once

#include "console/console.h"

namespace fb::con {

// Leaves names that are registered already as they are; a later registration of a cvar replaces the one made here.
void add_other_engines(Console& console);

}  // namespace fb::con
