// Progressive spatio-temporal filtering (Pantaleoni 2020): fields of light in a hash grid, as control variate, to draw
// directions by, and, biased, in the place of paths. Layouts:
// Shaders/estimators/pstf/.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/log.h"
#include "estimators/pstf/pstf.h"
#include "render/techniques/seen_grid.h"
#include "render/techniques/technique.h"
#include "render/techniques/technique_memory.h"

namespace fb::render {
namespace {

constexpr ArrayRow kPstfRows[]{FB_PSTF_ARRAYS(FB_ARRAY_ROW)};
constexpr std::uint64_t kPstfTail = shared::kPstfTailWords * sizeof(std::uint32_t);
constexpr std::uint32_t kFoldersOfCells = 32;  // workgroups of 64 invocations, which walk the list of touched cells

enum class PstfKind { kControl, kGuided, kBiased };

class PstfTechnique : public Technique {
 public:
  PstfTechnique(const TechniqueTools& tools, std::string_view name, PstfKind kind)
      : name_(name),
        kind_(kind),
        uniform_(tools.device, gpu::BufferUse::kUniform, shared::kPstfConstantsAt + sizeof(shared::PstfConstants),
                 "constants of pstf"),
        memory_(tools.device, tools.table, kPstfRows, "pstf reset") {
    if (find_technique(name)->wants_lights) seen_.emplace(tools);
    tools.table.set_uniform(shared::kSetTechnique, uniform_);
  }
  void prepare(const TechniqueFrame& frame) override {
    const RenderSettings& s = frame.settings;
    ends_in_field_ = s.pstf_vertex == 2;
    gaussians_ = kind_ != PstfKind::kGuided || s.pstf_gaussians == 0 ? 0 : s.pstf_gaussians <= 4 ? 4 : 8;
    lane_of_sample_ = s.pstf_em != 0;
    two_level_ = s.pstf_two_level > 0;
    choose_size(s.pstf_cells);
    if (memory_.begin_frame()) {
      frame_ = 0;
      if (seen_) seen_->forget();
    }
    ++frame_;
    shared::PstfConstants constants{};
    copy_settings(s, constants);
    constants.pstf_cells = static_cast<int>(cells_);
    constants.cell_angle = std::max(std::tan(radians(s.pstf_angle)), s.pstf_pixels * frame.pixel_tangent);
    constants.frame_number = frame_;
    constants.seen_stride = seen_stride(frame.lit, s, frame.medium());
    if (seen_) constants.seen_ways = seen_->begin_frame();
    std::memcpy(static_cast<std::byte*>(uniform_.mapped()) + shared::kPstfConstantsAt, &constants, sizeof(constants));
  }
  void add_passes(const TechniquePasses& passes) override {
    memory_.add_reset(passes.list);
    if (seen_) seen_->add_reset(passes.list);
    PathSpecs specs;
    const std::uint32_t second = kind_ == PstfKind::kGuided ? gaussians_ : std::uint32_t{two_level_};
    specs.surfaces = specs.medium = {kind_ == PstfKind::kBiased && ends_in_field_, second};
    add_paths_pass(passes, name_, specs);
    if (seen_) seen_->add_fold(passes.list, passes.shaders);
    const auto change_pass = [&](const char* label, bool sweeps) {
      Variant of_changes;
      of_changes.technique = {sweeps};
      passes.list.dispatch(label, PassKind::kEstimator, passes.shaders.get("pstf_change", of_changes),
                           {kFoldersOfCells, 1});
    };
    change_pass("pstf change", false);
    Variant variant;
    variant.technique = {has_trees()};
    passes.list.dispatch("pstf fields", PassKind::kEstimator, passes.shaders.get("pstf_fold", variant),
                         {kFoldersOfCells, 1});
    change_pass("pstf sweep", true);
    if (gaussians_ == 0) return;
    variant.technique = {lane_of_sample_, gaussians_};
    passes.list.dispatch("pstf gaussians", PassKind::kEstimator, passes.shaders.get("pstf_gaussians", variant),
                         {kFoldersOfCells, 1});
  }
  void forget() override { memory_.forget(); }
  std::uint32_t salt() const override { return frame_; }
  std::uint64_t bytes() const override { return memory_.bytes() + (seen_ ? seen_->bytes() : 0); }

 private:
  // The power of two that is asked for, or the largest that the device binds.
  void choose_size(int wanted) {
    const std::uint64_t asked = std::bit_ceil(static_cast<std::uint64_t>(wanted));
    std::uint64_t most = memory_.most_elements(shared::kPstfSums, kPstfTail);
    for (const std::uint32_t array : {shared::kPstfCells, shared::kPstfTrees, shared::kPstfSamples})
      most = std::min(most, memory_.most_elements(array));
    if (gaussians_ > 0) most = std::min(most, memory_.most_elements(shared::kPstfGaussians) / gaussians_);
    const auto cells = static_cast<std::uint32_t>(std::min(asked, std::bit_floor(most)));
    memory_.set_count(shared::kPstfCells, cells);
    memory_.set_count(shared::kPstfSums, cells, kPstfTail);
    for (const std::uint32_t array : {shared::kPstfTrees, shared::kPstfTreeSums})
      memory_.set_count(array, has_trees() ? cells : 0);
    for (const std::uint32_t array : {shared::kPstfGaussians, shared::kPstfGaussianSums})
      memory_.set_count(array, std::uint64_t{cells} * gaussians_);
    memory_.set_count(shared::kPstfSamples, gaussians_ > 0 ? cells : 0);
    if (std::exchange(cells_, cells) != cells && cells < asked)
      log_warning("r_pstf_cells {}: the device has room for {}", wanted, cells);
  }

  bool has_trees() const { return kind_ == PstfKind::kGuided && gaussians_ == 0; }

  std::string name_;
  PstfKind kind_;
  gpu::Buffer uniform_;
  TechniqueMemory memory_;
  std::optional<SeenGrid> seen_;  // where it looks for light, too
  bool ends_in_field_ = false;
  bool two_level_ = false;
  std::uint32_t gaussians_ = 0;  // of a cell's mixture; 0: it has a tree, or none
  bool lane_of_sample_ = true;   // of the pass that teaches them
  std::uint32_t cells_ = 0;
  std::uint32_t frame_ = 0;  // since it forgot
};

template <PstfKind kKind>
std::unique_ptr<Technique> make_pstf(const TechniqueTools& tools, std::string_view name) {
  return std::make_unique<PstfTechnique>(tools, name, kKind);
}

}  // namespace

extern constinit const TechniqueInfo kPstfCv{
    .name = "pstf_cv",
    .description =
        "pt with a control variate of what a field of light in the world knows (progressive spatio-temporal "
        "filtering: Pantaleoni 2020); unbiased for paths of at most r_bounces reflections",
    .bias = Bias::kUnbiased,
    .make = make_pstf<PstfKind::kControl>,
    .frames = Frames::kLearning,
    .views = shared::kViewOfPstf};
extern constinit const TechniqueInfo kPstfCvNee{
    .name = "pstf_cv_nee",
    .description = "pstf_cv that looks for lights as nee does: the control variate is of what this leaves; unbiased",
    .bias = Bias::kUnbiased,
    .make = make_pstf<PstfKind::kControl>,
    .frames = Frames::kLearning,
    .wants_lights = true,
    .views = shared::kViewOfPstf};
extern constinit const TechniqueInfo kPstfIs{
    .name = "pstf_is",
    .description =
        "pt that draws half of its directions from trees in the world, which learn light times BSDF (Pantaleoni 2020); "
        "unbiased for paths of at most r_bounces reflections",
    .bias = Bias::kUnbiased,
    .make = make_pstf<PstfKind::kGuided>,
    .frames = Frames::kLearning,
    .views = shared::kViewOfPstf};
extern constinit const TechniqueInfo kPstfIsNee{
    .name = "pstf_is_nee",
    .description = "pstf_is that looks for lights as nee does, and learns what this leaves; unbiased",
    .bias = Bias::kUnbiased,
    .make = make_pstf<PstfKind::kGuided>,
    .frames = Frames::kLearning,
    .wants_lights = true,
    .views = shared::kViewOfPstf};
extern constinit const TechniqueInfo kPstfIsCv{
    .name = "pstf_is_cv",
    .description = "pstf_is with the difference of its two densities as a control variate; unbiased",
    .bias = Bias::kUnbiased,
    .make = make_pstf<PstfKind::kGuided>,
    .frames = Frames::kLearning,
    .views = shared::kViewOfPstf};
extern constinit const TechniqueInfo kPstfIsCvNee{
    .name = "pstf_is_cv_nee",
    .description = "pstf_is_cv that looks for lights as nee does; unbiased",
    .bias = Bias::kUnbiased,
    .make = make_pstf<PstfKind::kGuided>,
    .frames = Frames::kLearning,
    .wants_lights = true,
    .views = shared::kViewOfPstf};
extern constinit const TechniqueInfo kPstfB{
    .name = "pstf_b",
    .description =
        "pstf_cv of whose first or second vertices the field says most of the light: of any number of reflections, "
        "averaged over cells, some frames late",
    .bias = Bias::kBiased,
    .make = make_pstf<PstfKind::kBiased>,
    .frames = Frames::kCorrelated,
    .views = shared::kViewOfPstf};
extern constinit const TechniqueInfo kPstfBNee{
    .name = "pstf_b_nee",
    .description = "pstf_b that looks for lights as nee does; biased like it",
    .bias = Bias::kBiased,
    .make = make_pstf<PstfKind::kBiased>,
    .frames = Frames::kCorrelated,
    .wants_lights = true,
    .views = shared::kViewOfPstf};

}  // namespace fb::render
