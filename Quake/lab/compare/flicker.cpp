#include "lab/compare/flicker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/check.h"

namespace fb::lab {
namespace {

constexpr float kDepthAlike = 0.1f;  // relative

// The four pixels about a point between pixel centres, and their weights.
struct Footprint {
  std::array<std::size_t, 4> at;
  std::array<float, 4> weight;
};
// None outside of the picture.
std::optional<Footprint> footprint(const Guides& guides, vec2 point) {
  const vec2 last(static_cast<float>(guides.width) - 1, static_cast<float>(guides.height) - 1);
  if (!(point.x >= 0 && point.y >= 0 && point.x <= last.x && point.y <= last.y)) return std::nullopt;
  const auto x0 = static_cast<std::size_t>(point.x), y0 = static_cast<std::size_t>(point.y);
  const std::size_t x1 = std::min<std::size_t>(x0 + 1, guides.width - 1);
  const std::size_t y1 = std::min<std::size_t>(y0 + 1, guides.height - 1);
  const float fx = point.x - static_cast<float>(x0), fy = point.y - static_cast<float>(y0);
  return Footprint{{y0 * guides.width + x0, y0 * guides.width + x1, y1 * guides.width + x0, y1 * guides.width + x1},
                   {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy}};
}

// Whether all of the footprint that weighs something shows the surface that was at this depth.
bool same_surface(const Guides& former, const Footprint& f, float depth_before) {
  for (std::size_t k = 0; k < 4; ++k) {
    if (f.weight[k] < 1e-3f) continue;
    const float depth = former.depth[f.at[k]];
    if (std::abs(depth - depth_before) > kDepthAlike * std::max(depth, depth_before)) return false;
  }
  return true;
}

}  // namespace

double flicker(const ShownFrame& former, const ShownFrame& now) {
  FB_CHECK(now.reference.same_size(now.test) && now.reference.same_size(former.test) &&
           now.reference.same_size(former.reference));
  double sum = 0;
  std::size_t count = 0;
  for (std::uint32_t y = 0; y < now.guides.height; ++y) {
    for (std::uint32_t x = 0; x < now.guides.width; ++x) {
      const std::size_t at = std::size_t{y} * now.guides.width + x;
      const auto f = footprint(former.guides, vec2(x, y) + now.guides.motion[at]);
      if (!f || !same_surface(former.guides, *f, now.guides.depth_before[at])) continue;
      vec3 change = now.test.pixels[at] - now.reference.pixels[at];
      for (std::size_t k = 0; k < 4; ++k)
        change -= f->weight[k] * (former.test.pixels[f->at[k]] - former.reference.pixels[f->at[k]]);
      sum += double{change.x} * change.x + double{change.y} * change.y + double{change.z} * change.z;
      count += 3;
    }
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace fb::lab
