#include "render/techniques/seen_grid.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "shared/seen_grid.h"

namespace fb::render {

namespace {

constexpr ArrayRow kSeenRows[]{
    {shared::kBindSeen, "what shadow rays reach", ArrayRow::Per::kTable, shared::kSeenBytes}};

}  // namespace

SeenGrid::SeenGrid(const TechniqueTools& tools) : memory_(tools.device, tools.table, kSeenRows, "seen reset") {
  memory_.set_count(shared::kBindSeen, 1);
  memory_.make();
}

// Epochs of 1, 2, 4, 8 frames, then of 16: what is known is soon of use, then of many rays, and never old.
std::uint32_t SeenGrid::begin_frame() {
  fresh_ = memory_.begin_frame();
  if (fresh_) epoch_ = left_ = 0;
  new_epoch_ = left_ == 0;
  if (new_epoch_) left_ = 1u << std::min(epoch_++, 4u);
  --left_;
  return epoch_ % 2;
}

void SeenGrid::add_reset(PassList& list) {
  constexpr std::uint64_t kTable = shared::kSeenWays * sizeof(uvec2);
  memory_.add_reset(list);
  if (fresh_ || !std::exchange(new_epoch_, false)) return;
  list.add("seen reset", PassKind::kEstimator, [this, counted = 1 - epoch_ % 2](gpu::Commands& commands) {
    commands.fill(memory_.buffer(shared::kBindSeen), 0,
                  shared::kSeenWaysWords * sizeof(std::uint32_t) + counted * kTable, kTable);
    commands.barrier();
  });
}

void SeenGrid::add_fold(PassList& list, ShaderSet& shaders) {
  list.dispatch("seen", PassKind::kEstimator, shaders.get("fold_seen"), {shared::kSeenCells / 64, 1});
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
