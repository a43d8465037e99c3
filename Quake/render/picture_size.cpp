#include "render/picture_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/out_of_memory.h"
#include "render/denoiser.h"
#include "shared/denoise.h"
#include "shared/frame.h"

namespace fb::render {
namespace {

std::uint64_t pixels_of(uvec2 size) { return std::uint64_t{size.x} * size.y; }

// Of the buffer that has most of them.
std::uint64_t bytes_per_pixel(const RenderSettings& settings) {
  const std::uint64_t history = Denoiser::wanted(settings) ? shared::kHistorySections * sizeof(glm::uvec4) : 0;
  return std::max<std::uint64_t>(sizeof(shared::GBufferTexel), history);
}

std::uint64_t largest_buffer(uvec2 output, const RenderSettings& settings) {
  return std::max(pixels_of(scaled_size(output, settings)) * bytes_per_pixel(settings),
                  pixels_of(output) * sizeof(std::uint32_t));
}

std::uint64_t buffer_limit(const gpu::DeviceLimits& limits) {
  return std::min(limits.max_storage_buffer_range, limits.max_allocation_bytes);
}

std::string mebibytes(std::uint64_t bytes) { return fmt::format("{:.0f} MiB", static_cast<double>(bytes) / 1048576.0); }

}  // namespace

uvec2 scaled_size(uvec2 output, const RenderSettings& settings) {
  const auto scaled = [&](std::uint32_t size) {
    return std::max(1u, static_cast<std::uint32_t>(std::lround(static_cast<float>(size) * settings.scale)));
  };
  return {scaled(output.x), scaled(output.y)};
}

uvec2 largest_output(const gpu::DeviceLimits& limits, uvec2 output, const RenderSettings& settings) {
  const std::uint64_t limit = buffer_limit(limits), needed = largest_buffer(output, settings);
  if (needed <= limit) return output;
  const double factor = std::sqrt(static_cast<double>(limit) / static_cast<double>(needed));
  uvec2 size(std::max(1.0, output.x * factor), std::max(1.0, output.y * factor));
  while (largest_buffer(size, settings) > limit && size.x * size.y > 1) size = glm::max(size, uvec2(2)) - 1u;
  return size;
}

void check_picture_size(const gpu::Device& device, uvec2 output, const RenderSettings& settings) {
  const uvec2 most = largest_output(device.limits(), output, settings);
  if (most == output) return;
  const std::string scale = settings.scale < 1 ? fmt::format(" (r_scale {:g})", settings.scale) : "";
  throw OutOfMemory(fmt::format("a picture of {}x{}{} needs a buffer of {}; {} allows {}: at most {}x{} in this shape",
                                output.x, output.y, scale, mebibytes(largest_buffer(output, settings)),
                                device.report().name, mebibytes(buffer_limit(device.limits())), most.x, most.y));
}

}  // namespace fb::render
