// ReSTIR's techniques: reservoirs of light of every pixel, over frames and neighbours. Layouts:
// Shaders/estimators/restir/.
#include <cstring>
#include <memory>
#include <span>
#include <utility>

#include "estimators/restir/restir.h"
#include "render/techniques/path_technique.h"
#include "render/techniques/seen_grid.h"
#include "render/techniques/technique_memory.h"
#include "shared/scene_gpu.h"

namespace fb::render {
namespace {

constexpr ArrayRow kRows[]{FB_RESTIR_ARRAYS(FB_ARRAY_ROW)};
constexpr ArrayRow kIndirectRows[]{FB_RESTIR_ARRAYS(FB_ARRAY_ROW) FB_RESTIR_INDIRECT_ARRAYS(FB_ARRAY_ROW)};

class RestirTechnique : public PathTechnique {
 public:
  // `indirect`: light of two reflections is reused, too.
  RestirTechnique(const TechniqueTools& tools, std::string_view name, bool indirect)
      : PathTechnique(name),
        uniform_(tools.device, gpu::BufferUse::kUniform, sizeof(shared::RestirConstants), "constants of restir"),
        seen_(tools),
        memory_(tools.device, tools.table, indirect ? std::span<const ArrayRow>(kIndirectRows) : kRows, "restir reset"),
        indirect_(indirect) {
    tools.table.set_uniform(shared::kSetTechnique, uniform_);
  }
  void prepare(const TechniqueFrame& frame) override;
  void add_passes(const TechniquePasses& passes) override;
  void forget() override {
    seen_.forget();
    memory_.forget();
  }
  std::uint32_t salt() const override { return frame_; }
  std::uint64_t bytes() const override { return seen_.bytes() + memory_.bytes(); }

 private:
  gpu::Buffer uniform_;
  SeenGrid seen_;
  TechniqueMemory memory_;
  std::uint32_t frame_ = 0;  // since it forgot
  bool indirect_, spatial_ = true;
};

void RestirTechnique::prepare(const TechniqueFrame& frame) {
  shared::RestirConstants constants{};
  copy_settings(frame.settings, constants);
  constants.seen_stride = seen_stride(frame.lit, frame.settings, frame.medium());
  constants.seen_ways = seen_.begin_frame();
  const bool fresh = memory_.begin_frame(frame.lit) || frame.cut;
  constants.now = memory_.now(shared::kRestirReservoirs);
  constants.former = fresh ? shared::kNoIndex : memory_.former(shared::kRestirReservoirs);
  std::memcpy(uniform_.mapped(), &constants, sizeof(constants));
  spatial_ = frame.settings.restir_neighbors > 0;
  frame_ = seen_.fresh() ? 1 : frame_ + 1;
}

void RestirTechnique::add_passes(const TechniquePasses& passes) {
  seen_.add_reset(passes.list);
  memory_.add_reset(passes.list);
  Variant variant = passes.variant;
  variant.show_view = false;
  const uvec2 groups = groups_over(passes.size, 8);
  passes.list.dispatch("restir candidates", PassKind::kEstimator, passes.shaders.get("restir_candidates", variant),
                       groups);
  if (spatial_)
    passes.list.dispatch("restir spatial", PassKind::kEstimator, passes.shaders.get("restir_spatial", variant), groups);
  PathTechnique::add_passes(passes);
  seen_.add_fold(passes.list, passes.shaders);
  if (!indirect_ || passes.bounces < 2) return;
  for (const auto& [name, shader] : {std::pair{"indirect over time", "restir_indirect_time"},
                                     std::pair{"indirect spatial", "restir_indirect_space"}})
    passes.list.dispatch(name, PassKind::kEstimator, passes.shaders.get(shader, variant), groups);
}

template <bool kIndirect>
std::unique_ptr<Technique> make_restir(const TechniqueTools& tools, std::string_view name) {
  return std::make_unique<RestirTechnique>(tools, name, kIndirect);
}

}  // namespace

extern constinit const TechniqueInfo kRestirDi{
    .name = "restir_di",
    .description =
        "nee whose first vertex chooses its light by a reservoir over time and neighbours (ReSTIR: Bitterli 2020, Lin "
        "2022); unbiased for paths of at most r_bounces reflections where r_restir_mis and r_restir_visibility are 0",
    .bias = Bias::kUnbiased,
    .make = make_restir<false>,
    .frames = Frames::kCorrelated,
    .wants_lights = true,
    .wants_previous_gbuffer = true,
    .views = shared::kViewOfRestir};
extern constinit const TechniqueInfo kRestirGi{
    .name = "restir_gi",
    .description =
        "restir_di that reuses light of two reflections, too (Ouyang 2021, Lin 2022): unbiased where nothing moves and "
        "nothing is translucent, else late where such light comes into sight",
    .bias = Bias::kBiased,
    .make = make_restir<true>,
    .frames = Frames::kCorrelated,
    .wants_lights = true,
    .wants_previous_gbuffer = true,
    .views = shared::kViewOfRestir};

}  // namespace fb::render
