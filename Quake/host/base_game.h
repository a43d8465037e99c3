// Game data that needs no option: the base game beside the program, and Quake where a store put it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fs/store_games.h"

namespace fb::host {

// DIR of the first DIR/id1/progs.dat among <program>/game, where `make` puts it, and
// <program>/../share/fullbright/game, where an installation does; empty if neither exists.
std::filesystem::path find_base_game(const std::filesystem::path& program_directory);

// `arguments` preceded by -basegame DIR, unless they contain it or there is no base game.
std::vector<std::string> with_base_game(std::vector<std::string> arguments);

// `arguments` preceded by -basedir DIR of the first of `games` that they allow (-steam, -gog, -nosteam, -nogog,
// -preforiginal), and a line that says so. As they are where they say what is played (-basedir), where `here` holds an
// id1, and where no game is left.
std::vector<std::string> with_store_game(std::vector<std::string> arguments, const std::vector<fs::StoreGame>& games,
                                         const std::filesystem::path& here);

}  // namespace fb::host
