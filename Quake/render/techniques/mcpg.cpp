// Markov chain path guiding (`mcpg`, `mcpg_nee`, `mcpg_tail`, `mcpg_nee_tail`): what it remembers from frame to frame
// (the table of states, the irradiance cache) and, where frames must not depend on the order of threads, the proposals
// of a frame. Layouts: Shaders/estimators/mcpg/.
#include "render/techniques/guided_technique.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <utility>

#include "base/log.h"

namespace fb::render {
namespace {

constexpr ArrayRow kMcpgRows[]{FB_MCPG_ARRAYS(FB_ARRAY_ROW)};
constexpr float kMostShare = 0.98f;  // of guided samples: without any of the BSDF's, what no lobe covers would be lost
constexpr std::uint32_t kFoldGroups = 64;    // of 64 invocations, which walk the list of touched cells
constexpr std::uint32_t kGroupsWide = 4096;  // of the two-dimensional dispatch over proposals
constexpr std::uint32_t kMaxLobes = 32;      // of the mixture: they are kept in registers or local memory

std::uint32_t power_of_two(int wanted) { return std::bit_ceil(static_cast<std::uint32_t>(std::max(wanted, 1))); }

}  // namespace

GuidedTechnique::GuidedTechnique(const TechniqueTools& tools, std::string_view name, std::size_t block_bytes)
    : device_(tools.device),
      name_(name),
      memory_(tools.device, tools.table, kMcpgRows, "guide reset"),
      uniform_(tools.device, gpu::BufferUse::kUniform, block_bytes, "constants of path guiding") {
  tools.table.set_uniform(shared::kSetTechnique, uniform_);
  if (find_technique(name)->wants_lights) seen_.emplace(tools);
}

// Tables of the powers of two that are asked for, or the largest that the device binds.
void GuidedTechnique::choose_sizes(const RenderSettings& settings) {
  const auto table = [&](int wanted, std::uint32_t binding, std::uint64_t extra) {
    const std::uint64_t most = std::bit_floor(memory_.most_elements(binding, extra));
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(power_of_two(wanted), most));
  };
  const std::uint32_t states = table(settings.mc_states, shared::kGuideStates, 0);
  const std::uint64_t behind = (std::uint64_t{shared::kTailWords} + states) * 4;
  const std::uint32_t cells = table(settings.mc_cells, shared::kGuideCache, behind);
  memory_.set_count(shared::kGuideStates, states);
  memory_.set_count(shared::kGuideCache, cells, behind);
  memory_.set_count(shared::kGuideProposals, resolve_ ? vertices_ : 0);
  if (states == state_count_ && cells == cell_count_) return;
  if (states < power_of_two(settings.mc_states) || cells < power_of_two(settings.mc_cells))
    log_warning("r_mc_states {}, r_mc_cells {}: the device has room for {} and {}", settings.mc_states,
                settings.mc_cells, states, cells);
  state_count_ = states;
  cell_count_ = cells;
  said_size_ = false;
}

void GuidedTechnique::fill_constants(const TechniqueFrame& frame) {
  const RenderSettings& s = frame.settings;
  shared::GuideConstants c{};
  copy_settings(s, c);
  times_[frame_ % shared::kPastFrames] = frame.snapshot.time;
  for (std::uint32_t age = 0; age < std::min(frame_, shared::kPastFrames); ++age) {
    const double elapsed = frame.snapshot.time - times_[(frame_ - age) % shared::kPastFrames];
    c.elapsed[age / 4][static_cast<int>(age % 4)] = static_cast<float>(std::clamp(elapsed, 0.0, 1.0));
  }
  const float angle = std::tan(radians(s.mc_angle));
  c.adaptive_angle = std::max(angle, s.mc_pixels * frame.pixel_tangent);
  c.cache_angle = std::max(2 * angle, s.mc_cache_pixels * frame.pixel_tangent);
  c.prior_extent = s.mc_radius * s.mc_radius;
  c.mc_share = std::min(s.mc_share, kMostShare);
  c.mc_share_max = std::min(s.mc_share_max, kMostShare);
  c.mc_share_min = std::min(s.mc_share_min, kMostShare);
  c.mc_states = static_cast<int>(state_count_);
  c.mc_cells = static_cast<int>(cell_count_);
  // A cell's sums have room for 4096 samples of the largest radiance: those of 16 paths in each of 16x16 pixels.
  const int least_train = static_cast<int>(most_samples(s) / 16);
  c.mc_train = std::max(s.mc_train, least_train);
  c.mc_tail_train = std::max(s.mc_tail_train, least_train);
  c.frame_number = frame_;
  c.vertices = static_cast<std::uint32_t>(vertices_);
  c.seen_stride = seen_stride(frame.lit, s, frame.medium());
  if (seen_) c.seen_ways = seen_ways_ = seen_->begin_frame();
  std::memcpy(uniform_.mapped(), &c, sizeof(c));
}

// Alber 2025: Table 1, Alg. 1 to 3 and Section 5, as far as they say. What they do not say is as in the sources of
// merian-quake, by the paper's author: the probability of the BSDF, "low" in the paper, the static grid's width, alpha.
RenderSettings GuidedTechnique::adapt(RenderSettings settings) const {
  if (settings.mc_paper == 0) return settings;
  settings.mc_bucket = 1;
  settings.mc_accesses = settings.mc_paper > 1 ? settings.mc_paper : 5;
  settings.mc_adaptive = 0.7f;
  settings.mc_wider = 1;
  settings.mc_jitter = 1;
  settings.mc_pixels = 0;
  settings.mc_radius = 1;
  settings.mc_learn_share = 0;
  settings.mc_share = 0.85f;
  settings.mc_static_width = 25.3f;
  settings.mc_alpha = 0.01f;
  settings.mc_power = 1;
  settings.mc_share_score = 0;
  settings.mc_train = 1;
  settings.mc_in_world = 0;
  settings.mc_loss = 1;
  settings.mc_predict = 1;
  settings.mc_parts = 1;
  return settings;
}

void GuidedTechnique::prepare(const TechniqueFrame& frame) {
  const RenderSettings& s = frame.settings;
  resolve_ = s.deterministic != 0;
  const int parts = resolve_ ? 4 : device_.is_software() ? 1 : 2;
  parts_ = static_cast<std::uint32_t>(s.mc_parts > 0 ? s.mc_parts : parts);
  guides_fog_ = !seen_ || s.mc_fog != 0 || frame.turbid;  // no straight ray finds what lights a liquid from above
  bucket_ = std::bit_floor(static_cast<std::uint32_t>(s.mc_bucket));
  accesses_ = std::min(static_cast<std::uint32_t>(s.mc_accesses), kMaxLobes / bucket_);
  vertices_ = static_cast<std::uint64_t>(frame.lit.x) * frame.lit.y * most_samples(s) *
              static_cast<std::uint64_t>(s.bounces + (frame.medium() ? s.medium_bounces : 0));
  choose_sizes(s);
  if (memory_.begin_frame()) {
    frame_ = 0;
    if (seen_) seen_->forget();
  }
  if (!std::exchange(said_size_, true))
    log_info("path guiding: {} states and {} cached cells in {} MB", state_count_, cell_count_, bytes() >> 20);
  ++frame_;
  fill_constants(frame);
}

void GuidedTechnique::add_passes(const TechniquePasses& passes) {
  memory_.add_reset(passes.list);
  if (seen_) seen_->add_reset(passes.list);
  add_before_paths(passes);
  PathSpecs specs{{resolve_, accesses_, bucket_, 1}, {}, {resolve_, accesses_, bucket_, guides_fog_}};
  // Paths that look for light alone are nearly as good.
  if (seen_ && !resolve_) specs.meanwhile = {0, 1, 1, 0};
  specs.parts = parts_;
  std::function<void(gpu::Commands&)> resolve;
  if (resolve_) {
    resolve = [&pipeline = passes.shaders.get("mcpg_resolve_states"),
               groups = static_cast<std::uint32_t>((vertices_ + 63) / 64)](gpu::Commands& commands) {
      commands.dispatch(pipeline, std::min(groups, kGroupsWide), (groups + kGroupsWide - 1) / kGroupsWide);
      commands.barrier();
    };
  }
  specs.between_parts = resolve;
  add_paths_pass(passes, name_, specs);
  if (seen_) seen_->add_fold(passes.list, passes.shaders);
  if (resolve) passes.list.add("guide states", PassKind::kEstimator, resolve);
  passes.list.dispatch("guide cache", PassKind::kEstimator, passes.shaders.get("mcpg_fold_cache"), {kFoldGroups, 1});
}

namespace {

// Paths end in the irradiance cache: one reflection, and one more on paths that go on (r_bounces counts both). A tail
// that the cache did not fill would be none.
class GuidedTailTechnique : public GuidedTechnique {
 public:
  using GuidedTechnique::GuidedTechnique;
  RenderSettings adapt(RenderSettings settings) const override {
    settings = GuidedTechnique::adapt(settings);
    settings.bounces = settings.bounces > 0 ? 2 : 0;
    settings.mc_cache = 1;
    return settings;
  }
};

template <typename T>
std::unique_ptr<Technique> make(const TechniqueTools& tools, std::string_view name) {
  return std::make_unique<T>(tools, name);
}

}  // namespace

extern constinit const TechniqueInfo kMcpg{
    .name = "mcpg",
    .description = "Markov chain path guiding (Alber 2025); unbiased for paths of at most r_bounces reflections",
    .bias = Bias::kUnbiased,
    .make = make<GuidedTechnique>,
    .frames = Frames::kLearning,
    .views = shared::kViewOfMcpg};
extern constinit const TechniqueInfo kMcpgNee{
    .name = "mcpg_nee",
    .description = "mcpg that looks for lights as nee does, and learns what this leaves; unbiased like both",
    .bias = Bias::kUnbiased,
    .make = make<GuidedTechnique>,
    .frames = Frames::kLearning,
    .wants_lights = true,
    .views = shared::kViewOfMcpg};
extern constinit const TechniqueInfo kMcpgTail{
    .name = "mcpg_tail",
    .description =
        "mcpg with one reflection traced (r_bounces says no more than whether there is any) and the "
        "irradiance cache beyond it: a Lambertian tail of any number of reflections, averaged over cells, "
        "some frames late",
    .bias = Bias::kBiased,
    .make = make<GuidedTailTechnique>,
    .frames = Frames::kLearning,
    .views = shared::kViewOfMcpg};
extern constinit const TechniqueInfo kMcpgNeeTail{
    .name = "mcpg_nee_tail",
    .description =
        "mcpg_nee at the first vertex, and the irradiance cache beyond it, as in mcpg_tail: a Lambertian tail of any "
        "number of reflections",
    .bias = Bias::kBiased,
    .make = make<GuidedTailTechnique>,
    .frames = Frames::kLearning,
    .wants_lights = true,
    .views = shared::kViewOfMcpg};

}  // namespace fb::render
