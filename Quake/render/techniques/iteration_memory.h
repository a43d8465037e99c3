// How much memory the iterations of technique `mir` take, before they begin: an upper limit, which is reached where
// every path brings light.
#pragma once

#include <cstdint>
#include <span>

#include "base/maths.h"
#include "render/passes/settings.h"

namespace fb::render {

struct IterationMemory {        // bytes
  std::uint64_t device = 0;     // arrays of a frame's paths
  std::uint64_t pictures = 0;   // of the host: sums of each iteration
  std::uint64_t taught = 0;     // a frame as it is read, and vertices that the next iteration learns from
  std::uint64_t stored = 0;     // paths that are weighed at the end
  std::uint64_t snapshots = 0;  // distributions of all iterations
  std::uint64_t host() const { return pictures + taught + stored + snapshots; }
};
constexpr std::uint64_t kMostTaught = std::uint64_t{1} << 24u;  // vertices that one iteration learns from

// `size`: pixels that are rendered. `schedule`: samples a pixel of each iteration, not empty.
IterationMemory memory_of_iterations(const RenderSettings& settings, uvec2 size,
                                     std::span<const std::uint32_t> schedule);

}  // namespace fb::render
