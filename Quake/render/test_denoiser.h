// For tests of the denoiser: settings, frames with a running clock, and picture metrics.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "render/picture/denoiser.h"
#include "render/test_device.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {

inline RenderSettings denoising() {
  RenderSettings s;
  s.intersector = Intersector::kBvh;
  s.denoise = 1;
  s.light_scale = 1;
  s.first_spp = 1;
  s.svgf_levels = 5;
  s.accumulate = 0;
  return s;
}

// Nothing moves but the clock, so that the history works as in a game that runs.
inline scene::FrameSnapshot at_time(scene::FrameSnapshot snapshot, int frame) {
  snapshot.prev_time = (frame - 1) / 60.0;
  snapshot.time = frame / 60.0;
  snapshot.frame = static_cast<std::uint64_t>(frame);
  return snapshot;
}

inline float luminance(const vec4& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

inline double mean_square_difference(const std::vector<vec4>& a, const std::vector<vec4>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const vec3 d = vec3(a[i]) - vec3(b[i]);
    sum += static_cast<double>(glm::dot(d, d)) / 3;
  }
  return sum / static_cast<double>(a.size());
}

inline double mean_luminance(const std::vector<vec4>& image) {
  double sum = 0;
  for (const vec4& p : image) sum += luminance(p);
  return sum / static_cast<double>(image.size());
}

inline std::vector<std::uint32_t> history_lengths(const Renderer& renderer) {
  std::vector<std::uint32_t> frames;
  for (const auto& texel : renderer.read().history()) frames.push_back((texel.y >> 16u) & 0xffu);
  return frames;
}

inline std::vector<vec4> reference_of(const std::function<std::unique_ptr<Renderer>(const RenderSettings&)>& make,
                                      const scene::FrameSnapshot& snapshot, int frames) {
  RenderSettings s;
  s.intersector = Intersector::kBvh;
  s.spp = 16;
  s.jitter = 0;
  s.seed = 1000;
  auto renderer = make(s);
  for (int i = 0; i < frames; ++i) renderer->render(snapshot, nullptr, s);
  return renderer->read().linear();
}

}  // namespace fb::render
