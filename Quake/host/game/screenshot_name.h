// The names of screenshots.
#pragma once

#include <string>

#include "fs/filesystem.h"

namespace fb::host {

// "fullbright0000.png", or the next that is free in the player's screenshots/: those of earlier runs and of other
// programs stay.
std::string free_screenshot_name(const fs::FileSystem& files);

// The file of the name that a player typed: NAME.png, and NAME itself where it ends so.
std::string typed_screenshot_name(const std::string& name);

}  // namespace fb::host
