// What the movetypes are made of. For physics*.cpp; physics.h is what others use.
//
// Everything here may run QuakeC, which may remove what moves: ask edict.is_free() and level.failed() behind it.
#pragma once

#include "server/simulation/level.h"
#include "server/simulation/link.h"

namespace fb::sv {

// What stopped a move: bits of fly_move's answer.
constexpr int kBlockedFloor = 1, kBlockedStep = 2, kBlockedDead = 4;
// The least upward part of a floor's normal. A double, as it is compared with floats.
constexpr double kFloorNormal = 0.7;

// SV_RunThink: thinks if that is due within this frame. False: it is gone, or QuakeC failed.
bool run_think(Level& level, EdictId id);
// SV_Impact: both touch functions, first one's, then other's.
void impact(Level& level, EdictId one, EdictId other);
// SV_CheckVelocity.
void check_velocity(Level& level, Edict edict);
// SV_AddGravity.
void add_gravity(Level& level, Edict edict);
// ClipVelocity: without the part against the plane; overbounce 1 slides, 1.5 bounces.
vec3 clip_velocity(const vec3& in, const vec3& normal, float overbounce);
// SV_FlyMove: moves by its velocity, sliding along at most four things. Does not link. `step` becomes the last wall
// hit.
int fly_move(Level& level, EdictId id, float seconds, MoveTrace* step = nullptr);
// SV_PushEntity: moves and links without a change of velocity.
MoveTrace push_entity(Level& level, EdictId id, const vec3& push);
// SV_CheckWaterTransition: notes water and makes the splash.
void check_water_transition(Level& level, Edict edict);

// A frame of one edict of each kind.
void physics_pusher(Level& level, EdictId id);
void physics_toss(Level& level, EdictId id);
void physics_step(Level& level, EdictId id);
void physics_client(Level& level, EdictId id);
// The movetype is none that Quake knows: ends the level.
void fail_movetype(Level& level, EdictId id);

inline float frame_seconds(const Level& level) { return static_cast<float>(level.frame_time); }

}  // namespace fb::sv
