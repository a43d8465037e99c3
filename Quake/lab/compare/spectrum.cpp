#include "lab/compare/spectrum.h"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "base/check.h"
#include "shared/color.h"

namespace fb::lab {

Spectrum error_spectrum(const Picture& reference, const Picture& test) {
  FB_CHECK(reference.same_size(test));
  const std::size_t width = test.width, height = test.height, half = width / 2 + 1;
  Spectrum s;
  s.power.assign(kSpectrumBins, std::numeric_limits<double>::quiet_NaN());
  s.low_share = s.white = std::numeric_limits<double>::quiet_NaN();
  if (width * height == 0) return s;
  std::vector<double> error(width * height);
  for (std::size_t i = 0; i < error.size(); ++i)
    error[i] = double{shared::luminance(test.pixels[i])} - shared::luminance(reference.pixels[i]);
  std::vector<std::complex<double>> transformed(half * height);
  const fftw_plan plan =
      fftw_plan_dft_r2c_2d(static_cast<int>(height), static_cast<int>(width), error.data(),
                           reinterpret_cast<fftw_complex*>(transformed.data()), FFTW_ESTIMATE | FFTW_PRESERVE_INPUT);
  FB_CHECK(plan != nullptr);
  fftw_execute(plan);
  fftw_destroy_plan(plan);

  std::vector<double> sums(kSpectrumBins), counts(kSpectrumBins);
  double all = 0, low = 0, number = 0, low_number = 0;
  for (std::size_t y = 0; y < height; ++y) {
    const double v = static_cast<double>(std::min(y, height - y)) / static_cast<double>(height);
    for (std::size_t x = 0; x < half; ++x) {
      if (x == 0 && y == 0) continue;
      const double u = static_cast<double>(x) / static_cast<double>(width), frequency = std::hypot(u, v);
      // A real picture's other half is the mirror image of this one.
      const double times = x == 0 || 2 * x == width ? 1 : 2;
      const double power = times * std::norm(transformed[y * half + x]) / static_cast<double>(error.size());
      all += power;
      number += times;
      if (frequency <= kLowFrequency) {
        low += power;
        low_number += times;
      }
      const double bin = std::ceil(frequency * 2 * static_cast<double>(kSpectrumBins) - 1e-9) - 1;
      if (bin >= static_cast<double>(kSpectrumBins)) continue;  // towards the corners
      sums[static_cast<std::size_t>(std::max(bin, 0.0))] += power;
      counts[static_cast<std::size_t>(std::max(bin, 0.0))] += times;
    }
  }
  for (std::size_t i = 0; i < kSpectrumBins; ++i)
    if (counts[i] > 0) s.power[i] = sums[i] / counts[i];
  if (all > 0) s.low_share = low / all;
  if (number > 0) s.white = low_number / number;
  return s;
}

}  // namespace fb::lab
