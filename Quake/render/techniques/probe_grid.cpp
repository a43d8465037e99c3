#include "render/techniques/probe_grid.h"

#include <algorithm>
#include <cmath>

namespace fb::render {
namespace {

constexpr std::array<int, 3> kMost{static_cast<int>(shared::kDdgiMostX), static_cast<int>(shared::kDdgiMostY),
                                   static_cast<int>(shared::kDdgiMostZ)};
constexpr float kLargest = 131072.0f;  // units of a scene's box, several times a map's

bool is_usable(const Bounds& bounds) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(bounds.min[axis] >= -kLargest) || !(bounds.max[axis] <= kLargest)) return false;
  return !bounds.empty();
}

}  // namespace

ProbeGrid probe_grid(const Bounds& bounds, const vec3& camera, float spacing) {
  const Bounds box = is_usable(bounds) ? bounds : Bounds{camera, camera};
  ProbeGrid grid;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const float extent = std::max(box.max[axis] - box.min[axis], 1.0f);
    const float wanted = spacing > 0 ? std::ceil(extent / spacing) : static_cast<float>(kMost[i]);
    if (wanted <= static_cast<float>(kMost[i])) {
      grid.count[i] = std::max(static_cast<int>(wanted), 1);
      grid.origin[axis] = box.min[axis];
      grid.spacing[axis] = extent / static_cast<float>(grid.count[i]);
      continue;
    }
    grid.count[i] = kMost[i];
    grid.spacing[axis] = spacing;
    grid.origin[axis] = 0;
    const auto cell = [&](float at) {
      return static_cast<int>(std::floor(std::clamp(at, -kLargest, kLargest) / spacing));
    };
    const int least = cell(box.min[axis]), most = std::max(cell(box.max[axis]) + 1 - kMost[i], least);
    grid.first[i] = std::clamp(cell(camera[axis]) - kMost[i] / 2, least, most);
  }
  return grid;
}

Bounds lit_bounds(const scene::FrameSnapshot& snapshot) {
  Bounds bounds;
  if (!snapshot.assets) return bounds;
  const bool world = !snapshot.instances.empty() && snapshot.instances.front().id == scene::kIdWorld;
  for (const scene::Instance& instance : snapshot.instances) {
    if (instance.mesh >= snapshot.assets->meshes.size() || (instance.visibility & scene::kSeenByIndirect) == 0)
      continue;
    const Bounds& mesh = snapshot.assets->meshes[instance.mesh].bounds;
    if (!mesh.empty()) bounds.add(transform_bounds(instance.transform, mesh));
    if (world) break;
  }
  return bounds;
}

}  // namespace fb::render
