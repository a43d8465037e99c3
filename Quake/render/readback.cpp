#include "render/readback.h"

#include "render/denoiser.h"

namespace fb::render {
namespace {

std::size_t pixels(uvec2 size) { return static_cast<std::size_t>(size.x) * size.y; }

}  // namespace

std::vector<std::uint32_t> Readback::output() const {
  return gpu::read_now<std::uint32_t>(from_.device, from_.output, pixels(from_.output_size));
}
std::vector<vec4> Readback::linear() const {
  return gpu::read_now<vec4>(from_.device, from_.mean, pixels(from_.render_size));
}
std::vector<vec4> Readback::denoised() const { return from_.denoiser.on() ? from_.denoiser.read() : linear(); }
std::vector<vec4> Readback::variance_of_mean() const {
  auto variance = gpu::read_now<vec4>(from_.device, from_.m2, pixels(from_.render_size));
  const float n = static_cast<float>(from_.accumulated);
  const float factor = n > 1 ? 1.0f / ((n - 1) * n) : 0.0f;
  for (vec4& v : variance) v *= factor;
  return variance;
}
std::vector<shared::GBufferTexel> Readback::gbuffer() const {
  return gpu::read_now<shared::GBufferTexel>(from_.device, from_.gbuffer, pixels(from_.render_size));
}
std::vector<glm::uvec4> Readback::history() const { return from_.denoiser.read_history(); }

FrameCounters Readback::counters() const {
  const auto words = gpu::read_now<std::uint32_t>(from_.device, from_.counters, shared::kCounterCount);
  return {words[shared::kCounterNan], words[shared::kCounterGuideNan], words[shared::kCounterHistory]};
}

float Readback::exposure() const {
  return gpu::read_now<shared::ExposureState>(from_.device, from_.exposure, 1).front().exposure;
}

}  // namespace fb::render
