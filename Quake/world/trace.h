// Moves a point or a box along a line until something solid stops it: Quake's SV_RecursiveHullCheck and the related
// parts of SV_ClipMoveToEntity and SV_Move, equal to the bit to QuakeSpasm on a processor with SSE. Known oddities are
// kept, because players' jumps and monsters' steps depend on them (Misc/QUIRKS.md):
// - the end is 1/32 of a unit before the plane that was hit, measured along the plane's normal;
// - a line that starts in solid and leaves it is start_solid and may still hit something;
// - one that never leaves it is all_solid, with fraction 1 and the whole way completed;
// - if rounding puts the end into solid all the same, it is moved back by a tenth of the segment at a time.
#pragma once

#include "base/maths.h"
#include "world/hull.h"

namespace fb::world {

// How far before a plane a move ends, in units; a double, so that what is computed with it is.
constexpr double kDistEpsilon = 0.03125;

struct TracePlane {
  vec3 normal{0.0f};  // towards the line's start
  float distance = 0.0f;
};
struct Trace {
  bool all_solid = false;    // the line was in solid throughout
  bool start_solid = false;  // it was in solid other than at the impact: usually at its start
  bool in_open = false;      // it was in empty space somewhere
  bool in_water = false;     // or in other contents that are not solid
  float fraction = 1.0f;     // of the line, 1: nothing was hit
  vec3 end_pos{0.0f};
  TracePlane plane;  // what was hit, if fraction < 1
};

// Traces a point through a hull, in the hull's space. Handles at most kMaxTraceSplits planes that the line crosses, so
// that no map can stall the game; a line that needs more ends there. A start or end that is not finite gives all_solid
// and no movement.
constexpr int kMaxTraceSplits = 1 << 14;
Trace trace_hull(const Hull& hull, const vec3& start, const vec3& end);

// Moves a box from start to end. The origin of the box moves; mins and maxs are relative to it.
struct Move {
  vec3 start{0.0f}, mins{0.0f}, maxs{0.0f}, end{0.0f};
};

// Traces against a model of a map at `origin` (SOLID_BSP; angles affect the picture, not collisions). The hull is
// chosen by the box's width, so a box of another size is treated as the hull's own.
Trace clip_move_to_model(const MapHulls& map, std::uint32_t model, const vec3& origin, const Move& move);
// The same for a model rotated about its origin, as it is drawn (base/maths.h, entity_transform). The moving box stays
// aligned with the map's axes, and is approximated by the hull's own box aligned with the model's.
Trace clip_move_to_turned_model(const MapHulls& map, std::uint32_t model, const vec3& origin, const vec3& angles,
                                const Move& move);
// Traces against another box (SOLID_BBOX, SOLID_SLIDEBOX).
Trace clip_move_to_box(const vec3& origin, const vec3& box_mins, const vec3& box_maxs, const Move& move);

// The box that a move sweeps, enlarged by a unit on each side (SV_MoveBounds).
Bounds move_bounds(const Move& move);

// Merges the trace against another entity into the result so far, as SV_ClipToLinks does; returns true if that entity
// is now the one hit. A move that is all_solid already tests no further entities.
bool merge_trace(Trace& so_far, const Trace& next);

}  // namespace fb::world
