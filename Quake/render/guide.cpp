#include "render/guide.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/log.h"
#include "render/shader_set.h"
#include "shared/guide.h"
#include "shared/rng.h"

namespace fb::render {
namespace {

constexpr std::uint64_t kStateBytes = 24, kProposalBytes = 32;
constexpr float kMostShare = 0.98f;  // of guided samples: without any of the BSDF's, what no lobe covers would be lost
constexpr std::uint32_t kFoldGroups = 64;    // of 64 invocations, which walk the list of touched cells
constexpr std::uint32_t kGroupsWide = 4096;  // of the two-dimensional dispatch over proposals

std::uint32_t power_of_two(int wanted) { return std::bit_ceil(static_cast<std::uint32_t>(std::max(wanted, 1))); }

}  // namespace

Guide::Guide(gpu::Device& device, gpu::BindingTable& table) : device_(device), table_(table) {}

void Guide::prepare(const RenderSettings& settings, std::uint64_t vertices) {
  const std::uint32_t states = power_of_two(settings.mc_states), cells = power_of_two(settings.mc_cells);
  resolve_ = settings.deterministic != 0;
  vertices_ = vertices;
  const auto make = [&](gpu::Buffer& buffer, std::uint32_t binding, std::uint64_t bytes, const char* name) {
    buffer = gpu::Buffer();  // the old one's memory goes first
    table_.set_array(shared::kSetTechnique, binding, buffer);
    buffer = gpu::Buffer(device_, gpu::BufferUse::kStorage, bytes, name);
    table_.set_array(shared::kSetTechnique, binding, buffer);
    forget_ = true;
  };
  if (states != state_count_ || cells != cell_count_) {
    state_count_ = cell_count_ = 0;  // until both are there
    make(states_, shared::kBindGuideStates, states * kStateBytes, "guide states");
    // Entries, the list of touched ones, its two counters, and the winning proposal of every state.
    make(cache_, shared::kBindGuideCache, (std::uint64_t{cells} * (shared::kCacheWords + 1) + 4 + states) * 4,
         "guide cache");
    state_count_ = states;
    cell_count_ = cells;
    log_info("path guiding: {} states and {} cached cells in {} MB", states, cells, bytes() >> 20);
  }
  const std::uint64_t proposals = resolve_ ? vertices * kProposalBytes : 16;
  if (!proposals_ || proposals_.size() != std::max<std::uint64_t>(proposals, 16)) {
    make(proposals_, shared::kBindGuideProposals, proposals, "guide proposals");
  }
}

void Guide::release() {
  states_ = gpu::Buffer();
  cache_ = gpu::Buffer();
  proposals_ = gpu::Buffer();
  for (const std::uint32_t binding : {shared::kBindGuideStates, shared::kBindGuideCache, shared::kBindGuideProposals}) {
    table_.set_array(shared::kSetTechnique, binding, states_);
  }
  state_count_ = cell_count_ = 0;
}

void Guide::fill_constants(shared::FrameConstants& c, const RenderSettings& s, float pixel_tangent) {
  const float angle = std::tan(radians(s.mc_angle));
  c.guide_grid = vec4(std::max(angle, s.mc_pixels * pixel_tangent), s.mc_static_width, s.mc_adaptive, s.mc_coarser);
  c.guide_learn =
      vec4(std::min(s.mc_share, kMostShare), s.mc_alpha, static_cast<float>(s.mc_count), s.mc_radius * s.mc_radius);
  c.guide_pick = vec4(s.mc_power, std::min(s.mc_share_max, kMostShare), std::min(s.mc_share_min, kMostShare),
                      std::max(2 * angle, s.mc_cache_pixels * pixel_tangent));
  c.guide_states = state_count_;
  c.guide_cells = cell_count_;
  const auto flag = [](int on, std::uint32_t bit) { return on != 0 ? bit : 0u; };
  c.guide_flags = flag(s.mc_learn_share, shared::kGuideLearnShare) | flag(s.mc_predict, shared::kGuidePredict) |
                  flag(s.mc_loss, shared::kGuideLoss) | flag(s.mc_previous, shared::kGuidePrevious) |
                  flag(s.mc_share_score, shared::kGuideShareScore) | flag(s.mc_cache, shared::kGuideUseCache) |
                  flag(s.mc_in_world, shared::kGuideInWorld);
  // A cell's sums have room for 4096 samples of the largest radiance: those of 16 paths in each of 16x16 pixels.
  c.train_every = static_cast<std::uint32_t>(std::max(s.mc_train, s.spp / 16));
  c.tail_every = static_cast<std::uint32_t>(std::max(s.mc_tail_train, s.spp / 16));
  c.cache_blend = s.mc_cache_alpha;
  if (forget_) frame_ = 0;
  c.guide_frame = ++frame_;
  // Random numbers from which something was learnt must not come again while it is remembered: what they found would
  // look more likely than it is. (The frame's own number comes again when a view's accumulation starts anew.)
  c.frame = shared::hash_combine(c.frame, frame_);
}

void Guide::record_begin(gpu::Commands& commands) {
  if (!std::exchange(forget_, false)) return;
  commands.fill(states_, 0);
  commands.fill(cache_, 0);
  commands.fill(proposals_, 0);
  commands.barrier();
}

void Guide::record_end(gpu::Commands& commands, ShaderSet& shaders) {
  if (resolve_) {
    gpu::Commands::Scope scope(commands, "guide states");
    const auto groups = static_cast<std::uint32_t>((vertices_ + 63) / 64);
    commands.dispatch(shaders.pass("guide_states"), std::min(groups, kGroupsWide),
                      (groups + kGroupsWide - 1) / kGroupsWide);
    commands.barrier();
  }
  gpu::Commands::Scope scope(commands, "guide cache");
  commands.dispatch(shaders.pass("guide_cache"), kFoldGroups);
  commands.barrier();
}

std::uint64_t Guide::bytes() const { return states_.size() + proposals_.size() + cache_.size(); }

}  // namespace fb::render
