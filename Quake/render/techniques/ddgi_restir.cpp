// Probes behind the first reflection, resampled over pixels and frames (Majercik 2022). Layouts:
// Shaders/estimators/ddgi/.
#include <cstring>
#include <memory>
#include <string_view>

#include "estimators/ddgi/ddgi.h"
#include "render/techniques/probes.h"
#include "render/techniques/seen_grid.h"
#include "shared/scene_gpu.h"

namespace fb::render {
namespace {

constexpr ArrayRow kLitRows[]{FB_DDGI_RESERVOIR_ARRAYS(FB_ARRAY_ROW)};

class DdgiRestirTechnique : public Technique {
 public:
  explicit DdgiRestirTechnique(const TechniqueTools& tools)
      : uniform_(tools.device, gpu::BufferUse::kUniform, sizeof(shared::DdgiConstants), "constants of ddgi"),
        seen_(tools),
        probes_(tools, true),
        reservoirs_(tools.device, tools.table, kLitRows, "reservoirs reset") {
    tools.table.set_uniform(shared::kSetTechnique, uniform_);
  }
  void prepare(const TechniqueFrame& frame) override {
    shared::DdgiConstants constants = probes_.prepare(frame, seen_);
    const bool fresh = reservoirs_.begin_frame(frame.lit) || frame.cut;
    constants.reservoirs_now = reservoirs_.now(shared::kDdgiReservoirs);
    constants.reservoirs_former = fresh ? shared::kNoIndex : reservoirs_.former(shared::kDdgiReservoirs);
    std::memcpy(uniform_.mapped(), &constants, sizeof(constants));
  }
  void add_passes(const TechniquePasses& passes) override {
    seen_.add_reset(passes.list);
    reservoirs_.add_reset(passes.list);
    probes_.add_passes(passes);
    const uvec2 groups = groups_over(passes.size, 8);
    passes.list.dispatch("candidates", PassKind::kEstimator, passes.shaders.get("ddgi_candidates", passes.variant),
                         groups);
    Variant paths = passes.variant;
    paths.show_view = passes.show_view;
    passes.list.dispatch("paths", PassKind::kEstimator, passes.shaders.get("ddgi_restir", paths), groups);
    if (passes.medium) {  // light of the medium is not resampled
      Variant medium = passes.variant;
      medium.one_bounce = passes.medium_bounces == 1;
      passes.list.dispatch("fog", PassKind::kEstimator, passes.shaders.get("ddgi_plus_medium", medium), passes.medium);
    }
    seen_.add_fold(passes.list, passes.shaders);
  }
  void forget() override {
    seen_.forget();
    probes_.forget();
    reservoirs_.forget();
  }
  std::uint32_t salt() const override { return probes_.frame(); }
  std::uint64_t bytes() const override { return seen_.bytes() + probes_.bytes() + reservoirs_.bytes(); }

 private:
  gpu::Buffer uniform_;
  SeenGrid seen_;
  Probes probes_;
  TechniqueMemory reservoirs_;
};

std::unique_ptr<Technique> make_resampled(const TechniqueTools& tools, std::string_view /*name*/) {
  return std::make_unique<DdgiRestirTechnique>(tools);
}

}  // namespace

extern constinit const TechniqueInfo kDdgiRestir{
    .name = "ddgi_restir",
    .description =
        "light of first vertices by reservoirs over all surfaces, chosen by what these emit and what probes know that "
        "they reflect (Majercik 2022); biased as ddgi_plus is",
    .bias = Bias::kBiased,
    .make = make_resampled,
    .frames = Frames::kCorrelated,
    .wants_lights = true,
    .wants_previous_gbuffer = true,
    .views = shared::kViewOfDdgi};

}  // namespace fb::render
