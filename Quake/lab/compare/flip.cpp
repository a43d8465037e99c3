#include "lab/compare/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/check.h"
#include "base/parallel.h"

namespace fb::lab::flip {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kRowsPerThread = 16;

// Rec.709 primaries and D65 (x 0.3127, y 0.3290), luminance 1 for white. Rows give X, Y, Z.
constexpr double kToXyz[3][3] = {{0.4123907992659595, 0.357584339383878, 0.1804807884018343},
                                 {0.21263900587151036, 0.715168678767756, 0.07219231536073371},
                                 {0.01933081871559185, 0.11919477979462599, 0.9505321522496606}};

struct Matrices {
  glm::mat3 to_xyz{}, to_rgb{};
  vec3 white{};
  Matrices() {
    glm::dmat3 m;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) m[column][row] = kToXyz[row][column];
    to_xyz = glm::mat3(m);
    to_rgb = glm::mat3(glm::inverse(m));
    white = vec3(m * glm::dvec3(1.0));
  }
};
const Matrices& matrices() {
  static const Matrices made;
  return made;
}

// Exponents and thresholds of Andersson 2020.
constexpr float kColorExponent = 0.7f;          // q_c
constexpr float kKnee = 0.4f, kKneeTo = 0.95f;  // p_c, p_t
constexpr float kFeatureExponent = 0.5f;        // q_f
constexpr double kFeatureWidth = 0.082;         // w, degrees

// (k0 x^2 + k1 x + k2) / (k3 x^2 + k4 x + k5): Narkowicz's fit of ACES with its exposure factor of 0.6 multiplied in.
constexpr double kAces[6] = {0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};
constexpr double kShownAtLimit = 0.85;  // t of Andersson 2021

// Table 1: Gaussians a exp(-b f^2) over frequency f in cycles a degree; their transforms over degrees x are
// a sqrt(pi/b) exp(-pi^2 x^2 / b).
struct Gaussian {
  double a, b;
};
constexpr std::array<std::array<Gaussian, 2>, 3> kSensitivity{{
    {{{1.0, 0.0047}, {0.0, 1e-5}}},
    {{{1.0, 0.0053}, {0.0, 1e-5}}},
    {{{34.1, 0.04}, {13.5, 0.025}}},
}};

double sum(const Kernel& kernel) { return std::accumulate(kernel.begin(), kernel.end(), 0.0); }

using Plane = std::vector<float>;

// Edges are repeated outwards.
void convolve_rows(const Plane& in, Plane& out, std::uint32_t width, std::uint32_t height, const Kernel& kernel) {
  const int radius = static_cast<int>(kernel.size() / 2), w = static_cast<int>(width);
  parallel_for(height, kRowsPerThread, [&](std::size_t y) {
    std::vector<float> padded(width + kernel.size());
    const float* row = in.data() + y * width;
    for (int x = -radius; x < w + radius; ++x)
      padded[static_cast<std::size_t>(x + radius)] = row[std::clamp(x, 0, w - 1)];
    for (std::uint32_t x = 0; x < width; ++x) {
      float total = 0;
      for (std::size_t k = 0; k < kernel.size(); ++k) total += kernel[k] * padded[x + k];
      out[y * width + x] = total;
    }
  });
}

// Adds weight * (in convolved along columns) to out: row after row, so that memory is read in its order.
void add_columns(const Plane& in, Plane& out, std::uint32_t width, std::uint32_t height, const Kernel& kernel,
                 float weight) {
  const int radius = static_cast<int>(kernel.size() / 2), h = static_cast<int>(height);
  parallel_for(height, kRowsPerThread, [&](std::size_t y) {
    float* to = out.data() + y * width;
    for (int k = -radius; k <= radius; ++k) {
      const int from_row = std::clamp(static_cast<int>(y) + k, 0, h - 1);
      const float* from = in.data() + static_cast<std::size_t>(from_row) * width;
      const float factor = weight * kernel[static_cast<std::size_t>(k + radius)];
      for (std::uint32_t x = 0; x < width; ++x) to[x] += factor * from[x];
    }
  });
}

struct Filtered {
  std::uint32_t width, height;
  std::vector<vec3> lab;  // after the contrast sensitivity, Hunt-adjusted
  Plane edges, points;    // lengths of the features' gradients
};

std::vector<Plane> opponent_planes(const Picture& picture) {
  std::vector<Plane> planes(3, Plane(picture.pixels.size()));
  parallel_for(picture.height, kRowsPerThread, [&](std::size_t y) {
    for (std::size_t i = y * picture.width; i < (y + 1) * picture.width; ++i) {
      const vec3 value = linear_to_ycxcz(glm::clamp(picture.pixels[i], vec3(0.0f), vec3(1.0f)));
      for (int c = 0; c < 3; ++c) planes[static_cast<std::size_t>(c)][i] = value[c];
    }
  });
  return planes;
}

Plane length_of_gradient(const Plane& luminance, std::uint32_t width, std::uint32_t height, const Kernel& detect,
                         const Kernel& smooth) {
  Plane rows(luminance.size()), along_x(luminance.size(), 0.0f), along_y(luminance.size(), 0.0f);
  convolve_rows(luminance, rows, width, height, detect);
  add_columns(rows, along_x, width, height, smooth, 1.0f);
  convolve_rows(luminance, rows, width, height, smooth);
  add_columns(rows, along_y, width, height, detect, 1.0f);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = std::hypot(along_x[i], along_y[i]);
  return rows;
}

Filtered filter(const Picture& picture, double pixels_per_degree) {
  const std::uint32_t width = picture.width, height = picture.height;
  std::vector<Plane> planes = opponent_planes(picture);
  Filtered result{width, height, {}, {}, {}};

  Plane luminance = planes[0];
  for (float& y : luminance) y = (y + 16.0f) / 116.0f;  // 0..1
  const FeatureKernels kernels = feature_kernels(pixels_per_degree);
  result.edges = length_of_gradient(luminance, width, height, kernels.edge, kernels.smooth);
  result.points = length_of_gradient(luminance, width, height, kernels.point, kernels.smooth);

  Plane rows(luminance.size());
  for (int c = 0; c < 3; ++c) {
    Plane& plane = planes[static_cast<std::size_t>(c)];
    Plane filtered(plane.size(), 0.0f);
    for (const SensitivityTerm& term : sensitivity(c, pixels_per_degree)) {
      convolve_rows(plane, rows, width, height, term.kernel);
      add_columns(rows, filtered, width, height, term.kernel, term.weight);
    }
    plane = std::move(filtered);
  }
  result.lab.resize(luminance.size());
  parallel_for(height, kRowsPerThread, [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      const vec3 rgb = ycxcz_to_linear(vec3(planes[0][i], planes[1][i], planes[2][i]));
      result.lab[i] = linear_to_hunt_lab(glm::clamp(rgb, vec3(0.0f), vec3(1.0f)));
    }
  });
  return result;
}

std::vector<float> difference(const Filtered& a, const Filtered& b) {
  std::vector<float> map(a.lab.size());
  parallel_for(a.height, kRowsPerThread, [&](std::size_t y) {
    for (std::size_t i = y * a.width; i < (y + 1) * a.width; ++i) {
      const float color = redistribute(hyab(a.lab[i], b.lab[i]));
      const float feature = std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
      const float seen = std::pow(std::min(feature / std::numbers::sqrt2_v<float>, 1.0f), kFeatureExponent);
      map[i] = std::pow(color, 1.0f - seen);
    }
  });
  return map;
}

Picture exposed(const Picture& picture, double stops) {
  Picture shown = picture;
  const float factor = static_cast<float>(std::exp2(stops));
  parallel_for(shown.height, kRowsPerThread, [&](std::size_t y) {
    for (std::size_t i = y * shown.width; i < (y + 1) * shown.width; ++i)
      for (int c = 0; c < 3; ++c) shown.pixels[i][c] = aces(shown.pixels[i][c] * factor);
  });
  return shown;
}

}  // namespace

vec3 linear_to_ycxcz(const vec3& rgb) {
  const vec3 xyz = matrices().to_xyz * rgb / matrices().white;
  return {116.0f * xyz.y - 16.0f, 500.0f * (xyz.x - xyz.y), 200.0f * (xyz.y - xyz.z)};
}

vec3 ycxcz_to_linear(const vec3& v) {
  const float y = (v.x + 16.0f) / 116.0f;
  const vec3 relative(y + v.y / 500.0f, y, y - v.z / 200.0f);
  return matrices().to_rgb * (relative * matrices().white);
}

vec3 linear_to_hunt_lab(const vec3& rgb) {
  const vec3 xyz = matrices().to_xyz * rgb / matrices().white;
  const auto f = [](float t) {
    constexpr float delta = 6.0f / 29.0f;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
  };
  const vec3 root(f(xyz.x), f(xyz.y), f(xyz.z));
  const float lightness = 116.0f * root.y - 16.0f, hunt = 0.01f * lightness;
  return {lightness, hunt * 500.0f * (root.x - root.y), hunt * 200.0f * (root.y - root.z)};
}

float hyab(const vec3& lab1, const vec3& lab2) {
  return std::abs(lab1.x - lab2.x) + std::hypot(lab1.y - lab2.y, lab1.z - lab2.z);
}

float redistribute(float hyab_difference) {
  static const float largest =
      std::pow(hyab(linear_to_hunt_lab(vec3(0, 1, 0)), linear_to_hunt_lab(vec3(0, 0, 1))), kColorExponent);
  const float difference = std::pow(hyab_difference, kColorExponent), knee = kKnee * largest;
  if (difference < knee) return kKneeTo / knee * difference;
  return std::min(kKneeTo + (difference - knee) / (largest - knee) * (1.0f - kKneeTo), 1.0f);
}

float aces(float radiance) {
  const double x = std::max(radiance, 0.0f);
  if (!(x < 1e6)) return 1.0f;  // beyond every rounding, and squares stay finite
  const double y = (kAces[0] * x * x + kAces[1] * x + kAces[2]) / (kAces[3] * x * x + kAces[4] * x + kAces[5]);
  return static_cast<float>(std::clamp(y, 0.0, 1.0));
}

float aces_inverse(float shown) {
  const double a = kAces[0] - shown * kAces[3], b = kAces[1] - shown * kAces[4], c = kAces[2] - shown * kAces[5];
  return static_cast<float>((-b + std::sqrt(b * b - 4 * a * c)) / (2 * a));
}

std::vector<SensitivityTerm> sensitivity(int channel, double pixels_per_degree) {
  double widest = 0;
  for (const auto& terms : kSensitivity)
    for (const Gaussian& g : terms) widest = std::max(widest, g.b);
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * kPi * kPi)) * pixels_per_degree));
  std::vector<SensitivityTerm> result;
  double total = 0;
  for (const Gaussian& g : kSensitivity[static_cast<std::size_t>(channel)]) {
    if (g.a == 0) continue;
    SensitivityTerm term;
    double line = 0;
    for (int i = -radius; i <= radius; ++i) {
      const double degrees = i / pixels_per_degree, value = std::exp(-kPi * kPi * degrees * degrees / g.b);
      line += value;
      term.kernel.push_back(static_cast<float>(value));
    }
    for (float& k : term.kernel) k = static_cast<float>(k / line);
    const double volume = g.a * std::sqrt(kPi / g.b) * line * line;
    term.weight = static_cast<float>(volume);
    total += volume;
    result.push_back(std::move(term));
  }
  for (SensitivityTerm& term : result) term.weight = static_cast<float>(term.weight / total);
  return result;
}

FeatureKernels feature_kernels(double pixels_per_degree) {
  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  FeatureKernels kernels;
  for (int i = -radius; i <= radius; ++i) {
    const double g = std::exp(-i * i / (2 * sigma * sigma));
    kernels.smooth.push_back(static_cast<float>(g));
    kernels.edge.push_back(static_cast<float>(-i * g));
    kernels.point.push_back(static_cast<float>((i * i / (sigma * sigma) - 1) * g));
  }
  const double smooth = sum(kernels.smooth);
  for (float& k : kernels.smooth) k = static_cast<float>(k / smooth);
  for (Kernel* kernel : {&kernels.edge, &kernels.point}) {
    double positive = 0, negative = 0;
    for (const float k : *kernel) (k > 0 ? positive : negative) += k;
    for (float& k : *kernel) k = static_cast<float>(k > 0 ? k / positive : k == 0.0f ? 0.0 : -k / negative);
  }
  return kernels;
}

std::vector<float> ldr_flip(const Picture& reference, const Picture& test, double pixels_per_degree) {
  FB_CHECK(reference.same_size(test));
  if (reference.pixels.empty()) return {};
  return difference(filter(reference, pixels_per_degree), filter(test, pixels_per_degree));
}

Exposures choose_exposures(const Picture& reference) {
  std::vector<double> luminance(reference.pixels.size());
  std::transform(reference.pixels.begin(), reference.pixels.end(), luminance.begin(), [](const vec3& p) {
    const double y = kToXyz[1][0] * p.x + kToXyz[1][1] * p.y + kToXyz[1][2] * p.z;
    return std::isfinite(y) ? std::max(y, 0.0) : 0.0;
  });
  std::sort(luminance.begin(), luminance.end());
  if (luminance.empty() || luminance.back() <= 0) return {};
  const std::size_t half = luminance.size() / 2;
  double median = luminance.size() % 2 == 1 ? luminance[half] : 0.5 * (luminance[half - 1] + luminance[half]);
  if (median <= 0) median = luminance.back() * 0x1p-16;
  const double limit = aces_inverse(static_cast<float>(kShownAtLimit));
  Exposures result;
  result.start = std::log2(limit / luminance.back());
  result.stop = std::log2(limit / median);
  result.count = std::max(2, static_cast<int>(std::ceil(result.stop - result.start)));
  return result;
}

std::vector<float> hdr_flip(const Picture& reference, const Picture& test, const Exposures& exposures,
                            double pixels_per_degree) {
  std::vector<float> largest(reference.pixels.size(), 0.0f);
  for (int i = 0; i < exposures.count; ++i) {
    const double stops = exposures.at(i);
    const auto map = ldr_flip(exposed(reference, stops), exposed(test, stops), pixels_per_degree);
    for (std::size_t p = 0; p < map.size(); ++p) largest[p] = std::max(largest[p], map[p]);
  }
  return largest;
}

double mean_of(const std::vector<float>& map) {
  if (map.empty()) return 0;
  return std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
}

}  // namespace fb::lab::flip
