#include "render/techniques/reservoirs.h"

#include <cstring>
#include <span>

#include "render/techniques/seen_grid.h"
#include "shared/scene_gpu.h"

namespace fb::render {
namespace {

constexpr ArrayRow kRows[]{FB_RESTIR_ARRAYS(FB_ARRAY_ROW)};
constexpr ArrayRow kIndirectRows[]{FB_RESTIR_ARRAYS(FB_ARRAY_ROW) FB_RESTIR_INDIRECT_ARRAYS(FB_ARRAY_ROW)};

}  // namespace

Reservoirs::Reservoirs(const TechniqueTools& tools, bool indirect)
    : memory_(tools.device, tools.table, indirect ? std::span<const ArrayRow>(kIndirectRows) : kRows, "restir reset"),
      indirect_(indirect) {}

void Reservoirs::prepare(const TechniqueFrame& frame, std::uint32_t seen_ways, std::byte* block) {
  shared::RestirConstants constants{};
  copy_settings(frame.settings, constants);
  constants.seen_stride = seen_stride(frame.lit, frame.settings, frame.medium());
  constants.seen_ways = seen_ways;
  const bool fresh = memory_.begin_frame(frame.lit) || frame.cut;
  constants.now = memory_.now(shared::kRestirReservoirs);
  constants.former = fresh ? shared::kNoIndex : memory_.former(shared::kRestirReservoirs);
  std::memcpy(block + shared::kRestirConstantsAt, &constants, sizeof(constants));
  spatial_ = frame.settings.restir_neighbors > 0;
  boiling_ = frame.settings.restir_boiling > 0;
}

void Reservoirs::add_before(const TechniquePasses& passes) {
  memory_.add_reset(passes.list);
  const uvec2 groups = groups_over(passes.size, 8);
  passes.list.dispatch("restir candidates", PassKind::kEstimator,
                       passes.shaders.get("restir_candidates", passes.variant), groups);
  if (boiling_) add_boiling(passes, "restir boiling", "restir_boiling");
  if (spatial_)
    passes.list.dispatch("restir spatial", PassKind::kEstimator, passes.shaders.get("restir_spatial", passes.variant),
                         groups);
}

void Reservoirs::add_after(const TechniquePasses& passes) {
  if (!indirect_ || passes.bounces < 2) return;
  const uvec2 groups = groups_over(passes.size, 8);
  passes.list.dispatch("indirect over time", PassKind::kEstimator,
                       passes.shaders.get("restir_indirect_time", passes.variant), groups);
  if (boiling_) add_boiling(passes, "indirect boiling", "restir_indirect_boiling");
  passes.list.dispatch("indirect spatial", PassKind::kEstimator,
                       passes.shaders.get("restir_indirect_space", passes.variant), groups);
}

void Reservoirs::add_boiling(const TechniquePasses& passes, const char* name, const char* shader) {
  passes.list.dispatch(name, PassKind::kEstimator, passes.shaders.get(shader),
                       groups_over(groups_over(passes.size, 8), 8));
}

}  // namespace fb::render
