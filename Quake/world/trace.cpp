#include "world/trace.h"

#include <cmath>

namespace fb::world {
namespace {

using formats::kContentsEmpty;
using formats::kContentsSolid;

// Far beyond any map; differences of such numbers are finite.
bool is_reachable(const vec3& v) {
  constexpr float kFarthest = 1e9f;
  return std::fabs(v.x) <= kFarthest && std::fabs(v.y) <= kFarthest && std::fabs(v.z) <= kFarthest;
}

vec3 between(const vec3& from, const vec3& to, float fraction) {
  return {from.x + fraction * (to.x - from.x), from.y + fraction * (to.y - from.y),
          from.z + fraction * (to.z - from.z)};
}

class HullCheck {
 public:
  HullCheck(const Hull& hull, Trace& trace) : hull_(hull), trace_(trace) {}

  // Traces the segment from `from` at fraction from_f to `to` at to_f, below a node. Returns false once something was
  // hit. Recursion is at most as deep as the tree (formats::kMaxBspDepth); the far side of a plane is handled by the
  // loop.
  bool walk(std::int32_t node, float from_f, float to_f, vec3 from, const vec3& to) {
    while (node >= 0) {
      const HullNode& at = hull_.nodes[static_cast<std::size_t>(node)];
      const float d_from = hull_plane_distance(at, from), d_to = hull_plane_distance(at, to);
      if (d_from >= 0.0f && d_to >= 0.0f) {
        node = at.children[0];
        continue;
      }
      if (d_from < 0.0f && d_to < 0.0f) {
        node = at.children[1];
        continue;
      }
      const Crossing crossing{at, from_f, to_f, from, to, d_from < 0.0f ? 1u : 0u};
      if (++splits_ > kMaxTraceSplits) return stop(crossing, from_f, from);

      const float fraction = near_side_fraction(d_from, d_to);
      const float mid_f = from_f + (to_f - from_f) * fraction;
      const vec3 mid = between(from, to, fraction);
      if (!walk(at.children[crossing.near_side], from_f, mid_f, from, mid)) return false;
      const std::int32_t far = at.children[1 - crossing.near_side];
      if (hull_point_contents(hull_, far, mid) == kContentsSolid) return hit(crossing, fraction, mid_f, mid);
      node = far;
      from_f = mid_f;
      from = mid;
    }
    note_contents(node);
    return true;
  }

 private:
  struct Crossing {
    const HullNode& node;
    float from_f, to_f;
    const vec3& from;
    const vec3& to;
    std::size_t near_side;
  };

  // The fraction of the segment at which the plane is crossed, minus kDistEpsilon on the near side.
  static float near_side_fraction(float d_from, float d_to) {
    const double way = d_from - d_to;  // a difference of floats, rounded to one
    const double before = d_from < 0.0f ? d_from + kDistEpsilon : d_from - kDistEpsilon;
    const auto fraction = static_cast<float>(before / way);
    if (!(fraction >= 0.0f)) return 0.0f;  // also if a degenerate plane makes it NaN
    return fraction > 1.0f ? 1.0f : fraction;
  }

  void note_contents(std::int32_t contents) {
    if (contents == kContentsSolid) {
      trace_.start_solid = true;
      return;
    }
    trace_.all_solid = false;
    (contents == kContentsEmpty ? trace_.in_open : trace_.in_water) = true;
  }

  // The space beyond the plane is solid.
  bool hit(const Crossing& crossing, float fraction, float mid_f, vec3 mid) {
    if (trace_.all_solid) return false;  // still in the solid in which it started
    while (hull_point_contents(hull_, mid) == kContentsSolid) {
      fraction = static_cast<float>(fraction - 0.1);
      if (!(fraction >= 0.0f)) break;  // moved back before the segment: stays at the last step's position
      mid_f = crossing.from_f + (crossing.to_f - crossing.from_f) * fraction;
      mid = between(crossing.from, crossing.to, fraction);
    }
    return stop(crossing, mid_f, mid);
  }

  bool stop(const Crossing& crossing, float at_f, const vec3& at) {
    // Zero minus each component, so that no zero becomes negative.
    const HullNode& node = crossing.node;
    trace_.plane = crossing.near_side == 0 ? TracePlane{node.normal, node.distance}
                                           : TracePlane{vec3(0.0f) - node.normal, -node.distance};
    trace_.fraction = at_f;
    trace_.end_pos = at;
    return false;
  }

  const Hull& hull_;
  Trace& trace_;
  int splits_ = 0;
};

Trace clip_move(const Hull& hull, const vec3& offset, const Move& move) {
  Trace trace = trace_hull(hull, move.start - offset, move.end - offset);
  // Subtracting and adding the offset may round: a free move must end exactly at its target.
  trace.end_pos = trace.fraction == 1.0f ? move.end : trace.end_pos + offset;
  return trace;
}

}  // namespace

Trace trace_hull(const Hull& hull, const vec3& start, const vec3& end) {
  Trace trace;
  trace.all_solid = true;
  trace.end_pos = end;
  if (!is_reachable(start) || !is_reachable(end)) {
    trace.start_solid = true;
    trace.fraction = 0.0f;
    trace.end_pos = start;
    return trace;
  }
  HullCheck(hull, trace).walk(hull.first, 0.0f, 1.0f, start, end);
  return trace;
}

Trace clip_move_to_model(const MapHulls& map, std::uint32_t model, const vec3& origin, const Move& move) {
  const Hull hull = map.hull(model, hull_for_size(move.maxs - move.mins));
  // Aligns the corner of the box with that of the hull's own box.
  const vec3 offset = (hull.clip_mins - move.mins) + origin;
  return clip_move(hull, offset, move);
}

Trace clip_move_to_turned_model(const MapHulls& map, std::uint32_t model, const vec3& origin, const vec3& angles,
                                const Move& move) {
  const Hull hull = map.hull(model, hull_for_size(move.maxs - move.mins));
  const vec3 shift = hull.clip_mins - move.mins;
  const AxisVectors axes = angle_vectors(angles);
  const auto into_model = [&](const vec3& v) {
    const vec3 from_origin = v - origin;
    return vec3(dot(from_origin, axes.forward), -dot(from_origin, axes.right), dot(from_origin, axes.up)) - shift;
  };
  const auto turned = [&](const vec3& v) { return axes.forward * v.x - axes.right * v.y + axes.up * v.z; };
  Trace trace = trace_hull(hull, into_model(move.start), into_model(move.end));
  trace.end_pos = trace.fraction == 1.0f ? move.end : turned(trace.end_pos + shift) + origin;
  trace.plane.normal = turned(trace.plane.normal);
  return trace;
}

Trace clip_move_to_box(const vec3& origin, const vec3& box_mins, const vec3& box_maxs, const Move& move) {
  const BoxHull box(box_mins - move.maxs, box_maxs - move.mins);
  return clip_move(box.hull(), origin, move);
}

Bounds move_bounds(const Move& move) {
  Bounds bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const bool forward = move.end[axis] > move.start[axis];
    bounds.min[axis] = (forward ? move.start : move.end)[axis] + move.mins[axis] - 1.0f;
    bounds.max[axis] = (forward ? move.end : move.start)[axis] + move.maxs[axis] + 1.0f;
  }
  return bounds;
}

bool merge_trace(Trace& so_far, const Trace& next) {
  if (!next.all_solid && !next.start_solid && !(next.fraction < so_far.fraction)) return false;
  const bool started_solid = so_far.start_solid;
  so_far = next;
  so_far.start_solid |= started_solid;
  return true;
}

}  // namespace fb::world
