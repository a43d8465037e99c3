// The passes that trace paths, of every technique.
#include <array>
#include <string>

#include "render/techniques/technique.h"

namespace fb::render {
namespace {

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
  variant.show_view = passes.show_view;
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

}  // namespace fb::render
