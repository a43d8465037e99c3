#include "lab/compare/structure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "shared/color.h"

namespace fb::lab {
namespace {

constexpr std::size_t kWindow = 11;
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
constexpr std::array<double, 5> kScaleWeights{0.0448, 0.2856, 0.3001, 0.2363, 0.1333};  // Wang 2003, Section 3.2

std::array<double, kWindow> gaussian() {
  std::array<double, kWindow> weights{};
  double sum = 0;
  for (std::size_t i = 0; i < kWindow; ++i) {
    const double x = static_cast<double>(i) - static_cast<double>(kWindow / 2);
    sum += weights[i] = std::exp(-x * x / (2 * 1.5 * 1.5));
  }
  for (double& w : weights) w /= sum;
  return weights;
}

// Weighted means of the products of two planes over every window; of one plane if `b` is null.
std::vector<double> window_means(const Plane& a, const Plane* b) {
  static const std::array<double, kWindow> weights = gaussian();
  const std::size_t columns = a.width - kWindow + 1, rows = a.height - kWindow + 1;
  std::vector<double> across(columns * a.height), means(columns * rows);
  for (std::size_t y = 0; y < a.height; ++y)
    for (std::size_t x = 0; x < columns; ++x)
      for (std::size_t k = 0; k < kWindow; ++k) {
        const std::size_t at = y * a.width + x + k;
        across[y * columns + x] += weights[k] * a.values[at] * (b != nullptr ? b->values[at] : 1.0);
      }
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t k = 0; k < kWindow; ++k)
      for (std::size_t x = 0; x < columns; ++x) means[y * columns + x] += weights[k] * across[(y + k) * columns + x];
  return means;
}

Plane halved(const Plane& plane) {
  Plane half{plane.width / 2, plane.height / 2, {}};
  half.values.reserve(half.width * half.height);
  for (std::size_t y = 0; y < half.height; ++y)
    for (std::size_t x = 0; x < half.width; ++x) {
      const double* p = &plane.values[2 * y * plane.width + 2 * x];
      half.values.push_back((p[0] + p[1] + p[plane.width] + p[plane.width + 1]) / 4);
    }
  return half;
}

}  // namespace

Plane luma_of(const Picture& picture) {
  Plane plane{picture.width, picture.height, std::vector<double>(picture.pixels.size())};
  std::transform(picture.pixels.begin(), picture.pixels.end(), plane.values.begin(), shared::luminance);
  return plane;
}

Similarity similarity(const Plane& reference, const Plane& test) {
  FB_CHECK(reference.width == test.width && reference.height == test.height);
  if (test.width < kWindow || test.height < kWindow) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none};
  }
  const std::vector<double> r = window_means(reference, nullptr), t = window_means(test, nullptr),
                            rr = window_means(reference, &reference), tt = window_means(test, &test),
                            rt = window_means(reference, &test);
  Similarity sum;
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double variance_r = rr[i] - r[i] * r[i], variance_t = tt[i] - t[i] * t[i], both = rt[i] - r[i] * t[i];
    const double contrast_structure = (2 * both + kC2) / (variance_r + variance_t + kC2);
    sum.contrast_structure += contrast_structure;
    sum.ssim += contrast_structure * (2 * r[i] * t[i] + kC1) / (r[i] * r[i] + t[i] * t[i] + kC1);
  }
  const double n = static_cast<double>(r.size());
  return {sum.ssim / n, sum.contrast_structure / n};
}

double ssim(const Picture& reference, const Picture& test) {
  return similarity(luma_of(reference), luma_of(test)).ssim;
}

double ms_ssim(const Picture& reference, const Picture& test) {
  Plane r = luma_of(reference), t = luma_of(test);
  double product = 1;
  for (std::size_t scale = 0; scale < kScaleWeights.size(); ++scale) {
    if (scale > 0) {
      r = halved(r);
      t = halved(t);
    }
    const Similarity s = similarity(r, t);
    const double factor = scale + 1 == kScaleWeights.size() ? s.ssim : s.contrast_structure;
    if (std::isnan(factor)) return factor;
    product *= std::pow(std::max(factor, 0.0), kScaleWeights[scale]);
  }
  return product;
}

}  // namespace fb::lab
