// Where the probes of DDGI stand: a grid over the scene or, where that would need more than there may be, about the
// camera.
#pragma once

#include <array>

#include "base/maths.h"
#include "estimators/ddgi/ddgi.h"
#include "scene/snapshot.h"

namespace fb::render {

struct ProbeGrid {
  vec3 origin{0.0f}, spacing{1.0f};  // corner of cell 0, 0, 0; size of cells, of which each has a probe in its middle
  std::array<int, 3> first{}, count{1, 1, 1};
  std::uint32_t probes() const { return static_cast<std::uint32_t>(count[0] * count[1] * count[2]); }
  // Probes keep what they know from one to the other.
  bool goes_on_as(const ProbeGrid& next) const {
    return origin == next.origin && spacing == next.spacing && count == next.count;
  }
};

// `spacing`: at most, units; 0: the scene's box is divided evenly (Majercik 2022, Section 4). Along an axis on which
// probes suffice they stand evenly in `bounds`, along others so far apart about `camera`. An empty or infinite box has
// one probe at the camera.
ProbeGrid probe_grid(const Bounds& bounds, const vec3& camera, float spacing);

// What light falls on: the world, or where there is none all instances that paths see.
Bounds lit_bounds(const scene::FrameSnapshot& snapshot);

}  // namespace fb::render
