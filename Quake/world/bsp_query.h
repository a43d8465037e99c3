// Queries of a map's tree of nodes (hull 0): which leaf contains a point and what its contents are, which leafs see
// each other, and where a line first hits something solid. Positions are in the model's own space.
#pragma once

#include <cstdint>
#include <vector>

#include "base/maths.h"
#include "formats/bsp.h"

namespace fb::world {

// Index into Bsp::leafs. `model` selects the tree; a point on a plane counts as in front of it.
std::uint32_t point_in_leaf(const formats::Bsp& bsp, const vec3& point, std::uint32_t model = 0);

// CONTENTS_* at a point (formats::Contents); solid if a map has no leafs.
std::int32_t point_contents(const formats::Bsp& bsp, const vec3& point, std::uint32_t model = 0);

// Which leafs a leaf may see: element i is for leaf i. A leaf without data, a map without data, and leaf 0 (the solid
// one) see everything; truncated rows see nothing beyond their end.
std::vector<bool> leaf_visibility(const formats::Bsp& bsp, std::uint32_t leaf);

// Of a convex face, units^2.
double face_area(const formats::Bsp& bsp, const formats::BspFace& face);

struct LineHit {
  bool hit = false;          // the line went from open space into something solid
  float fraction = 1.0f;     // its position, 0 start to 1 end
  vec3 normal{0.0f};         // of the plane there, against the line
  bool start_solid = false;  // the line began in something solid
  bool all_solid = false;    // and never left it
};
// Finds the first transition from open space (anything but solid) into something solid.
LineHit trace_line(const formats::Bsp& bsp, const vec3& start, const vec3& end, std::uint32_t model = 0);

}  // namespace fb::world
