// Errors whose spectrum is known.
#include "lab/compare/spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/rng.h"

namespace fb::lab {
namespace {

Picture grey(std::uint32_t width, std::uint32_t height, const std::function<double(int x, int y)>& value) {
  Picture picture{width, height, {}};
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      picture.pixels.push_back(vec3(static_cast<float>(value(static_cast<int>(x), static_cast<int>(y)))));
  return picture;
}
Spectrum of_error(std::uint32_t width, std::uint32_t height, const std::function<double(int x, int y)>& error) {
  return error_spectrum(grey(width, height, [](int, int) { return 0.0; }), grey(width, height, error));
}
double wave(int x, int waves, int of) { return std::cos(2 * std::numbers::pi * waves * x / of); }

// How many frequencies of a picture are in (low, high].
int frequencies(int width, int height, double low, double high) {
  int count = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double f = std::hypot(std::min(x, width - x) / double(width), std::min(y, height - y) / double(height));
      count += f > low + 1e-12 && f <= high + 1e-12;
    }
  return count;
}

TEST(Spectrum, AWaveIsInItsBin) {
  const Spectrum s = of_error(64, 32, [](int x, int) { return 0.5 * wave(x, 4, 64); });
  EXPECT_NEAR(s.low_share, 1, 1e-9);
  // Both signs of it have (0.5 pixels / 2)^2 / pixels; the bin's other frequencies nothing.
  const double expected = 2 * 0.25 * 64 * 32 / 4 / frequencies(64, 32, 3.0 / 64, 4.0 / 64);
  for (std::size_t i = 0; i < kSpectrumBins; ++i) {
    if (!std::isnan(s.power[i])) {
      EXPECT_NEAR(s.power[i], i == 3 ? expected : 0, 1e-4) << i;
    }
  }
  EXPECT_NEAR(of_error(64, 32, [](int, int y) { return wave(y, 10, 32); }).low_share, 0, 1e-9);
  // Of two waves each has its square.
  const auto two = [](int x, int) { return 0.3 * wave(x, 8, 64) + 0.1 * wave(x, 20, 64); };
  EXPECT_NEAR(of_error(64, 32, two).low_share, 0.9, 1e-6) << "at the limit itself still low";
}

TEST(Spectrum, APointIsExactlyWhite) {
  for (const auto& [width, height] : {std::pair(64, 32), std::pair(45, 31), std::pair(7, 50)}) {
    const Spectrum s = of_error(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                                [](int x, int y) { return x == 3 && y == 5 ? 2.0 : 0.0; });
    EXPECT_NEAR(s.low_share, s.white, 1e-9);
    EXPECT_NEAR(s.white, frequencies(width, height, 0, kLowFrequency) / (width * height - 1.0), 1e-12);
    for (const double p : s.power) {
      if (!std::isnan(p)) {
        EXPECT_NEAR(p, 4.0 / (width * height), 1e-9);
      }
    }
  }
}

TEST(Spectrum, WhiteNoiseIsWhiteAndItsDifferencesAreBlue) {
  Rng rng(1);
  std::vector<double> noise(128 * 128);
  for (double& v : noise) v = rng.uniform(-1.0f, 1.0f);
  const auto at = [&](int x, int y) { return noise[static_cast<std::size_t>((y % 128) * 128 + x % 128)]; };
  const Spectrum white = of_error(128, 128, at);
  // About 400 independent powers, each as wide as its mean.
  EXPECT_NEAR(white.low_share, white.white, 4 * white.white / 20);
  const Spectrum blue = of_error(128, 128, [&](int x, int y) {
    return at(x, y) - (at(x + 1, y) + at(x, y + 1) + at(x + 127, y) + at(x, y + 127)) / 4;
  });
  EXPECT_LT(blue.low_share, 0.1 * blue.white);
}

TEST(Spectrum, AConstantErrorHasNone) {
  EXPECT_TRUE(std::isnan(of_error(16, 16, [](int, int) { return 0.0; }).low_share));
  EXPECT_TRUE(std::isnan(error_spectrum(Picture(), Picture()).low_share));
}

}  // namespace
}  // namespace fb::lab
