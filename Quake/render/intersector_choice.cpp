#include "render/intersector_choice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "base/log.h"
#include "base/rng.h"
#include "render/ray_list.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

constexpr std::size_t kRays = 16384;
constexpr std::uint32_t kSpheres = 128;
constexpr int kRuns = 3;

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

double rays_per_microsecond(gpu::Device& device, const GpuSceneOptions& options, const scene::FrameSnapshot& hall,
                            const std::vector<shared::ListRay>& rays) {
  RayList list(device, options, false);
  list.load(hall, rays);
  list.trace();  // the first run may compile
  double best = list.trace();
  for (int run = 1; run < kRuns; ++run) best = std::min(best, list.trace());
  return static_cast<double>(rays.size()) / (best * 1000.0);
}

}  // namespace

IntersectorSpeeds measure_intersectors(gpu::Device& device, std::optional<bool> by_address) {
  const scene::FrameSnapshot hall = scene::many_lights(kSpheres);
  const std::vector<shared::ListRay> rays = rays_through(hall);
  GpuSceneOptions options;
  options.by_address = by_address;
  IntersectorSpeeds speeds;
  speeds.bvh = rays_per_microsecond(device, options, hall, rays);
  options.ray_query = true;
  speeds.query = rays_per_microsecond(device, options, hall, rays);
  return speeds;
}

bool ray_query_is_faster(gpu::Device& device, std::optional<bool> by_address) {
  static std::mutex mutex;
  static std::map<std::string, bool> measured;
  const std::string name = device.report().name + ", " + device.report().driver;
  const std::scoped_lock lock(mutex);
  if (const auto found = measured.find(name); found != measured.end()) return found->second;
  const IntersectorSpeeds speeds = measure_intersectors(device, by_address);
  const bool query = speeds.query > speeds.bvh;
  log_info("r_intersector auto: {} (millions of rays a second: query {:.2f}, bvh {:.2f})", query ? "query" : "bvh",
           speeds.query, speeds.bvh);
  return measured.emplace(name, query).first->second;
}

}  // namespace fb::render
