#include "scene/authored/gain_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shared/denoise.h"
#include "shared/gain_field.h"

namespace fb::scene {
namespace {

constexpr float kLeastSide = 48.0f;            // units
constexpr std::size_t kMostCells = 1u << 20u;  // of all ways
constexpr float kMostGain = 16.0f;             // and 1 / kMostGain
constexpr float kTrust = 0.1f;                 // points' worth of light that is right, in each cell
constexpr float kDim = 0.001f;                 // added to both lights: below it all is dark
constexpr int kSpread = 5;                     // cells that a factor reaches into the open

class Grid {
 public:
  Grid(std::array<int, 3> size) : size_(size) {}
  std::size_t cells() const {
    return static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(size_[2]);
  }
  // The mean of a value over a cell and its neighbours along an axis, by 1 2 1 where they are within.
  template <typename T, typename Add>
  void blur(std::vector<T>& values, const Add& add) const {
    std::size_t stride = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto n = static_cast<std::size_t>(size_[axis]);
      std::vector<T> out(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t at = i / stride % n;
        add(out[i], values[i], 0.5f);
        if (at > 0) add(out[i], values[i - stride], 0.25f);
        if (at + 1 < n) add(out[i], values[i + stride], 0.25f);
      }
      values = std::move(out);
      stride *= n;
    }
  }

 private:
  std::array<int, 3> size_;
};

// What a point's light is off by: logarithms, so that what is bright in a cell does not decide for all of it.
vec3 log_ratio(const vec3& baked, const vec3& light) {
  const float most = std::log(kMostGain);
  return glm::clamp(glm::log((baked + vec3(kDim)) / (light + vec3(kDim))), vec3(-most), vec3(most));
}

void add_weighted(vec4& to, const vec4& from, float weight) { to += from * weight; }

}  // namespace

GainField make_gain_field(const formats::Bsp& bsp, const std::vector<LuxelPoint>& points,
                          const std::vector<vec3>& light) {
  GainField field;
  Bounds bounds;
  for (const LuxelPoint& p : points) bounds.add(p.position);
  if (points.empty() || bsp.models.empty()) return field;
  std::array<int, 3> size{};
  for (field.side = kLeastSide;; field.side *= 1.25f) {
    for (int a = 0; a < 3; ++a)
      size[static_cast<std::size_t>(a)] = static_cast<int>((bounds.max[a] - bounds.min[a]) / field.side) + 3;
    if (Grid(size).cells() * shared::kGainWays <= kMostCells) break;
  }
  field.origin = bounds.min - vec3(field.side);
  field.width = static_cast<std::uint32_t>(size[0]);
  field.depth = static_cast<std::uint32_t>(size[1]);
  field.height = static_cast<std::uint32_t>(size[2]);
  const Grid grid(size);
  const std::size_t cells = grid.cells();
  field.cells.assign(cells * shared::kGainWays, 0u);
  for (std::uint32_t way = 0; way < shared::kGainWays; ++way) {
    std::vector<vec4> sums(cells, vec4(0.0f));  // of logarithms; w: of weights
    for (std::size_t i = 0; i < points.size(); ++i) {
      const LuxelPoint& p = points[i];
      const float weight = shared::gain_weight(p.normal, way);
      if (light[i].x < 0.0f || weight < 0.1f) continue;
      const vec3 at = (p.position - field.origin) / field.side;
      vec3 baked(0.0f);
      for (std::size_t k = 0; k < 4; ++k)
        if (p.styles[k] != Lightmaps::kNoStyle) baked += p.baked[k];
      sums[(static_cast<std::size_t>(at.z) * field.depth + static_cast<std::size_t>(at.y)) * field.width +
           static_cast<std::size_t>(at.x)] += vec4(log_ratio(baked, light[i]), 1.0f) * weight;
    }
    grid.blur(sums, add_weighted);
    std::vector<vec4> logs(cells, vec4(0.0f));  // w: 1 where it is known
    for (std::size_t i = 0; i < cells; ++i)
      if (sums[i].w > 0.0f) logs[i] = vec4(vec3(sums[i]) / (sums[i].w + kTrust), 1.0f);
    for (int k = 0; k < kSpread; ++k) {
      auto wider = logs;
      grid.blur(wider,
                [](vec4& to, const vec4& from, float weight) { to += vec4(vec3(from) * from.w, from.w) * weight; });
      for (std::size_t i = 0; i < cells; ++i)
        if (logs[i].w == 0.0f && wider[i].w > 0.0f) logs[i] = vec4(vec3(wider[i]) / wider[i].w, 1.0f);
    }
    for (std::size_t i = 0; i < cells; ++i)
      if (logs[i].w > 0.0f) field.cells[way * cells + i] = shared::pack_rgb9e5(glm::exp(vec3(logs[i])), 0.5f);
  }
  return field;
}

}  // namespace fb::scene
