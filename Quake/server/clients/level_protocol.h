// The protocol that a level is told in: sv_protocol's, but where 666 cannot say what the map is, 999, as newer engines
// begin with.
#pragma once

#include <string>

#include "console/cvar.h"
#include "net/protocol.h"
#include "server/simulation/level.h"

namespace fb::sv {

// What protocols 15 and 666 cannot say of a level, in words; empty: nothing. Numbers of models and sounds, and frames,
// which 15 alone cannot say, are told where they are left out (signon.h).
std::string beyond_short_protocols(const Level& level);

// Says what it chose if that is not what the cvar says, and what is lost where the cvar says 15.
net::Protocol protocol_for(const Level& level, const con::Cvar& sv_protocol);

}  // namespace fb::sv
