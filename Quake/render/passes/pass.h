// The frame's work as a list of passes: who has some adds them in order, the renderer records them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/maths.h"
#include "gpu/commands.h"
#include "gpu/pipeline.h"

namespace fb::render {

// Whose time a pass is. The frame's passes are the same with every estimator; the estimator's own are what it costs.
enum class PassKind { kFrame, kEstimator };

// GPU time of a pass, in milliseconds, in the order recorded. Zero where the device has no timestamps.
struct PassTime {
  std::string name;
  double milliseconds = 0;
  PassKind kind = PassKind::kFrame;
};

// Workgroups of `side` x `side` invocations that cover a picture.
inline uvec2 groups_over(uvec2 pixels, std::uint32_t side) { return (pixels + (side - 1)) / side; }

// Workgroups of a dispatch that happens only if the frame asks for it (shared/work.h).
struct AskedGroups {
  const gpu::Buffer* words = nullptr;  // null: the frame can't ask
  std::uint32_t word = 0;
  uvec2 most{0, 0};
  explicit operator bool() const { return words != nullptr; }
  void dispatch(gpu::Commands& commands, const gpu::ComputePipeline& pipeline) const {
    commands.dispatch_indirect(pipeline, *words, VkDeviceSize{word} * sizeof(std::uint32_t), most.x, most.y);
  }
};

class PassList {
 public:
  // `record` ends with a barrier after what later passes read.
  void add(std::string name, PassKind kind, std::function<void(gpu::Commands&)> record);
  // One dispatch and a barrier.
  void dispatch(std::string name, PassKind kind, const gpu::ComputePipeline& pipeline, uvec2 groups);
  void dispatch(std::string name, PassKind kind, const gpu::ComputePipeline& pipeline, const AskedGroups& groups);

  // Each pass in a timed scope of its name.
  void record(gpu::Commands& commands) const;
  // What a timer read after record(), with each pass's kind.
  std::vector<PassTime> times(const std::vector<gpu::PassTime>& measured) const;

 private:
  struct Pass {
    std::string name;
    PassKind kind;
    std::function<void(gpu::Commands&)> record;
  };
  std::vector<Pass> passes_;
};

}  // namespace fb::render
