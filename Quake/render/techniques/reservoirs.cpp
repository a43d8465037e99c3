#include "render/techniques/reservoirs.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <vector>

#include "render/techniques/seen_grid.h"
#include "shared/scene_gpu.h"

namespace fb::render {
namespace {

constexpr ArrayRow kRows[]{FB_RESTIR_ARRAYS(FB_ARRAY_ROW)};
constexpr ArrayRow kIndirectRows[]{FB_RESTIR_ARRAYS(FB_ARRAY_ROW) FB_RESTIR_INDIRECT_ARRAYS(FB_ARRAY_ROW)};

// Directions of the suns that shine; zero where one does not.
ShiningSuns shining(const TechniqueFrame& frame) {
  ShiningSuns suns{};
  const std::vector<scene::Sun>& all = frame.snapshot.sky.suns;
  for (std::size_t i = 0; i < std::min(suns.size(), all.size()); ++i)
    if (frame.settings.emit_sun > 0 && all[i].irradiance != vec3(0.0f)) suns[i] = all[i].direction;
  return suns;
}

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
  const bool kept_alike = keeps_radiance_ == (frame.settings.restir_gi_radiance != 0);
  keeps_radiance_ = frame.settings.restir_gi_radiance != 0;
  constants.former_indirect = wrote_indirect_ && kept_alike ? constants.former : shared::kNoIndex;
  const ShiningSuns suns = shining(frame);
  for (std::size_t i = 0; i < suns.size(); ++i)
    if (suns[i] != vec3(0.0f) && suns[i] == suns_[i]) constants.former_suns |= 1u << i;
  suns_ = suns;
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
  wrote_indirect_ = indirect_ && passes.bounces > 1;
  if (!wrote_indirect_) return;
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
