// fullbright -dedicated: a server without client, window or device. Its console is the terminal.
#pragma once

#include "base/result.h"
#include "host/options.h"

namespace fb::host {

// Until `quit`, or until the program is told to end (base/stop.h). The exit status; fails where there is no game
// data or where the port is taken.
Result<int> run_dedicated(const GameOptions& options);

}  // namespace fb::host
