// Short ways to write the rows of a page.
#pragma once

#include <string>

#include "ui/menu/pages.h"

namespace fb::ui::menu {

Row action(std::string label, std::string command, std::string help = {});
Row link(std::string label, std::string page, std::string help = {});
Row heading(std::string label);
Row skill_row(const con::Console& console);
// Leaves what is played, after a question, for a game of one player on this map. `before`: commands that go first.
Row new_game(const Sources& sources, std::string label, const std::string& map, const std::string& before = {});

}  // namespace fb::ui::menu
