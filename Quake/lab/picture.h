// Picture: linear Rec.709 radiance in memory, what the metrics compare; Reference: one whose own uncertainty is known.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/maths.h"
#include "base/result.h"

namespace fb::lab {

struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<vec3> pixels;  // row-major, top row first
  bool same_size(const Picture& other) const { return width == other.width && height == other.height; }
};

struct Reference {
  Picture mean;
  std::vector<vec3> variance;  // of each pixel's mean; empty: unknown
};

}  // namespace fb::lab
