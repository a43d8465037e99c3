// Readback: what the last frame left on the device, copied to the host. Every call waits for the copy.
#pragma once

#include <cstdint>
#include <vector>

#include "base/maths.h"
#include "gpu/buffer.h"
#include "gpu/device.h"
#include "shared/frame.h"

namespace fb::render {

class Denoiser;

// Since the renderer was made.
struct FrameCounters {
  std::uint32_t not_finite = 0;          // samples; they counted as zero
  std::uint32_t states_not_finite = 0;   // states of the guide, which were not stored
  std::uint32_t history_not_finite = 0;  // irradiances that were kept out of the denoiser's history
};

// What the last frame's G-buffer asked later passes for (shared/work.h).
struct FrameWork {
  bool medium = false, second = false;
  std::uint32_t water_tiles = 0;
};

class Readback {
 public:
  struct Source {
    gpu::Device& device;
    const gpu::Buffer &output, &mean, &m2, &gbuffer, &counters, &exposure;
    const Denoiser& denoiser;
    uvec2 output_size, render_size;
    std::uint32_t work_parity;
  };
  explicit Readback(const Source& source) : from_(source) {}

  std::vector<std::uint32_t> output() const;   // packed 8-bit pixels, r lowest (unless swapped)
  std::vector<vec4> linear() const;            // mean radiance, linear Rec.709; w: frames averaged
  std::vector<vec4> denoised() const;          // denoised radiance; the raw mean where the denoiser is off
  std::vector<vec4> variance_of_mean() const;  // per channel, from the accumulated frames (zero for one)
  std::vector<shared::GBufferTexel> gbuffer() const;
  // The denoiser's history as it is packed (shared/denoise.h), kSectionHistory of the last frame.
  std::vector<glm::uvec4> history() const;
  FrameCounters counters() const;
  FrameWork work() const;
  float exposure() const;  // factor on radiance before the tone curve

 private:
  Source from_;
};

}  // namespace fb::render
