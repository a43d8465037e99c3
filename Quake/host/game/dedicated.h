// fullbright -dedicated: a server without client, window or GPU. Its console is the terminal.
#pragma once

#include <memory>
#include <optional>

#include "base/result.h"
#include "host/game/change_game.h"
#include "host/game/engine.h"
#include "host/options.h"
#include "host/game/terminal.h"

namespace fb::host {

// The engine with every command and cvar of a dedicated server but `quit`. Fails as run_dedicated().
Result<std::unique_ptr<Engine>> assemble_dedicated(const GameOptions& options);
// Runs until `quit` or `game`, which sets `next`, or until the program is told to end (base/stop.h). Returns the exit
// status; fails if there is no game data or the port is in use.
Result<int> run_dedicated(const GameOptions& options, TerminalLines& terminal, std::optional<NextStart>& next);

}  // namespace fb::host
