// Screen-space Markov chain mixtures (Dittebrandt 2023). Layouts: Shaders/estimators/ssmm/.
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

#include "estimators/ssmm/ssmm.h"
#include "render/techniques/path_technique.h"
#include "render/techniques/seen_grid.h"
#include "render/techniques/technique_memory.h"

namespace fb::render {
namespace {

constexpr ArrayRow kSsmmRows[]{FB_SSMM_ARRAYS(FB_ARRAY_ROW)};

class SsmmTechnique : public PathTechnique {
 public:
  SsmmTechnique(const TechniqueTools& tools, std::string_view name, bool looks_for_light)
      : PathTechnique(name),
        uniform_(tools.device, gpu::BufferUse::kUniform, sizeof(shared::SsmmConstants), "constants of ssmm"),
        memory_(tools.device, tools.table, kSsmmRows, "ssmm reset") {
    if (looks_for_light) seen_.emplace(tools);
    tools.table.set_uniform(shared::kSetTechnique, uniform_);
  }
  void prepare(const TechniqueFrame& frame) override {
    shared::SsmmConstants constants{};
    copy_settings(frame.settings, constants);
    if (constants.ssmm_keep > 1) constants.ssmm_keep = seen_ ? 0 : 1;
    if (seen_) {
      constants.seen_ways = seen_->begin_frame();
      constants.seen_stride = seen_stride(frame.lit, frame.settings, frame.medium());
    }
    world_ = frame.settings.ssmm_world != 0;
    for (const std::uint32_t array : {shared::kSsmmWorld, shared::kSsmmClaims})
      memory_.set_count(array, world_ ? shared::kSsmmCells : 0);
    memory_.set_count(shared::kSsmmClaimed, world_ ? shared::kSsmmClaimedWords + shared::kSsmmCells : 0);
    const bool fresh = memory_.begin_frame(frame.lit);
    constants.known = fresh || frame.cut ? 0 : 1;
    frame_ = (seen_ ? seen_->fresh() : constants.known == 0) ? 1 : frame_ + 1;
    std::memcpy(uniform_.mapped(), &constants, sizeof(constants));
  }
  void add_passes(const TechniquePasses& passes) override {
    if (seen_) seen_->add_reset(passes.list);
    memory_.add_reset(passes.list);
    passes.list.add("ssmm exchange", PassKind::kEstimator,
                    [this, &exchange = passes.shaders.get("ssmm_exchange"),
                     groups = groups_over(passes.size, 8)](gpu::Commands& commands) {
                      if (world_) {
                        constexpr std::uint32_t kNoneClaimed[shared::kSsmmClaimedWords]{0, 1, 1, 0};
                        commands.update(memory_.buffer(shared::kSsmmClaimed), kNoneClaimed, 0);
                        commands.barrier();
                      }
                      commands.dispatch(exchange, groups.x, groups.y);
                      commands.barrier();
                    });
    PathTechnique::add_passes(passes);
    if (world_)
      passes.list.dispatch(
          "ssmm keep", PassKind::kEstimator, passes.shaders.get("ssmm_keep"),
          AskedGroups{&memory_.buffer(shared::kSsmmClaimed), 0, uvec2(shared::kSsmmCells / shared::kSsmmKeepGroup, 1)});
    if (seen_) seen_->add_fold(passes.list, passes.shaders);
  }
  void forget() override {
    if (seen_) seen_->forget();
    memory_.forget();
  }
  std::uint32_t salt() const override { return frame_; }
  std::uint64_t bytes() const override { return memory_.bytes() + (seen_ ? seen_->bytes() : 0); }

 private:
  gpu::Buffer uniform_;
  TechniqueMemory memory_;
  std::optional<SeenGrid> seen_;  // where it looks for light, too
  bool world_ = false;            // states are kept in the world, too
  std::uint32_t frame_ = 0;       // since it forgot
};

template <bool kLooksForLight>
std::unique_ptr<Technique> make_ssmm(const TechniqueTools& tools, std::string_view name) {
  return std::make_unique<SsmmTechnique>(tools, name, kLooksForLight);
}

}  // namespace

extern constinit const TechniqueInfo kSsmm{
    .name = "ssmm",
    .description =
        "pt whose first vertices sample lobes that pixels of a tile hold and exchange (screen-space Markov chain "
        "mixtures: Dittebrandt 2023); unbiased for paths of at most r_bounces reflections where r_ssmm_shuffle is 1",
    .bias = Bias::kUnbiased,
    .make = make_ssmm<false>,
    .frames = Frames::kLearning,
    .views = shared::kViewOfSsmm};
extern constinit const TechniqueInfo kSsmmNee{
    .name = "ssmm_nee",
    .description = "ssmm, and every vertex looks for a light, as in nee; unbiased as ssmm is",
    .bias = Bias::kUnbiased,
    .make = make_ssmm<true>,
    .frames = Frames::kLearning,
    .wants_lights = true,
    .views = shared::kViewOfSsmm};

}  // namespace fb::render
