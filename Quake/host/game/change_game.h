// `game`: the program plays another game folder. It begins anew, so that nothing of the former folder is kept, with the
// aliases and cvars that it has; behind the new folder's configuration it goes on with the commands that followed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "console/console.h"
#include "fs/filesystem.h"
#include "host/options.h"

namespace fb::host {

struct NextStart {
  std::vector<std::string> arguments;  // the command line, without commands
  CarriedScripts carried;
};

// `options`: of this start. `begin_anew` is told to end it for the next one; nothing is left in the buffer then.
void register_game(con::Console& console, const fs::FileSystem& files, const GameOptions& options,
                   std::function<void(NextStart)> begin_anew);

}  // namespace fb::host
