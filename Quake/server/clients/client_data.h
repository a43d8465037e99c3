// What a player is told of itself: svc_clientdata, and what hit it (SV_WriteClientdataToMessage).
#pragma once

#include "net/server_messages.h"
#include "server/simulation/level.h"

namespace fb::sv {

net::svc::ClientData client_data(Level& level, EdictId player, bool standard_quake);

// Damage, a turned head (fixangle) and the above, in Quake's order; what was told is reset in the edict.
// `standard_quake`: as in ClientsOptions.
void write_client_data(net::MessageWriter& writer, Level& level, EdictId player, bool standard_quake);

}  // namespace fb::sv
