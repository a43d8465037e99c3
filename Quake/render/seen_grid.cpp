#include "render/seen_grid.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "shared/seen_grid.h"

namespace fb::render {

SeenGrid::SeenGrid(const TechniqueTools& tools)
    : cells_(tools.device, gpu::BufferUse::kStorage, shared::kSeenBytes, "what shadow rays reach") {
  tools.table.set_array(shared::kSetTechnique, shared::kBindSeen, cells_);
}

void SeenGrid::add_reset(PassList& list) {
  if (!std::exchange(forget_, false)) return;
  list.add("seen reset", PassKind::kEstimator, [this](gpu::Commands& commands) {
    commands.fill(cells_, 0);
    commands.barrier();
  });
}

void SeenGrid::add_fold(PassList& list, ShaderSet& shaders) {
  list.dispatch("seen", PassKind::kEstimator, shaders.get("seen_fold"), {shared::kSeenCells / 64, 1});
}

std::uint32_t seen_stride(uvec2 size, const RenderSettings& settings, bool medium) {
  // A vertex sends one ray; all of a frame's in one cell still fit.
  const int vertices = std::max(settings.bounces, 1) + (medium ? settings.medium_bounces : 0);
  const std::uint64_t rays =
      std::uint64_t{size.x} * size.y * most_samples(settings) * static_cast<std::uint64_t>(vertices);
  return static_cast<std::uint32_t>(
      std::bit_ceil(std::min<std::uint64_t>(rays / (shared::kSeenRay / 2) + 1, 1u << 30)));
}

}  // namespace fb::render
