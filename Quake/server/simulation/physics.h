// A frame of the simulation: Quake's SV_Physics. Things think and move one after the other, in the order of their
// numbers; each sees what those before it have done and not what those behind it will do.
//
// The order and width of each operation is QuakeSpasm's on a processor with SSE, since demos, saves and scripts of
// players lean on them: times are doubles, fields are floats, and what mixes them is worked out in double.
#pragma once

#include <functional>

#include "server/simulation/level.h"

namespace fb::sv {

// Runs StartFrame, then every edict that was there as the frame began, for level.frame_time seconds from level.time
// on; then level.time is the end of the frame. Clients that are not active stand still. Where QuakeC fails the rest of
// the frame is left out (level.failed()). The caller keeps QuakeC's frametime and the machine's clock.
void physics(Level& level, const std::function<bool(EdictId)>& is_active_client);

}  // namespace fb::sv
