// The game folders that could be played: those beside id1 and in the player's folder that hold game data.
#pragma once

#include <filesystem>
#include <vector>

#include "fs/filesystem.h"
#include "ui/menu/facts.h"

namespace fb::host {

// Whether a folder holds a pak0.pak, a pk3, a progs.dat or maps.
bool is_game_folder(const std::filesystem::path& folder);
// By name, id1 first. The description is the first line of the folder's modinfo.txt or description.txt, if it has one.
std::vector<ui::menu::ModEntry> list_mods(const fs::FileSystem& files);

}  // namespace fb::host
