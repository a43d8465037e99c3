// Markov chain path guiding under a control variate of a field of light: mcpg's memories, and cells of pstf beside
// them.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>

#include "base/log.h"
#include "estimators/pstf/pstf.h"
#include "render/techniques/guided_technique.h"

namespace fb::render {
namespace {

constexpr ArrayRow kAllPstfRows[]{FB_PSTF_ARRAYS(FB_ARRAY_ROW)};
constexpr ArrayRow kControlRows[]{kAllPstfRows[0], kAllPstfRows[1]};
static_assert(sizeof(shared::GuideConstants) <= shared::kPstfConstantsAt);

constexpr std::size_t kBlockBytes = shared::kPstfConstantsAt + sizeof(shared::PstfConstants);
constexpr std::uint64_t kTail = shared::kPstfTailWords * sizeof(std::uint32_t);
constexpr std::uint32_t kGroups = 32;  // of 64 invocations, which walk the list of touched cells

class McpgCvTechnique : public GuidedTechnique {
 public:
  McpgCvTechnique(const TechniqueTools& tools, std::string_view name)
      : GuidedTechnique(tools, name, kBlockBytes), cells_(tools.device, tools.table, kControlRows, "pstf reset") {}
  void prepare(const TechniqueFrame& frame) override {
    GuidedTechnique::prepare(frame);
    const RenderSettings& s = frame.settings;
    choose_size(s.pstf_cells);
    if (cells_.begin_frame()) frame_ = 0;
    ++frame_;
    shared::PstfConstants constants{};
    copy_settings(s, constants);
    constants.pstf_cells = static_cast<int>(count_);
    constants.cell_angle = std::max(std::tan(radians(s.pstf_angle)), s.pstf_pixels * frame.pixel_tangent);
    constants.frame_number = frame_;
    std::memcpy(block() + shared::kPstfConstantsAt, &constants, sizeof(constants));
  }
  void add_passes(const TechniquePasses& passes) override {
    GuidedTechnique::add_passes(passes);
    const auto pass = [&](const char* label, const char* shader, bool special) {
      Variant variant;
      variant.technique = {special};
      passes.list.dispatch(label, PassKind::kEstimator, passes.shaders.get(shader, variant), {kGroups, 1});
    };
    pass("pstf change", "pstf_change", false);
    pass("pstf fields", "pstf_fold", false);
    pass("pstf sweep", "pstf_change", true);
  }
  void forget() override {
    GuidedTechnique::forget();
    cells_.forget();
  }
  std::uint64_t bytes() const override { return GuidedTechnique::bytes() + cells_.bytes(); }

 protected:
  void add_before_paths(const TechniquePasses& passes) override { cells_.add_reset(passes.list); }

 private:
  void choose_size(int wanted) {
    const std::uint64_t asked = std::bit_ceil(static_cast<std::uint64_t>(wanted));
    const std::uint64_t most =
        std::min(cells_.most_elements(shared::kPstfSums, kTail), cells_.most_elements(shared::kPstfCells));
    const auto count = static_cast<std::uint32_t>(std::min(asked, std::bit_floor(most)));
    cells_.set_count(shared::kPstfCells, count);
    cells_.set_count(shared::kPstfSums, count, kTail);
    if (count != count_ && count < asked) log_warning("r_pstf_cells {}: the device has room for {}", wanted, count);
    count_ = count;
  }

  TechniqueMemory cells_;
  std::uint32_t count_ = 0;
  std::uint32_t frame_ = 0;  // since the cells were forgotten
};

std::unique_ptr<Technique> make_mcpg_cv(const TechniqueTools& tools, std::string_view name) {
  return std::make_unique<McpgCvTechnique>(tools, name);
}

}  // namespace

extern constinit const TechniqueInfo kMcpgCv{
    .name = "mcpg_cv",
    .description =
        "mcpg under a control variate of what a field of light in the world knows (pstf_cv); unbiased for paths of at "
        "most r_bounces reflections",
    .bias = Bias::kUnbiased,
    .make = make_mcpg_cv,
    .frames = Frames::kLearning,
    .views = shared::kViewOfMcpg,
    .stands_on = "pstf"};

}  // namespace fb::render
