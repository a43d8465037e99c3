// Where edicts are, and what a move through the level meets: Quake's world.c above the hulls. An edict that moves must
// be linked again before anything asks for it; what links or moves may call QuakeC's touch functions, so whoever calls
// looks whether the edict is still there, and at level.failed().
#pragma once

#include <optional>

#include "server/simulation/level.h"
#include "world/trace.h"

namespace fb::sv {

// SV_LinkEdict: sets absmin and absmax (one unit wider than the box, since moves end before what they hit; items 15
// units to the sides, since they are easier to pick up), the leafs that it is in, and puts it into its area.
// `touch_triggers`: calls the touch functions of the triggers that it is in.
void link_edict(Level& level, EdictId id, bool touch_triggers = false);
// Where an edict was linked: absmin and absmax.
Bounds linked_box(const Edict& edict);
// SV_UnlinkEdict.
void unlink_edict(Level& level, EdictId id);
// SV_TouchLinks, for what is linked.
void touch_links(Level& level, EdictId id);

struct MoveTrace : world::Trace {
  std::optional<EdictId> edict;  // what was hit, or what the move started in
};
// SV_Move. `pass` itself is not met, nor what it owns, nor its owner. Nothing and the world are different: nothing is
// owned by nothing, but who has no owner is owned by the world (Misc/QUIRKS.md).
MoveTrace sv_move(Level& level, const world::Move& move, MoveKind kind, std::optional<EdictId> pass);
// The same of the edict's own box, from its origin, passing itself.
MoveTrace move_edict(Level& level, EdictId id, const vec3& end, MoveKind kind = MoveKind::kNormal);

// SV_TestEntityPosition: whether an edict stands in something solid.
bool in_solid(Level& level, EdictId id);
// SV_PointContents: formats::Contents, currents as water; with what brush models hold (skin_contents.h).
std::int32_t point_contents(Level& level, const vec3& point);

// The brush model that an edict has; null where its model is of another kind, or none.
const BrushModel* brush_model_of(const Level& level, const Edict& edict);
// A move against that model where the edict stands, turned where that counts.
world::Trace clip_move_to_brush_model(const Level& level, const Edict& edict, const BrushModel& model,
                                      const world::Move& move);

}  // namespace fb::sv
