// Short ways to write the rows of a page.
#pragma once

#include <string>

#include "ui/menu/pages.h"

namespace fb::ui::menu {

Row action(std::string label, std::string command, std::string help = {});
Row link(std::string label, std::string page, std::string help = {});
Row heading(std::string label);
Row skill_row(const con::Console& console);
// Leaves what is played for a game of one player on this map.
std::string new_game_command(const std::string& map);

}  // namespace fb::ui::menu
