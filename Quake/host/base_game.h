// The base game, which is found beside the program and so needs no option.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fb::host {

// DIR of the first DIR/id1/progs.dat among <program>/game, where `make` puts it, and
// <program>/../share/fullbright/game, where an installation does; empty if neither exists.
std::filesystem::path find_base_game(const std::filesystem::path& program_directory);

// `arguments` preceded by -basegame DIR, unless they contain it or there is no base game.
std::vector<std::string> with_base_game(std::vector<std::string> arguments);

}  // namespace fb::host
