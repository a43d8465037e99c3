#include "world/liquid_windows.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace fb::world {
namespace {

using formats::Bsp;
using formats::BspFace;

constexpr float kStep = 48.0f, kAside = 2.0f;  // between two samples of a surface, and from it to either side, units
constexpr int kMostSteps = 64;                 // along an edge

// Of those that are clear unless somebody says otherwise.
bool is_liquid(std::int32_t contents) {
  const bool current = contents <= formats::kContentsCurrent0 && contents >= formats::kContentsCurrentDown;
  return contents == formats::kContentsWater || contents == formats::kContentsSlime || current;
}

// Points all over a triangle, none on its rim.
template <typename Visit>
void sample_triangle(const vec3& a, const vec3& b, const vec3& c, Visit visit) {
  const float longest = std::max(glm::length(b - a), std::max(glm::length(c - a), glm::length(c - b)));
  if (!std::isfinite(longest)) return;
  const int steps = std::clamp(static_cast<int>(std::ceil(longest / kStep)), 1, kMostSteps);
  const float part = 1.0f / static_cast<float>(steps);
  for (int i = 0; i < steps; ++i)
    for (int k = 0; i + k < steps; ++k)
      visit(a + (b - a) * ((static_cast<float>(i) + 1.0f / 3) * part) +
            (c - a) * ((static_cast<float>(k) + 1.0f / 3) * part));
}

}  // namespace

LiquidWindows::LiquidWindows(const Bsp& bsp) {
  if (bsp.models.empty() || bsp.visibility.empty()) return;
  const formats::BspModel& world = bsp.models[0];
  const auto look = [&](const vec3& point, const vec3& normal) {
    const Window window{pvs_leaf(bsp, point + normal * kAside), pvs_leaf(bsp, point - normal * kAside)};
    const std::int32_t near = bsp.leafs[window.near].contents, far = bsp.leafs[window.far].contents;
    if (near == formats::kContentsSolid || far == formats::kContentsSolid || is_liquid(near) == is_liquid(far)) return;
    windows_.push_back(window);
    windows_.push_back({window.far, window.near});
  };
  for (std::uint32_t f = 0; f < world.face_count; ++f) {
    const BspFace& face = bsp.faces[world.first_face + f];
    const std::uint32_t texture = bsp.texinfos[face.texinfo].texture;
    if (texture >= bsp.textures.size()) continue;
    const std::string& name = bsp.textures[texture].name;
    if (!name.starts_with('*') || name.starts_with("*tele") || name.starts_with("*TELE")) continue;
    for (std::uint32_t k = 2; k < face.surfedge_count; ++k)
      sample_triangle(bsp.face_vertex(face, 0), bsp.face_vertex(face, k - 1), bsp.face_vertex(face, k),
                      [&](const vec3& point) { look(point, bsp.planes[face.plane].normal); });
  }
  std::ranges::sort(windows_);
  windows_.erase(std::unique(windows_.begin(), windows_.end()), windows_.end());
  std::optional<LeafSet> seen;
  std::uint32_t of = 0;
  std::erase_if(windows_, [&](const Window& window) {
    if (!seen || of != window.near) seen = leaf_pvs(bsp, of = window.near);
    return seen->contains(window.far);
  });
}

void LiquidWindows::add(const Bsp& bsp, LeafSet& set) const {
  const LeafSet before = set;
  for (const Window& window : windows_)
    if (before.contains(window.near)) set.add_pvs(bsp, window.far);
}

}  // namespace fb::world
