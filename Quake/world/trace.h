// Moving a point, or a box, along a line until something solid stops it: Quake's SV_RecursiveHullCheck and what
// SV_ClipMoveToEntity and SV_Move do around it, to the bit as QuakeSpasm on a processor with SSE. Known oddities are
// kept, because players' jumps and monsters' steps lean on them (Misc/QUIRKS.md):
// - the end lies 1/32 of a unit before the plane that was hit, measured along the plane's normal;
// - a line that starts in solid and leaves it is start_solid and may go on to hit something;
// - one that never leaves it is all_solid, with fraction 1 and the whole way gone;
// - where rounding puts the end into solid all the same, it is drawn back by a tenth of the piece at a time.
#pragma once

#include "base/maths.h"
#include "world/hull.h"

namespace fb::world {

struct TracePlane {
  vec3 normal{0.0f};  // towards where the line came from
  float distance = 0.0f;
};
struct Trace {
  bool all_solid = false;    // the line never left something solid
  bool start_solid = false;  // it met something solid that is not the impact: mostly, it started there
  bool in_open = false;      // it was in empty space somewhere
  bool in_water = false;     // or in anything else that is not solid
  float fraction = 1.0f;     // of the way, 1: nothing was hit
  vec3 end_pos{0.0f};
  TracePlane plane;  // what was hit, if fraction < 1
};

// A point through a hull, in the hull's space. Takes at most kMaxTraceSplits planes that the line crosses, so that no
// map can hold up the game; a line that needs more ends there. A start or end that is not finite is all_solid and
// stays.
constexpr int kMaxTraceSplits = 1 << 14;
Trace trace_hull(const Hull& hull, const vec3& start, const vec3& end);

// A box from mins to maxs, moved from start to end. The origin of the box moves; mins and maxs are relative to it.
struct Move {
  vec3 start{0.0f}, mins{0.0f}, maxs{0.0f}, end{0.0f};
};

// Against a model of a map that stands at `origin` (SOLID_BSP: angles turn what is seen, not what is hit). The
// hull is chosen by the box's width, so other boxes than the hull's own are taken as if they were that.
Trace clip_move_to_model(const MapHulls& map, std::uint32_t model, const vec3& origin, const Move& move);
// The same of a model that is turned about its origin, as it is drawn (base/maths.h, entity_transform). The moving box
// stays along the axes of the map, and is taken to be the hull's own box along those of the model.
Trace clip_move_to_turned_model(const MapHulls& map, std::uint32_t model, const vec3& origin, const vec3& angles,
                                const Move& move);
// Against another box (SOLID_BBOX, SOLID_SLIDEBOX).
Trace clip_move_to_box(const vec3& origin, const vec3& box_mins, const vec3& box_maxs, const Move& move);

// The box that a move sweeps, one unit wider on each side (SV_MoveBounds).
Bounds move_bounds(const Move& move);

// Takes one more thing's trace into what a move has met so far, as SV_ClipToLinks does; true if that thing is now what
// was hit. A move that is all_solid already asks no further things.
bool merge_trace(Trace& so_far, const Trace& next);

}  // namespace fb::world
