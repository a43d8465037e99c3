// Guide: what path guiding remembers from frame to frame: the table of states, the irradiance cache, and, where frames
// must not depend on the order of threads, the proposals of a frame. Layouts: Shaders/shared/guide.h.
#pragma once

#include <cstdint>

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/pipeline.h"
#include "render/settings.h"
#include "shared/frame.h"

namespace fb::render {

class ShaderSet;

class Guide {
 public:
  Guide(gpu::Device& device, gpu::BindingTable& table);

  // Between submissions: makes the buffers that the settings ask for (nothing learnt survives a change of size).
  // `paths` is the number of path vertices a frame: pixels * samples * bounces.
  void prepare(const RenderSettings& settings, std::uint64_t vertices);
  // Gives the memory back; for estimators that learn nothing.
  void release();
  // Forgets everything at the next frame.
  void reset() { forget_ = true; }

  // The guide's rows of the frame's constants; counts a frame. `pixel_tangent`: tangent of a pixel's angle.
  void fill_constants(shared::FrameConstants& constants, const RenderSettings& settings, float pixel_tangent);
  // Before the paths: zeroes what is to be forgotten.
  void record_begin(gpu::Commands& commands);
  // After the paths: resolves proposals, folds the cache's samples.
  void record_end(gpu::Commands& commands, ShaderSet& shaders);

  std::uint64_t bytes() const;

 private:
  gpu::Device& device_;
  gpu::BindingTable& table_;
  gpu::Buffer states_, proposals_, cache_;
  std::uint32_t state_count_ = 0, cell_count_ = 0;
  std::uint64_t vertices_ = 0;
  std::uint32_t frame_ = 0;
  bool resolve_ = false;
  bool forget_ = true;
};

}  // namespace fb::render
