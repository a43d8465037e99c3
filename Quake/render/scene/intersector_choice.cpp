#include "render/scene/intersector_choice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "base/log.h"
#include "base/rng.h"
#include "render/scene/ray_list.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

constexpr std::size_t kRays = 16384;
constexpr std::uint32_t kSpheres = 128;
constexpr int kRuns = 10;
constexpr double kDoubtOnCpu = 1.5;

// From anywhere in the hall in any direction, as paths have them.
std::vector<shared::ListRay> rays_through(const scene::FrameSnapshot& hall) {
  Rng rng(1);
  std::vector<shared::ListRay> rays(kRays);
  for (shared::ListRay& ray : rays) {
    const float z = 2 * rng.uniform() - 1, phi = 2 * kPi * rng.uniform(), r = std::sqrt(std::max(1 - z * z, 0.0f));
    ray.origin = hall.camera.position + vec3(rng.uniform() - 0.5f, rng.uniform() - 0.5f, 0) * 256.0f;
    ray.direction = vec3(r * std::cos(phi), r * std::sin(phi), z);
    ray.t_max = 1e6f;
    ray.mask = scene::kSeenByAll;
  }
  return rays;
}

}  // namespace

// In turns, the best of each: what else the machine does for a moment must not decide.
IntersectorSpeeds measure_intersectors(gpu::Device& device, std::optional<bool> by_address) {
  const scene::FrameSnapshot hall = scene::many_lights(kSpheres);
  const std::vector<shared::ListRay> rays = rays_through(hall);
  GpuSceneOptions options;
  options.by_address = by_address;
  RayList bvh(device, options, false);
  options.ray_query = true;
  RayList query(device, options, false);
  double fastest[2] = {1e30, 1e30};  // milliseconds
  RayList* const lists[2] = {&bvh, &query};
  for (RayList* list : lists) {
    list->load(hall, rays);
    list->trace();  // the first run may compile
  }
  for (int run = 0; run < kRuns; ++run) {
    for (int i = 0; i < 2; ++i) fastest[i] = std::min(fastest[i], lists[i]->trace());
  }
  const double per_microsecond = static_cast<double>(rays.size()) / 1000.0;
  IntersectorSpeeds speeds;
  speeds.bvh = per_microsecond / fastest[0];
  speeds.query = per_microsecond / fastest[1];
  return speeds;
}

bool ray_query_is_faster(gpu::Device& device, std::optional<bool> by_address) {
  static std::mutex mutex;
  static std::map<std::string, bool> measured;
  const std::string name = device.report().name + ", " + device.report().driver;
  const std::scoped_lock lock(mutex);
  if (const auto found = measured.find(name); found != measured.end()) return found->second;
  const IntersectorSpeeds speeds = measure_intersectors(device, by_address);
  // A busy processor may halve either one; in doubt it is our own trees that are faster there.
  const bool query = speeds.query > speeds.bvh * (device.is_software() ? kDoubtOnCpu : 1.0);
  log_info("r_intersector auto: {} (millions of rays a second: query {:.2f}, bvh {:.2f})", query ? "query" : "bvh",
           speeds.query, speeds.bvh);
  return measured.emplace(name, query).first->second;
}

}  // namespace fb::render
