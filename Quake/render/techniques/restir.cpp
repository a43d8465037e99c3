// ReSTIR's techniques whose paths go as their vertices scatter.
#include <memory>
#include <string_view>

#include "render/techniques/path_technique.h"
#include "render/techniques/reservoirs.h"
#include "render/techniques/seen_grid.h"

namespace fb::render {
namespace {

class RestirTechnique : public PathTechnique {
 public:
  RestirTechnique(const TechniqueTools& tools, std::string_view name, bool indirect)
      : PathTechnique(name),
        uniform_(tools.device, gpu::BufferUse::kUniform, Reservoirs::kBlockBytes, "constants of restir"),
        seen_(tools),
        reservoirs_(tools, indirect) {
    tools.table.set_uniform(shared::kSetTechnique, uniform_);
  }
  void prepare(const TechniqueFrame& frame) override {
    reservoirs_.prepare(frame, seen_.begin_frame(), static_cast<std::byte*>(uniform_.mapped()));
    frame_ = seen_.fresh() ? 1 : frame_ + 1;
  }
  void add_passes(const TechniquePasses& passes) override {
    seen_.add_reset(passes.list);
    reservoirs_.add_before(passes);
    PathTechnique::add_passes(passes);
    seen_.add_fold(passes.list, passes.shaders);
    reservoirs_.add_after(passes);
  }
  void forget() override {
    seen_.forget();
    reservoirs_.forget();
  }
  std::uint32_t salt() const override { return frame_; }
  std::uint64_t bytes() const override { return seen_.bytes() + reservoirs_.bytes(); }

 private:
  gpu::Buffer uniform_;
  SeenGrid seen_;
  Reservoirs reservoirs_;
  std::uint32_t frame_ = 0;  // since it forgot
};

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
