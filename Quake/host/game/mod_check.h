// The console's modcheck: what the programs of the game that is played ask for and that is missing here.
#pragma once

#include "console/console.h"
#include "fs/filesystem.h"
#include "server/server.h"

namespace fb::host {

// All three must outlive the console's command.
void register_modcheck(con::Console& console, const fs::FileSystem& files, sv::Server& server);

}  // namespace fb::host
