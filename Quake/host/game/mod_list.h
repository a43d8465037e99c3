// The game folders that could be played: those beside id1 and in the player's folder that hold game data.
#pragma once

#include <vector>

#include "fs/filesystem.h"
#include "ui/menu/facts.h"

namespace fb::host {

// By name, id1 first. The description is the first line of the folder's modinfo.txt or description.txt, if it has one.
std::vector<ui::menu::ModEntry> list_mods(const fs::FileSystem& files);

}  // namespace fb::host
