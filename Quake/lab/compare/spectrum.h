// The error's power by spatial frequency: whether noise is white, or blue, which the eye and the denoiser forgive, or
// of low frequency: blotches.
#pragma once

#include <vector>

#include "lab/picture.h"

namespace fb::lab {

constexpr double kLowFrequency = 0.125;  // cycles a pixel: features of eight pixels and more
constexpr std::size_t kSpectrumBins = 32;

// Of luminance's error e = x - r (Rec.709 weights of the values as measured), without windowing, so that Parseval's
// theorem holds: the power density at a frequency is |E|^2 / pixels, with E the discrete Fourier transform of e, and
// its mean over all frequencies is the mean of e^2.
struct Spectrum {
  // Bin i holds frequencies (hypot of both axes) above i / 64 and up to (i + 1) / 64 cycles a pixel. The mean density
  // of those frequencies; not a number where the picture has none. Constant error is in none of them.
  std::vector<double> power;
  // Power at frequencies above 0 and up to kLowFrequency, over that at all above 0; NaN where there is none. `white` is
  // what it is for white noise: the share of the number of frequencies, about pi / 64 = 4.9%.
  double low_share = 0, white = 0;
};
// Both of one size.
Spectrum error_spectrum(const Picture& reference, const Picture& test);

}  // namespace fb::lab
