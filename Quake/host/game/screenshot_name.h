// The name of a screenshot that was given none.
#pragma once

#include <string>

#include "fs/filesystem.h"

namespace fb::host {

// "fullbright0000.png", or the next that is free in the player's screenshots/: those of earlier runs and of other
// programs stay.
std::string free_screenshot_name(const fs::FileSystem& files);

}  // namespace fb::host
