// The host's part of Markov chain path guiding (mcpg.cpp), for its techniques and for those that do more besides.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "estimators/mcpg/mcpg.h"
#include "render/techniques/seen_grid.h"
#include "render/techniques/technique.h"
#include "render/techniques/technique_memory.h"

namespace fb::render {

class GuidedTechnique : public Technique {
 public:
  // `block_bytes`: of its uniform block, for what stands there behind its own constants.
  GuidedTechnique(const TechniqueTools& tools, std::string_view name,
                  std::size_t block_bytes = sizeof(shared::GuideConstants));

  RenderSettings adapt(RenderSettings settings) const override;
  void prepare(const TechniqueFrame& frame) override;
  void add_passes(const TechniquePasses& passes) override;
  void forget() override { memory_.forget(); }
  std::uint32_t salt() const override { return frame_; }
  std::uint64_t bytes() const override { return memory_.bytes() + (seen_ ? seen_->bytes() : 0); }

 protected:
  std::byte* block() { return static_cast<std::byte*>(uniform_.mapped()); }
  std::uint32_t seen_ways() const { return seen_ways_; }
  // When memories can be read, before paths are traced.
  virtual void add_before_paths(const TechniquePasses& /*passes*/) {}

 private:
  void choose_sizes(const RenderSettings& settings);
  void fill_constants(const TechniqueFrame& frame);

  gpu::Device& device_;
  std::string name_;
  TechniqueMemory memory_;
  gpu::Buffer uniform_;
  std::optional<SeenGrid> seen_;  // where it looks for light, too
  std::uint32_t seen_ways_ = 0;
  std::uint32_t state_count_ = 0, cell_count_ = 0;
  std::uint64_t vertices_ = 0;                       // of paths, a frame
  std::uint32_t accesses_ = 1, bucket_ = 1;          // cells that a vertex takes states from; states in a cell
  std::uint32_t frame_ = 0;                          // since it forgot
  std::array<double, shared::kPastFrames> times_{};  // of the last frames, by their numbers
  std::uint32_t parts_ = 1;                          // of a frame's paths
  bool resolve_ = false, guides_fog_ = true, said_size_ = false;
};

}  // namespace fb::render
