#include "render/picture/readback.h"

#include <array>
#include <bit>

#include "render/picture/denoiser.h"
#include "shared/work.h"

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
  const std::vector<vec4> mean = linear();  // w: how many samples each pixel has; of one or none nothing was written
  for (std::size_t i = 0; i < variance.size(); ++i) {
    const float n = mean[i].w;
    variance[i] = n > 1 ? variance[i] * (1.0f / ((n - 1) * n)) : vec4(0);
  }
  return variance;
}
std::vector<shared::GBufferTexel> Readback::gbuffer() const {
  constexpr std::size_t kPlanes = sizeof(shared::GBufferTexel) / sizeof(glm::uvec4);
  const std::size_t count = pixels(from_.render_size);
  const auto planes = gpu::read_now<glm::uvec4>(from_.device, from_.gbuffer, kPlanes * count);
  std::vector<shared::GBufferTexel> texels(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<glm::uvec4, kPlanes> words;
    for (std::size_t plane = 0; plane < kPlanes; ++plane) words[plane] = planes[plane * count + i];
    texels[i] = std::bit_cast<shared::GBufferTexel>(words);
  }
  return texels;
}
std::vector<glm::uvec4> Readback::history() const { return from_.denoiser.read_history(); }

FrameCounters Readback::counters() const {
  const auto words = gpu::read_now<std::uint32_t>(from_.device, from_.counters, shared::kCounterCount);
  return {words[shared::kCounterNan], words[shared::kCounterGuideNan], words[shared::kCounterHistory]};
}

FrameWork Readback::work() const {
  const auto words = gpu::read_now<std::uint32_t>(from_.device, from_.counters, shared::kCounterCount);
  const auto word = [&](std::uint32_t kind, std::uint32_t i) {
    return words[shared::work_word(kind, from_.work_parity) + i];
  };
  return {word(shared::kWorkMedium, 0) != 0, word(shared::kWorkSecond, 0) != 0, word(shared::kWorkWater, 3)};
}

float Readback::exposure() const {
  return gpu::read_now<shared::ExposureState>(from_.device, from_.exposure, 1).front().exposure;
}

}  // namespace fb::render
