// What is left between a map's light and its baked light once every emitter has its power: a factor by place and side,
// smooth over some metres. Baked light falls off, adds up and reflects by rules of its own; no powers of lamps bring
// all of it.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/authored/light_transport.h"

namespace fb::scene {

// Cells of a box, each with a factor for surfaces that face each of six ways (+x -x +y -y +z -z), as
// shared/gain_field.h reads it.
struct GainField {
  vec3 origin{0.0f};  // of the first cell's corner
  float side = 1.0f;  // of a cell, units
  std::uint32_t width = 0, depth = 0, height = 0;
  std::vector<std::uint32_t> cells;  // x fastest, then y, then z, then the way: rgb9e5; 0: nothing is known
  bool empty() const { return cells.empty(); }
};

// `light`: of the points by the fitted emitters (light_at).
GainField make_gain_field(const formats::Bsp& bsp, const std::vector<LuxelPoint>& points,
                          const std::vector<vec3>& light);

}  // namespace fb::scene
