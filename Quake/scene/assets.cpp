// Time's part of materials, and the packing of poses.
#include "scene/assets.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/check.h"
#include "scene/animation.h"
#include "shared/packing.h"

namespace fb::scene {

std::size_t frame_of_group(const std::vector<float>& end_times, std::size_t count, double time) {
  if (end_times.empty() || count == 0) return 0;
  const double period = end_times.back();
  if (!(period > 0.0) || !std::isfinite(time)) return 0;
  const double phase = time - std::floor(time / period) * period;
  const auto next = std::upper_bound(end_times.begin(), end_times.end(), phase,
                                     [](double value, float end) { return value < static_cast<double>(end); });
  const auto index = static_cast<std::size_t>(next - end_times.begin());
  return std::min(index, std::min(count, end_times.size()) - 1);
}

std::size_t frame_of_rate(double frames_per_second, std::size_t count, double time) {
  if (count < 2 || !std::isfinite(time)) return 0;
  const double n = static_cast<double>(count), step = std::floor(time * frames_per_second);
  const double index = step - std::floor(step / n) * n;
  return std::min(static_cast<std::size_t>(std::max(index, 0.0)), count - 1);
}

const TextureSet& texture_at(const Material& material, double time, bool alternate) {
  static const TextureSet kPlain;
  const bool use_alternate = alternate && !material.alternate_frames.empty();
  const std::vector<TextureSet>& frames = use_alternate ? material.alternate_frames : material.frames;
  if (frames.empty()) return kPlain;
  if (!material.end_times.empty() && !use_alternate)
    return frames[frame_of_group(material.end_times, frames.size(), time)];
  return frames[frame_of_rate(material.frames_per_second, frames.size(), time)];
}

std::uint64_t next_generation() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

PoseVertex make_pose_vertex(std::uint32_t x, std::uint32_t y, std::uint32_t z, const vec3& normal) {
  const shared::uint packed = shared::pack_direction(normal);
  return {shared::pack_pose_position(x, y, z), static_cast<std::int16_t>(packed & 0xffffu),
          static_cast<std::int16_t>(packed >> 16u)};
}
vec3 pose_numbers(const PoseVertex& vertex) { return shared::unpack_pose_position(vertex.position); }

}  // namespace fb::scene
