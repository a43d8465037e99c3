#include "scene/authored/gain_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shared/denoise.h"
#include "shared/gain_field.h"

namespace fb::scene {
namespace {

constexpr float kLeastSide = 48.0f;            // units
constexpr std::size_t kMostCells = 1u << 22u;  // of all ways
constexpr float kMostGain = 16.0f;             // and 1 / kMostGain
constexpr float kTrust = 0.1f;                 // points' worth of light that is right, in each cell
constexpr float kDim = 0.001f;                 // added to both lights: below it all is dark
constexpr int kSpread = 6;                     // cells that a factor reaches into the open

// Cells of a box, x fastest.
class Grid {
 public:
  Grid(std::array<int, 3> size) : size_(size) {}
  std::size_t cells() const {
    return static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(size_[2]);
  }
  // visit(cell, weight) of a cell and those around it, by 1 2 1 along each axis; the weights of all are 1.
  template <typename Visit>
  void around(const std::array<int, 3>& at, const Visit& visit) const {
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const std::array<int, 3> cell{at[0] + x, at[1] + y, at[2] + z};
          const int off = (x != 0) + (y != 0) + (z != 0);
          if (within(cell)) visit(index(cell), 0.125f / static_cast<float>(1 << off));
        }
  }
  // visit(cell) of those that share a side.
  template <typename Visit>
  void beside(std::size_t cell, const Visit& visit) const {
    std::size_t stride = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto n = static_cast<std::size_t>(size_[axis]);
      const std::size_t at = cell / stride % n;
      if (at > 0) visit(cell - stride);
      if (at + 1 < n) visit(cell + stride);
      stride *= n;
    }
  }

 private:
  bool within(const std::array<int, 3>& at) const {
    return at[0] >= 0 && at[1] >= 0 && at[2] >= 0 && at[0] < size_[0] && at[1] < size_[1] && at[2] < size_[2];
  }
  std::size_t index(const std::array<int, 3>& at) const {
    return (static_cast<std::size_t>(at[2]) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(at[1])) *
               static_cast<std::size_t>(size_[0]) +
           static_cast<std::size_t>(at[0]);
  }
  std::array<int, 3> size_;
};

// Gives cells beside known ones the mean of those, a ring at a time. w: 1 where a cell is known.
void spread(const Grid& grid, std::vector<vec4>& logs, std::vector<std::size_t> edge) {
  std::vector<std::size_t> next;
  std::vector<vec4> found;
  for (int ring = 0; ring < kSpread; ++ring) {
    next.clear();
    found.clear();
    for (const std::size_t cell : edge)
      grid.beside(cell, [&](std::size_t beside) {
        if (logs[beside].w == 0.0f) next.push_back(beside);
      });
    std::ranges::sort(next);
    next.erase(std::unique(next.begin(), next.end()), next.end());
    for (const std::size_t cell : next) {
      vec4 sum(0.0f);
      grid.beside(cell, [&](std::size_t beside) { sum += logs[beside]; });
      found.emplace_back(vec3(sum) / sum.w, 1.0f);
    }
    for (std::size_t i = 0; i < next.size(); ++i) logs[next[i]] = found[i];
    edge.swap(next);
  }
}

// What a point's light is off by: logarithms, so that what is bright in a cell does not decide for all of it.
vec3 log_ratio(const vec3& baked, const vec3& light) {
  const float most = std::log(kMostGain);
  return glm::clamp(glm::log((baked + vec3(kDim)) / (light + vec3(kDim))), vec3(-most), vec3(most));
}

}  // namespace

GainField make_gain_field(const formats::Bsp& bsp, const std::vector<LuxelPoint>& points,
                          const std::vector<vec3>& light) {
  GainField field;
  Bounds bounds;
  for (const LuxelPoint& p : points) bounds.add(p.position);
  if (points.empty() || bsp.models.empty()) return field;
  std::array<int, 3> size{};
  for (field.side = kLeastSide;; field.side *= 1.1f) {
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
      const vec4 off = vec4(log_ratio(baked, light[i]), 1.0f) * weight;
      grid.around({static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z)},
                  [&](std::size_t cell, float share) { sums[cell] += off * share; });
    }
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < cells; ++i) {
      if (sums[i].w <= 0.0f) continue;
      sums[i] = vec4(vec3(sums[i]) / (sums[i].w + kTrust), 1.0f);
      known.push_back(i);
    }
    std::vector<vec4>& logs = sums;
    spread(grid, logs, known);
    for (std::size_t i = 0; i < cells; ++i)
      if (logs[i].w > 0.0f) field.cells[way * cells + i] = shared::pack_rgb9e5(glm::exp(vec3(logs[i])), 0.5f);
  }
  return field;
}

}  // namespace fb::scene
