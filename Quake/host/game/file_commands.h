// Commands about the game's files: condump, maps, mods; and what Tab completes of maps, demos, saves and the like.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "console/console.h"
#include "fs/filesystem.h"

namespace fb::host {

// Both must outlive the console's use of the commands.
void register_file_commands(con::Console& console, const fs::FileSystem& files);
// Of the commands that exist by now.
void complete_file_names(con::Console& console, const fs::FileSystem& files);

// The maps whose name begins so and where a player can start: not the boxes of ammunition, which are .bsp, too. Those
// that cannot be read are among them. By name.
std::vector<std::string> playable_maps(const fs::FileSystem& files, std::string_view beginning);

}  // namespace fb::host
