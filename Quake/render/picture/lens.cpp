#include "render/picture/lens.h"

#include "render/passes/debug_views.h"

namespace fb::render {

void add_lens(PassList& list, ShaderSet& shaders, const shared::FrameConstants& constants, const Variant& layered,
              const Variant& traced) {
  const uvec2 render(constants.width, constants.height);
  const auto frame = [&](const char* name, const gpu::ComputePipeline& pipeline, uvec2 groups) {
    list.dispatch(name, PassKind::kFrame, pipeline, groups);
  };
  frame("histogram", shaders.get("exposure_histogram"), groups_over(render, 16));
  const bool lens = constants.debug_view == 0 && (constants.bloom > 0 || constants.local_exposure > 0);
  if (lens) frame("local_exposure", shaders.get("local_exposure"), {(shared::kGridCells + 63) / 64, 1});
  frame("exposure", shaders.get("exposure"), {1, 1});
  if (lens) {
    const uvec2 small = groups_over({shared::kBloomWidth, shared::kBloomHeight}, 8);
    for (const char* step : {"bloom_small", "bloom_x", "bloom_y"}) frame(step, shaders.get(step), small);
  }
  const auto last = [&]() -> const gpu::ComputePipeline& {
    if (constants.debug_view == 0) return shaders.get(lens ? "tonemap_lens" : "tonemap");
    if (view_owner(static_cast<std::uint32_t>(constants.debug_view)) == shared::kViewOfMap)
      return shaders.get("authored_view", traced);
    return shaders.get("debug_view", layered);
  };
  frame("tonemap", last(), groups_over(render, 8));
}

}  // namespace fb::render
