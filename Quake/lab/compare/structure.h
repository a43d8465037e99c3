// Structural similarity: SSIM (Wang 2004) and MS-SSIM (Wang 2003) of the luma (Rec.709 weights) of pictures as a screen
// shows them: sRGB values, 0 to 1. 1 is equality; lower is worse.
#pragma once

#include <vector>

#include "lab/picture.h"

namespace fb::lab {

// A picture of one channel.
struct Plane {
  std::size_t width = 0, height = 0;
  std::vector<double> values;  // row-major
};
Plane luma_of(const Picture& picture);

// Means over all windows of 11x11 that lie in the picture, weighted by a Gaussian of 1.5 pixels: of SSIM, and of its
// factor of contrast and structure alone. K1 = 0.01, K2 = 0.03, the range is 1. Not numbers where no window fits.
struct Similarity {
  double ssim = 0, contrast_structure = 0;
};
Similarity similarity(const Plane& reference, const Plane& test);

double ssim(const Picture& reference, const Picture& test);
// Five scales, each half the former by means of 2x2 pixels; a last odd row or column is left out. A negative factor of
// contrast and structure counts as 0, where the paper's power has no value. Not a number below 176 pixels a side, where
// the fifth scale holds no window.
double ms_ssim(const Picture& reference, const Picture& test);

}  // namespace fb::lab
