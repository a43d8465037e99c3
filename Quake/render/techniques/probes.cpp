#include "render/techniques/probes.h"

#include <algorithm>
#include <cmath>

namespace fb::render {
namespace {

constexpr ArrayRow kProbeRows[]{FB_DDGI_ARRAYS(FB_ARRAY_ROW)};
constexpr std::uint32_t kMostGroups = 65535;  // of a dispatch along x, on any device
// Distances that are told apart end beyond the probes that a point asks (Majercik 2019).
constexpr float kFarthest = 1.5f;

std::uint32_t groups_of(std::uint32_t invocations) { return (invocations + 63) / 64; }

}  // namespace

Probes::Probes(const TechniqueTools& tools, bool plus)
    : memory_(tools.device, tools.table, kProbeRows, "ddgi reset"), table_(tools.device), plus_(plus) {}

shared::DdgiConstants Probes::prepare(const TechniqueFrame& frame, SeenGrid& seen) {
  const RenderSettings& s = frame.settings;
  const ProbeGrid grid = probe_grid(lit_bounds(frame.snapshot), frame.snapshot.camera.position, s.ddgi_spacing);
  const bool anew = table_.prepare(frame.snapshot, grid, s.ddgi_leaves != 0);
  if (anew || !grid_.goes_on_as(grid)) memory_.forget();
  grid_ = grid;
  rays_ = static_cast<std::uint32_t>(s.ddgi_probe_rays);
  const std::uint32_t affordable = std::max(static_cast<std::uint32_t>(s.ddgi_rays) / rays_, 1u);
  turns_ = std::max(std::min({table_.standing(), affordable, kMostGroups}), 1u);
  for (const std::uint32_t array : {shared::kDdgiProbes, shared::kDdgiLight, shared::kDdgiDepth, shared::kDdgiTurns})
    memory_.set_count(array, grid.probes());
  // Of a first vertex' light only ddgi_plus asks from where it comes.
  const bool keeps = plus_ && shared::ddgi_keeps_sent(s.ddgi_control, s.ddgi_guide);
  if (keeps) memory_.set_count(shared::kDdgiLight, 2 * std::uint64_t{grid.probes()});
  memory_.set_count(shared::kDdgiRays, std::uint64_t{turns_} * rays_);
  memory_.set_count(shared::kDdgiTable, table_.elements());
  fresh_ = memory_.begin_frame();
  if (fresh_) frame_ = 0;
  ++frame_;

  shared::DdgiConstants c{};
  copy_settings(s, c);
  if (!keeps) {
    c.ddgi_control = 0;
    c.ddgi_guide = 0;
  }
  c.origin = vec4(grid.origin, kFarthest * glm::length(grid.spacing));
  c.spacing = vec4(grid.spacing, std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z}));
  c.first_x = grid.first[0], c.first_y = grid.first[1], c.first_z = grid.first[2];
  c.count_x = grid.count[0], c.count_y = grid.count[1], c.count_z = grid.count[2];
  c.probes = grid.probes();
  table_.fill(c);
  c.turns = turns_;
  c.rays = rays_;
  c.looking = plus_ ? static_cast<std::uint32_t>(std::lround(s.ddgi_looking * static_cast<float>(rays_))) : 0;
  c.frame_number = frame_;
  // Rays of probes are remembered with those of paths.
  const uvec2 with_probes(frame.lit.x, frame.lit.y + turns_ * rays_ / std::max(frame.lit.x, 1u) + 1);
  c.seen_stride = seen_stride(with_probes, s, frame.medium());
  c.seen_ways = seen.begin_frame();
  return c;
}

void Probes::add_passes(const TechniquePasses& passes) {
  memory_.add_reset(passes.list);
  table_.add_upload(passes.list, memory_.buffer(shared::kDdgiTable), fresh_);
  const auto add = [&](const char* name, const gpu::ComputePipeline& pipeline, std::uint32_t groups) {
    passes.list.dispatch(name, PassKind::kEstimator, pipeline, uvec2(groups, 1));
  };
  for (const std::uint32_t ranks : {0u, 1u}) {
    Variant variant;
    variant.technique = {ranks};
    add("probe turns", passes.shaders.get("ddgi_turns", variant), groups_of(grid_.probes()));
  }
  Variant traced = passes.variant;
  traced.technique = {plus_};
  add("probe rays", passes.shaders.get("ddgi_rays", traced), groups_of(turns_ * rays_));
  add("probe places", passes.shaders.get("ddgi_relocate"), groups_of(turns_));
  add("probe light", passes.shaders.get("ddgi_blend"), turns_);
}

}  // namespace fb::render
