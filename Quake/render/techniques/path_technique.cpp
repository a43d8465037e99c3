// Techniques of one pass that traces paths, which remember nothing or only what shadow rays reached.
#include <array>
#include <cstring>
#include <string>

#include "render/techniques/seen_grid.h"
#include "render/techniques/technique.h"
#include "shared/frame.h"

namespace fb::render {
namespace {

class PathTechnique : public Technique {
 public:
  explicit PathTechnique(std::string_view name) : name_(name) {}
  void prepare(const TechniqueFrame&) override {}
  void add_passes(const TechniquePasses& passes) override { add_paths_pass(passes, name_); }

 private:
  std::string name_;
};

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
    constants.seen_stride = seen_stride(frame.size, frame.settings, frame.medium());
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

// Of workgroups: every `step`-th from `first`.
struct Rows {
  std::uint32_t step, first, count;
};
// Parts lie among each other: what one learns is of use all over the picture.
Rows rows_of_part(std::uint32_t part, std::uint32_t parts, std::uint32_t rows) {
  const std::uint32_t step = 1u << (part == 0 ? parts - 1 : parts - part), first = part == 0 ? 0 : step / 2;
  return {step, first, rows > first ? (rows - first + step - 1) / step : 0};
}

}  // namespace

void add_paths_pass(const TechniquePasses& passes, std::string_view name, const PathSpecs& constants) {
  Variant variant = passes.variant;
  variant.technique = constants.surfaces;
  variant.one_bounce = passes.bounces == 1;
  Variant meanwhile = variant;
  meanwhile.small = true;
  meanwhile.technique = constants.meanwhile.value_or(constants.surfaces);
  const gpu::ComputePipeline& paths =
      constants.meanwhile ? passes.shaders.get(name, variant, meanwhile) : passes.shaders.get(name, variant);
  const uvec2 groups = groups_over(passes.size, 8);
  passes.list.add(
      "paths", PassKind::kEstimator,
      [&paths, groups, parts = constants.parts, between = constants.between_parts](gpu::Commands& commands) {
        for (std::uint32_t part = 0; part < parts; ++part) {
          const Rows rows = rows_of_part(part, parts, groups.y);
          if (rows.count == 0) continue;
          if (between && part > 0) between(commands);
          commands.push(std::array{rows.step, rows.first});
          commands.dispatch(paths, groups.x, rows.count);
          commands.barrier();
        }
      });
  if (!passes.medium) return;
  variant.technique = constants.medium;
  variant.one_bounce = passes.medium_bounces == 1;
  variant.show_view = false;
  passes.list.dispatch("fog", PassKind::kEstimator, passes.shaders.get(std::string(name) + "_medium", variant),
                       passes.medium);
}

std::unique_ptr<Technique> make_path_technique(const TechniqueTools&, std::string_view name) {
  return std::make_unique<PathTechnique>(name);
}
std::unique_ptr<Technique> make_nee_technique(const TechniqueTools& tools, std::string_view name) {
  return std::make_unique<NeeTechnique>(tools, name);
}

}  // namespace fb::render
