// Markov chain path guiding: what it remembers from frame to frame (the table of states, the irradiance cache) and,
// where frames must not depend on the order of threads, the proposals of a frame. Layouts: Shaders/shared/guide.h.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "base/log.h"
#include "render/techniques/seen_grid.h"
#include "render/techniques/technique.h"
#include "shared/guide.h"

namespace fb::render {
namespace {

constexpr std::uint64_t kStateBytes = 24, kProposalBytes = 32;
constexpr float kMostShare = 0.98f;  // of guided samples: without any of the BSDF's, what no lobe covers would be lost
constexpr std::uint32_t kFoldGroups = 64;    // of 64 invocations, which walk the list of touched cells
constexpr std::uint32_t kGroupsWide = 4096;  // of the two-dimensional dispatch over proposals
constexpr std::uint32_t kMaxLobes = 32;      // of the mixture: they are kept in registers or local memory

std::uint32_t power_of_two(int wanted) { return std::bit_ceil(static_cast<std::uint32_t>(std::max(wanted, 1))); }

class GuidedTechnique : public Technique {
 public:
  GuidedTechnique(const TechniqueTools& tools, std::string_view name)
      : device_(tools.device),
        table_(tools.table),
        name_(name),
        uniform_(tools.device, gpu::BufferUse::kUniform, sizeof(shared::GuideConstants), "constants of path guiding") {
    table_.set_uniform(shared::kSetTechnique, uniform_);
    if (find_technique(name)->wants_lights) seen_.emplace(tools);
  }

  RenderSettings adapt(RenderSettings settings) const override;
  void prepare(const TechniqueFrame& frame) override;
  void add_passes(const TechniquePasses& passes) override;
  void forget() override { forget_ = true; }
  std::uint32_t salt() const override { return frame_; }
  std::uint64_t bytes() const override {
    return states_.size() + proposals_.size() + cache_.size() + (seen_ ? seen_->bytes() : 0);
  }

 private:
  void make(gpu::Buffer& buffer, std::uint32_t binding, std::uint64_t bytes, const char* name);
  void make_buffers(const RenderSettings& settings);
  void fill_constants(const TechniqueFrame& frame);

  gpu::Device& device_;
  gpu::BindingTable& table_;
  std::string name_;
  gpu::Buffer uniform_, states_, proposals_, cache_;
  std::optional<SeenGrid> seen_;  // where it looks for light, too
  std::uint32_t state_count_ = 0, cell_count_ = 0;
  std::uint64_t vertices_ = 0;                       // of paths, a frame
  std::uint32_t accesses_ = 1, bucket_ = 1;          // cells that a vertex takes states from; states in a cell
  std::uint32_t frame_ = 0;                          // since it forgot
  std::array<double, shared::kPastFrames> times_{};  // of the last frames, by their numbers
  std::uint32_t parts_ = 1;                          // of a frame's paths
  bool resolve_ = false, guides_fog_ = true;
  bool forget_ = true;
};

void GuidedTechnique::make(gpu::Buffer& buffer, std::uint32_t binding, std::uint64_t bytes, const char* name) {
  buffer = gpu::Buffer();  // the old one's memory goes first
  table_.set_array(shared::kSetTechnique, binding, buffer);
  buffer = gpu::Buffer(device_, gpu::BufferUse::kStorage, bytes, name);
  table_.set_array(shared::kSetTechnique, binding, buffer);
  forget_ = true;
}

// Nothing learnt survives a change of size.
void GuidedTechnique::make_buffers(const RenderSettings& settings) {
  const std::uint32_t states = power_of_two(settings.mc_states), cells = power_of_two(settings.mc_cells);
  if (states != state_count_ || cells != cell_count_) {
    state_count_ = cell_count_ = 0;  // until both are there
    make(states_, shared::kBindGuideStates, states * kStateBytes, "guide states");
    // Entries, the list of touched ones, sums and means of all, and the winning proposal of every state.
    make(cache_, shared::kBindGuideCache,
         (std::uint64_t{cells} * (shared::kCacheWords + 1) + shared::kTailWords + states) * 4, "guide cache");
    state_count_ = states;
    cell_count_ = cells;
    log_info("path guiding: {} states and {} cached cells in {} MB", states, cells, bytes() >> 20);
  }
  const std::uint64_t proposals = resolve_ ? vertices_ * kProposalBytes : 16;
  if (!proposals_ || proposals_.size() != std::max<std::uint64_t>(proposals, 16))
    make(proposals_, shared::kBindGuideProposals, proposals, "guide proposals");
}

void GuidedTechnique::fill_constants(const TechniqueFrame& frame) {
  const RenderSettings& s = frame.settings;
  shared::GuideConstants c{};
  copy_settings(s, c);
  times_[frame_ % shared::kPastFrames] = frame.time;
  for (std::uint32_t age = 0; age < std::min(frame_, shared::kPastFrames); ++age) {
    const double elapsed = frame.time - times_[(frame_ - age) % shared::kPastFrames];
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
  c.seen_stride = seen_stride(frame.size, s, frame.medium());
  if (seen_) c.seen_ways = seen_->begin_frame();
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
  vertices_ = static_cast<std::uint64_t>(frame.size.x) * frame.size.y * most_samples(s) *
              static_cast<std::uint64_t>(s.bounces + (frame.medium() ? s.medium_bounces : 0));
  make_buffers(s);
  if (forget_) frame_ = 0;
  if (forget_ && seen_) seen_->forget();
  ++frame_;
  fill_constants(frame);
}

void GuidedTechnique::add_passes(const TechniquePasses& passes) {
  if (std::exchange(forget_, false)) {
    passes.list.add("guide reset", PassKind::kEstimator, [this](gpu::Commands& commands) {
      for (const gpu::Buffer* buffer : {&states_, &cache_, &proposals_}) commands.fill(*buffer, 0);
      commands.barrier();
    });
  }
  if (seen_) seen_->add_reset(passes.list);
  PathSpecs specs{{resolve_, accesses_, bucket_, 1}, {}, {resolve_, accesses_, bucket_, guides_fog_}};
  // Paths that look for light alone are nearly as good.
  if (seen_ && !resolve_) specs.meanwhile = {0, 1, 1, 0};
  specs.parts = parts_;
  std::function<void(gpu::Commands&)> resolve;
  if (resolve_) {
    resolve = [&pipeline = passes.shaders.get("guide_states"),
               groups = static_cast<std::uint32_t>((vertices_ + 63) / 64)](gpu::Commands& commands) {
      commands.dispatch(pipeline, std::min(groups, kGroupsWide), (groups + kGroupsWide - 1) / kGroupsWide);
      commands.barrier();
    };
  }
  specs.between_parts = resolve;
  add_paths_pass(passes, name_, specs);
  if (seen_) seen_->add_fold(passes.list, passes.shaders);
  if (resolve) passes.list.add("guide states", PassKind::kEstimator, resolve);
  passes.list.dispatch("guide cache", PassKind::kEstimator, passes.shaders.get("guide_cache"), {kFoldGroups, 1});
}

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

}  // namespace

std::unique_ptr<Technique> make_guided_technique(const TechniqueTools& tools, std::string_view name) {
  return std::make_unique<GuidedTechnique>(tools, name);
}
std::unique_ptr<Technique> make_guided_tail_technique(const TechniqueTools& tools, std::string_view name) {
  return std::make_unique<GuidedTailTechnique>(tools, name);
}

}  // namespace fb::render
