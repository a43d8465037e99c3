// The command `fog`, typed by a player or stuffed by a server. Its numbers are QuakeSpasm's:
//   fog <density> [seconds]                      the colour stays; the change takes this long
//   fog <red> <green> <blue>                     the density stays
//   fog <density> <red> <green> <blue> [seconds]
// Six and more are DarkPlaces': density, colour, then an opacity, distances and heights, which mean nothing here.
#pragma once

#include <string>

#include "base/result.h"
#include "client/session/state.h"

namespace fb::con {
class Args;
}

namespace fb::cl {

// What denser fog is taken for: at about 770 the medium's extinction has come to its own limit.
constexpr float kDensestFog = 1000.0f;

// Changes the fog as the words after the command say, and returns what is to be printed: without words usage and the
// present fog, else nothing. Densities are held to 0 to kDensestFog, colours to 0 to 1, a time below 0 is none; of a
// word the number at its start counts, as to Quake. Error, and no change: a word that does not begin with a number.
Result<std::string> fog_command(ClientState& state, const con::Args& args);

}  // namespace fb::cl
