// The manual's page of commands and cvars, from what is registered.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "console/console.h"

namespace fb::con {

// Markdown tables: the game's commands, its cvars, what a dedicated server has besides, and the cvars that are known
// by name alone.
std::string commands_page(const Console& game, const Console& dedicated);
// Names of commands and cvars without a help text.
std::vector<std::string> names_without_help(const Console& console);

}  // namespace fb::con
