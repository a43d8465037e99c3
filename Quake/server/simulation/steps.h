// How monsters move, a step at a time: Quake's sv_move.c and the builtins on it. A step is up, forward and down onto
// what is there, and not done where there is nothing.
#pragma once

#include "server/simulation/level.h"

namespace fb::sv {

// Up or down a step by as much, units.
constexpr float kStepSize = 18.0f;

// SV_CheckBottom: whether all corners of the edict's box stand on something that is at most a step below its middle.
bool check_bottom(Level& level, EdictId id);
// SV_movestep. False: not moved. `relink` links, which touches triggers.
bool move_step(Level& level, EdictId id, const vec3& move, bool relink);
// SV_StepDirection: turns towards `yaw` (degrees) and steps there. True where the way was free, though a monster that
// has yet to turn by more than 45 degrees stays where it is.
bool step_direction(Level& level, EdictId id, float yaw, float distance);
// SV_NewChaseDir: another way to the goal.
void new_chase_dir(Level& level, EdictId id, EdictId goal, float distance);
// PF_changeyaw.
void change_yaw(Edict edict);

// QuakeC's movetogoal, walkmove (yaw in degrees; false: not moved) and droptofloor (false: there is none within 256
// units). Keep QuakeC's self and other.
void move_to_goal(Level& level, EdictId id, float distance);
bool walkmove(Level& level, EdictId id, float yaw, float distance);
bool drop_to_floor(Level& level, EdictId id);

}  // namespace fb::sv
