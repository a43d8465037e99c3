// What players do with what they ask for: Quake's sv_user.c. Their velocity changes here; physics() moves them.
#pragma once

#include "server/simulation/level.h"

namespace fb::sv {

// A client's last message, in units per second. Its angles, buttons and impulse are in the edict's fields.
struct UserCommand {
  float forward_move = 0.0f, side_move = 0.0f, up_move = 0.0f;
};

// SV_ClientThink, for the coming level.frame_time seconds: walking, swimming, flying, jumping out of water; the body's
// angles and the view's kick. Before physics().
void client_think(Level& level, EdictId id, const UserCommand& command);
// SV_SetIdealPitch: sets idealpitch to look along the stairs or slope ahead.
void set_ideal_pitch(Level& level, EdictId id);

}  // namespace fb::sv
