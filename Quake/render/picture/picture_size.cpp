#include "render/picture/picture_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/out_of_memory.h"

namespace fb::render {
namespace {

std::uint64_t pixels_of(uvec2 size) { return std::uint64_t{size.x} * size.y; }

std::uint64_t largest_buffer(uvec2 output, const RenderSettings& settings, const PictureParts& parts) {
  const uvec2 render = scaled_size(output, settings);
  const std::uint64_t history =
      Denoiser::wanted(settings)
          ? Denoiser::history_bytes(render, Denoiser::smooth_size(render, output, settings), parts.blocks)
          : 0;
  return std::max({pixels_of(render) * 16 * parts.gbuffer_planes, history, pixels_of(output) * sizeof(std::uint32_t)});
}

std::uint64_t buffer_limit(const gpu::DeviceLimits& limits) {
  return std::min(limits.max_storage_buffer_range, limits.max_allocation_bytes);
}

}  // namespace

float rendered_fraction(const RenderSettings& settings) {
  return settings.scale > 1 ? 1 / settings.scale : settings.scale;
}

float scale_for_pixels(uvec2 output, float pixels) {
  return std::clamp(std::sqrt(pixels / static_cast<float>(pixels_of(output))), 0.1f, 1.0f);
}

scene::Area area_within(scene::Area asked, uvec2 output) {
  asked.min = glm::min(asked.min, output);
  asked.size = glm::min(asked.size, output - asked.min);
  return asked.size.x > 0 && asked.size.y > 0 ? asked : scene::Area{uvec2(0), output};
}

uvec2 scaled_size(uvec2 output, const RenderSettings& settings) {
  const float scale = rendered_fraction(settings);
  const auto scaled = [&](std::uint32_t size) {
    return std::max(1u, static_cast<std::uint32_t>(std::lround(static_cast<float>(size) * scale)));
  };
  return {scaled(output.x), scaled(output.y)};
}

uvec2 largest_output(const gpu::DeviceLimits& limits, uvec2 output, const RenderSettings& settings,
                     const PictureParts& parts) {
  const double limit = static_cast<double>(buffer_limit(limits));
  uvec2 size = output;
  const auto excess = [&] { return static_cast<double>(largest_buffer(size, settings, parts)) / limit; };
  while (excess() > 1 && (size.x > 1 || size.y > 1)) {
    const double factor = 1 / std::sqrt(excess());
    const auto smaller = [&](std::uint32_t side) {
      return std::max(1u, std::min(side - 1, static_cast<std::uint32_t>(side * factor)));
    };
    size = {smaller(size.x), smaller(size.y)};
  }
  return size;
}

void check_picture_size(const gpu::Device& device, uvec2 output, const RenderSettings& settings,
                        const PictureParts& parts) {
  const uvec2 most = largest_output(device.limits(), output, settings, parts);
  if (most == output) return;
  const std::string scale =
      scaled_size(output, settings) != output ? fmt::format(" (r_scale {:g})", settings.scale) : "";
  throw OutOfMemory(fmt::format("a picture of {}x{}{} needs a buffer of {}; {} allows {} (try at most {}x{})", output.x,
                                output.y, scale, memory_text(largest_buffer(output, settings, parts)),
                                device.report().name, memory_text(buffer_limit(device.limits())), most.x, most.y));
}

}  // namespace fb::render
