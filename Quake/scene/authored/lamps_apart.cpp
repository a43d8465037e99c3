#include "scene/authored/lamps_apart.h"

#include <algorithm>
#include <array>

#include "scene/library/lights.h"
#include "world/bsp_query.h"

namespace fb::scene {
namespace {

constexpr float kNear = 4.0f;  // units: nearer, small spheres would still hide much of each other
constexpr float kStep = 8.0f;  // how far a lamp is moved
constexpr float kRoom = 4.0f;  // that is left beyond
// Radius of a sphere by its distance from the next: of 0.375 a tenth of the light is hidden at most, on average over
// all ways, and scattered rays still find the lamp.
constexpr float kShare = 0.375f;

// Where a lamp may go, up or down first: lamps stand at walls.
constexpr std::array<vec3, 6> kWays = {vec3(0, 0, 1),  vec3(0, 0, -1), vec3(1, 0, 0),
                                       vec3(-1, 0, 0), vec3(0, 1, 0),  vec3(0, -1, 0)};

bool is_near(const vec3& at, const EntityLight& other) { return glm::length(at - other.position) < kNear; }

}  // namespace

std::vector<EntityLight> lamps_apart(const formats::Bsp& bsp, std::vector<EntityLight> lamps) {
  std::vector<bool> meets(lamps.size(), false);
  for (std::size_t i = 0; i < lamps.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (glm::length(lamps[i].position - lamps[k].position) < lamps[i].radius + lamps[k].radius)
        meets[i] = meets[k] = true;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    if (!meets[i]) continue;
    const auto is_taken = [&](const vec3& at) {
      return std::any_of(lamps.begin(), lamps.begin() + static_cast<std::ptrdiff_t>(i),
                         [&](const EntityLight& other) { return is_near(at, other); });
    };
    const vec3 from = lamps[i].position;
    if (!is_taken(from)) continue;
    for (const vec3& way : kWays) {
      const vec3 to = from + way * kStep;
      if (is_taken(to) || world::trace_line(bsp, from, to + way * kRoom).hit) continue;
      lamps[i].position = to;
      break;
    }
  }
  std::vector<float> radii;
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    radii.push_back(lamps[i].radius);
    if (!meets[i]) continue;
    for (std::size_t k = 0; k < lamps.size(); ++k)
      if (k != i)
        radii[i] =
            std::min(radii[i], std::max(kShare * glm::length(lamps[i].position - lamps[k].position), kMinLightRadius));
  }
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const float grown = lamps[i].radius / radii[i];
    lamps[i].power_color *= grown * grown;
    lamps[i].radius = radii[i];
  }
  return lamps;
}

}  // namespace fb::scene
