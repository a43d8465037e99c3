// The grid of what shadow rays reach (Shaders/shared/seen_grid.h), of a technique that looks for light.
#pragma once

#include "render/technique.h"

namespace fb::render {

class SeenGrid {
 public:
  explicit SeenGrid(const TechniqueTools& tools);
  // Before the paths' pass, and after it.
  void add_reset(PassList& list);
  void add_fold(PassList& list, ShaderSet& shaders);
  void forget() { forget_ = true; }
  bool fresh() const { return forget_; }  // nothing is remembered
  std::uint64_t bytes() const { return cells_.size(); }

 private:
  gpu::Buffer cells_;
  bool forget_ = true;
};

// Of this many rays a frame one is remembered, so that no cell's counters overflow; a power of two.
std::uint32_t seen_stride(uvec2 size, const RenderSettings& settings, bool medium);

}  // namespace fb::render
