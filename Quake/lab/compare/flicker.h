// Flicker: how the error of pictures changes from frame to frame, along what moves.
#pragma once

#include <cstdint>
#include <vector>

#include "base/maths.h"
#include "lab/picture.h"

namespace fb::lab {

// What the camera sees through each pixel's centre; row-major. Nothing was hit where the depth is 0.
struct Guides {
  std::uint32_t width = 0, height = 0;
  std::vector<vec2> motion;                // to where the surface was in the former frame, pixels
  std::vector<float> depth, depth_before;  // along the view axis, units: now, and of this surface in the former frame
  std::vector<std::uint32_t> id;           // scene::Instance::id
  std::vector<float> emission;             // radiance towards the camera, luminance
  std::size_t pixels() const { return std::size_t{width} * height; }
};

// Flicker: root mean square, over pixels and channels, of the change of the error from one frame to the next:
//
//   (x(p) - x'(p + m)) - (r(p) - r'(p + m))
//
// with x the test, r the reference, both shown, ' the former frame (bilinear) and m the motion at p. Pixels count whose
// surface was in the former picture at that depth, to a tenth. A picture that is wrong but carries its error along with
// what it shows does not flicker. Not a number if no pixel counts.
struct ShownFrame {
  const Picture& reference;
  const Picture& test;
  const Guides& guides;
};
double flicker(const ShownFrame& former, const ShownFrame& now);

}  // namespace fb::lab
