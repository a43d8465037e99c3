#include "lab/judge/frame_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/check.h"
#include "base/rng.h"
#include "lab/compare/flip.h"
#include "lab/statistics.h"
#include "shared/color.h"
#include "shared/tone.h"

namespace fb::lab {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

std::vector<float> lumas(const Picture& picture) {
  std::vector<float> values(picture.pixels.size());
  std::transform(picture.pixels.begin(), picture.pixels.end(), values.begin(), shared::luminance);
  return values;
}

// 1 / depth: linear on the screen over a plane. What lies beyond everything is infinitely far.
float inverse_depth(float depth) { return depth > 0 ? 1 / depth : 0.0f; }

bool bends(float before, float here, float after) {
  return std::abs(before + after - 2 * here) > 0.1f * std::max({before, here, after});
}

}  // namespace

double relative_epsilon(const Picture& reference) {
  std::vector<double> values;
  values.reserve(3 * reference.pixels.size());
  for (const vec3& p : reference.pixels) values.insert(values.end(), {p.x, p.y, p.z});
  if (values.empty()) return std::numeric_limits<float>::min();
  const auto cut = values.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), cut, values.end());
  const double most = *cut;
  for (double& v : values) v = std::min(v, most);
  const double scale = 0.1 * mean(values);
  return std::max<double>(scale * scale, std::numeric_limits<float>::min());  // a black picture has no scale
}

double trimmed_rel_mse(const Reference& reference, const Picture& test, double epsilon) {
  FB_CHECK(reference.mean.same_size(test));
  struct Error {
    double all = 0, noise = 0;  // noise: the reference's share
  };
  std::vector<Error> errors(test.pixels.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const vec3 x = finite(test.pixels[i]) ? test.pixels[i] : vec3(0.0f);
    for (int c = 0; c < 3; ++c) {
      const double r = reference.mean.pixels[i][c], scale = 3 * (r * r + epsilon);
      errors[i].all += (x[c] - r) * (x[c] - r) / scale;
      if (!reference.variance.empty()) errors[i].noise += reference.variance[i][c] / scale;
    }
  }
  const auto top = std::lround(kTopPixels * static_cast<double>(errors.size()));
  const std::size_t kept = errors.size() - static_cast<std::size_t>(std::max(top, 1l));
  if (kept == 0 || kept > errors.size()) return 0;
  const auto cut = errors.begin() + static_cast<std::ptrdiff_t>(kept);
  std::nth_element(errors.begin(), cut, errors.end(), [](const Error& a, const Error& b) { return a.all < b.all; });
  const double sum =
      std::accumulate(errors.begin(), cut, 0.0, [](double s, const Error& e) { return s + e.all - e.noise; });
  return sum / static_cast<double>(kept);
}

Picture shown(const Picture& linear, double exposure, bool tone_map) {
  Picture picture = linear;
  for (vec3& p : picture.pixels) {
    p *= static_cast<float>(exposure);
    p = shared::srgb_from_linear(tone_map ? shared::filmic(p) : p);
  }
  return picture;
}

double lag(const Picture& two_frames_ago, const Picture& now, const Picture& test) {
  FB_CHECK(now.same_size(test));
  FB_CHECK(now.same_size(two_frames_ago));
  constexpr std::uint32_t kSide = 8;
  constexpr double kChanged = 0.25;
  double missing = 0, changed = 0;
  for (std::uint32_t y = 0; y + kSide <= now.height; y += kSide) {
    for (std::uint32_t x = 0; x + kSide <= now.width; x += kSide) {
      const auto light = [&](const Picture& picture) {
        double sum = 0;
        for (std::uint32_t i = 0; i < kSide * kSide; ++i) {
          const vec3 p = picture.pixels[static_cast<std::size_t>(y + i / kSide) * now.width + x + i % kSide];
          if (finite(p)) sum += static_cast<double>(p.x + p.y + p.z);
        }
        return sum;
      };
      const double before = light(two_frames_ago), is = light(now), change = is - before;
      if (std::abs(change) <= kChanged * std::max(before, is)) continue;
      missing += (is - light(test)) * (change > 0 ? 1 : -1);
      changed += std::abs(change);
    }
  }
  return changed > 0 ? missing / changed : std::numeric_limits<double>::quiet_NaN();
}

IsolatedPixels isolated_pixels(const Picture& reference, const Picture& test) {
  FB_CHECK(reference.same_size(test));
  const std::vector<float> truth = lumas(reference), luma = lumas(test);
  const auto width = static_cast<int>(test.width), height = static_cast<int>(test.height);
  IsolatedPixels count;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * test.width + static_cast<std::size_t>(x);
      const float error = luma[at] - truth[at];
      if (std::abs(error) <= kIsolated) continue;
      float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
      for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, height - 1); ++ny) {
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, width - 1); ++nx) {
          if (nx == x && ny == y) continue;
          const float near = luma[static_cast<std::size_t>(ny) * test.width + static_cast<std::size_t>(nx)];
          low = std::min(low, near);
          high = std::max(high, near);
        }
      }
      if (error < 0 && luma[at] + kIsolated < low) ++count.dark;
      if (error > 0 && luma[at] - kIsolated > high) ++count.bright;
    }
  }
  return count;
}

std::vector<bool> silhouettes(const Guides& g) {
  std::vector<bool> edges(g.pixels(), false);
  // Along rows (step 1) and columns (step width).
  const auto mark = [&](std::size_t at, std::size_t step, bool has_before, bool has_after) {
    if ((has_before && g.id[at - step] != g.id[at]) || (has_after && g.id[at + step] != g.id[at])) edges[at] = true;
    if (has_before && has_after &&
        bends(inverse_depth(g.depth[at - step]), inverse_depth(g.depth[at]), inverse_depth(g.depth[at + step])))
      edges[at] = true;
  };
  for (std::uint32_t y = 0; y < g.height; ++y) {
    for (std::uint32_t x = 0; x < g.width; ++x) {
      const std::size_t at = std::size_t{y} * g.width + x;
      mark(at, 1, x > 0, x + 1 < g.width);
      mark(at, g.width, y > 0, y + 1 < g.height);
    }
  }
  return edges;
}

std::vector<bool> interior(const Guides& g) {
  std::vector<bool> edges = silhouettes(g);
  const auto part = [&](std::size_t a, std::size_t b) {
    if (std::abs(g.emission[a] - g.emission[b]) > 0.1f * std::max(g.emission[a], g.emission[b]))
      edges[a] = edges[b] = true;
  };
  for (std::uint32_t y = 0; y < g.height; ++y) {
    for (std::uint32_t x = 0; x < g.width; ++x) {
      const std::size_t at = std::size_t{y} * g.width + x;
      if (x > 0) part(at, at - 1);
      if (y > 0) part(at, at - g.width);
    }
  }
  std::vector<bool> inside(g.pixels(), true);
  for (std::uint32_t y = 0; y < g.height; ++y)
    for (std::uint32_t x = 0; x < g.width; ++x)
      for (std::uint32_t ny = y - std::min(y, 1u); ny <= std::min(y + 1, g.height - 1); ++ny)
        for (std::uint32_t nx = x - std::min(x, 1u); nx <= std::min(x + 1, g.width - 1); ++nx)
          if (edges[std::size_t{ny} * g.width + nx]) inside[std::size_t{y} * g.width + x] = false;
  return inside;
}

Picture pixels_where(const Picture& picture, const std::vector<bool>& chosen) {
  FB_CHECK_EQ(picture.pixels.size(), chosen.size());
  Picture row{0, 1, {}};
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (chosen[i]) row.pixels.push_back(picture.pixels[i]);
  row.width = static_cast<std::uint32_t>(row.pixels.size());
  return row;
}

Reference pixels_where(const Reference& reference, const std::vector<bool>& chosen) {
  Reference row{pixels_where(reference.mean, chosen), {}};
  for (std::size_t i = 0; i < reference.variance.size(); ++i)
    if (chosen[i]) row.variance.push_back(reference.variance[i]);
  return row;
}

double mean_where(const std::vector<float>& map, const std::vector<bool>& chosen) {
  FB_CHECK_EQ(map.size(), chosen.size());
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    if (!chosen[i]) continue;
    sum += map[i];
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : kNoValue;
}

double reference_flip(const Reference& reference, double exposure, bool tone_map) {
  if (reference.variance.empty()) return kNoValue;
  Picture again = reference.mean;
  Rng rng(1);
  for (std::size_t i = 0; i < again.pixels.size(); ++i) {
    // Box and Muller 1958.
    const float radius = std::sqrt(-2 * std::log(1 - rng.uniform(0.0f, 1.0f)));
    const float normal = radius * std::cos(2 * std::numbers::pi_v<float> * rng.uniform(0.0f, 1.0f));
    for (int c = 0; c < 3; ++c)
      again.pixels[i][c] = std::max(0.0f, again.pixels[i][c] + normal * std::sqrt(reference.variance[i][c]));
  }
  return flip::mean_of(
      flip::ldr_flip(decoded(shown(reference.mean, exposure, tone_map)), decoded(shown(again, exposure, tone_map))));
}

}  // namespace fb::lab
