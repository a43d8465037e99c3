// Technique `nee`: paths that look for lights, and the memory of what shadow rays reached.
#include <cstring>
#include <memory>

#include "estimators/nee/nee.h"
#include "render/techniques/path_technique.h"
#include "render/techniques/seen_grid.h"

namespace fb::render {
namespace {

class NeeTechnique : public PathTechnique {
 public:
  NeeTechnique(const TechniqueTools& tools, std::string_view name)
      : PathTechnique(name),
        uniform_(tools.device, gpu::BufferUse::kUniform, sizeof(shared::NeeConstants), "constants of nee"),
        seen_(tools) {
    tools.table.set_uniform(shared::kSetTechnique, uniform_);
  }
  void prepare(const TechniqueFrame& frame) override {
    shared::NeeConstants constants{};
    copy_settings(frame.settings, constants);
    constants.seen_stride = seen_stride(frame.lit, frame.settings, frame.medium());
    constants.seen_ways = seen_.begin_frame();
    std::memcpy(uniform_.mapped(), &constants, sizeof(constants));
    frame_ = seen_.fresh() ? 1 : frame_ + 1;
  }
  void add_passes(const TechniquePasses& passes) override {
    seen_.add_reset(passes.list);
    PathTechnique::add_passes(passes);
    seen_.add_fold(passes.list, passes.shaders);
  }
  void forget() override { seen_.forget(); }
  std::uint32_t salt() const override { return frame_; }
  std::uint64_t bytes() const override { return seen_.bytes(); }

 private:
  gpu::Buffer uniform_;
  SeenGrid seen_;
  std::uint32_t frame_ = 0;  // since it forgot
};

std::unique_ptr<Technique> make_nee(const TechniqueTools& tools, std::string_view name) {
  return std::make_unique<NeeTechnique>(tools, name);
}

}  // namespace

extern constinit const TechniqueInfo kNee{
    .name = "nee",
    .description =
        "next-event estimation: of the lights of a list and the suns one, by what it would bring and by what rays "
        "reached before; and the BSDF; unbiased for paths of at most r_bounces reflections",
    .bias = Bias::kUnbiased,
    .make = make_nee,
    .frames = Frames::kLearning,
    .wants_lights = true};

}  // namespace fb::render
