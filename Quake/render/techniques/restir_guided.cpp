// ReSTIR over guided paths.
#include <memory>
#include <string_view>

#include "render/techniques/guided_technique.h"
#include "render/techniques/reservoirs.h"

namespace fb::render {
namespace {

static_assert(sizeof(shared::GuideConstants) <= shared::kRestirConstantsAt);

class RestirGuidedTechnique : public GuidedTechnique {
 public:
  RestirGuidedTechnique(const TechniqueTools& tools, std::string_view name)
      : GuidedTechnique(tools, name, Reservoirs::kBlockBytes), reservoirs_(tools, true) {}
  void prepare(const TechniqueFrame& frame) override {
    GuidedTechnique::prepare(frame);
    reservoirs_.prepare(frame, seen_ways(), block());
  }
  void add_passes(const TechniquePasses& passes) override {
    GuidedTechnique::add_passes(passes);
    reservoirs_.add_after(passes);
  }
  void forget() override {
    GuidedTechnique::forget();
    reservoirs_.forget();
  }
  std::uint64_t bytes() const override { return GuidedTechnique::bytes() + reservoirs_.bytes(); }

 protected:
  void add_before_paths(const TechniquePasses& passes) override { reservoirs_.add_before(passes); }

 private:
  Reservoirs reservoirs_;
};

std::unique_ptr<Technique> make_restir_guided(const TechniqueTools& tools, std::string_view name) {
  return std::make_unique<RestirGuidedTechnique>(tools, name);
}

}  // namespace

extern constinit const TechniqueInfo kRestirGuided{
    .name = "restir_guided",
    .description =
        "restir_gi whose paths are guided as mcpg_nee's: reservoirs take up what they find; unbiased where nothing "
        "moves, else late where light of two reflections comes into sight",
    .bias = Bias::kBiased,
    .make = make_restir_guided,
    .frames = Frames::kCorrelated,
    .wants_lights = true,
    .wants_previous_gbuffer = true,
    .views = shared::kViewOfRestir,
    .stands_on = "mcpg"};

}  // namespace fb::render
