// What players may have in single player and coop: god, notarget, fly, noclip, give, setpos. Each acts on the player's
// edict and returns what to tell it, "" where nothing is to be said.
#pragma once

#include <string>
#include <string_view>

#include "console/args.h"
#include "server/simulation/level.h"

namespace fb::sv {

struct CheatCall {
  Level& level;
  EdictId player;
  const con::Args& args;
  bool mission_pack;  // !ClientsOptions::standard_quake
};
using Cheat = std::string (*)(const CheatCall& call);

// nullptr for what is no cheat.
Cheat find_cheat(std::string_view name);

}  // namespace fb::sv
