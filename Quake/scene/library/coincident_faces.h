// Maps draw a liquid's surface twice, once for each side, and cut the two differently; skies of maps that are not
// sealed have an inner and an outer side in one plane, too. Which of two coincident triangles a ray meets is chance: it
// stops twice at a liquid, or misses the triangle that light was looked for on. Here one surface shows on both sides:
// so what already has a face the other way round is cut off.
#pragma once

#include <cstdint>
#include <vector>

#include "base/maths.h"

namespace fb::scene {

struct MapFace {  // of a liquid or of a sky
  std::uint32_t texinfo, texture, plane;
  bool back_side;
  std::vector<vec3> polygon;  // convex, counter-clockwise about the face's front
  std::uint32_t number = 0;   // of the map's face
};

// Of every plane and texture the side with the larger area stays as it is; of the other side what is not covered.
std::vector<MapFace> without_coincident(std::vector<MapFace> faces);

// The parts of convex polygon `a` outside of convex polygon `b`, which lies in the same plane; `normal` is about which
// `b` runs counter-clockwise. Parts thinner than `tolerance` (units) are dropped.
std::vector<std::vector<vec3>> subtract_polygon(const std::vector<vec3>& a, const std::vector<vec3>& b,
                                                const vec3& normal, float tolerance);

double polygon_area(const std::vector<vec3>& polygon);

}  // namespace fb::scene
