// The grid of what shadow rays reach (Shaders/shared/seen_grid.h), of a technique that looks for light.
#pragma once

#include "render/techniques/technique.h"
#include "render/techniques/technique_memory.h"

namespace fb::render {

class SeenGrid {
 public:
  explicit SeenGrid(const TechniqueTools& tools);
  // Begins a frame. The table of ways that it reads (seen_ways of the technique's constants).
  std::uint32_t begin_frame();
  // Before the paths' pass, and after it.
  void add_reset(PassList& list);
  void add_fold(PassList& list, ShaderSet& shaders);
  void forget() { memory_.forget(); }
  bool fresh() const { return fresh_; }  // nothing is remembered in this frame
  std::uint64_t bytes() const { return memory_.bytes(); }

 private:
  TechniqueMemory memory_;
  bool fresh_ = true;
  std::uint32_t epoch_ = 0, left_ = 0;  // of ways: that is counted now, and its frames still to come
  bool new_epoch_ = false;
};

// Of this many rays a frame one is remembered, so that no cell's counters overflow; a power of two.
std::uint32_t seen_stride(uvec2 size, const RenderSettings& settings, bool medium);

}  // namespace fb::render
