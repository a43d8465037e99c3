#include "render/passes/work.h"

#include <algorithm>
#include <array>

#include "shared/scene_gpu.h"
#include "shared/veils.h"
#include "shared/work.h"

namespace fb::render {
namespace {

static_assert(shared::kCounterFirstWork + 2 * shared::kWorkKinds * shared::kWorkWords <= shared::kCounterCount);

std::uint32_t block_of(std::uint32_t kind, const shared::FrameConstants& c) {
  switch (kind) {
    case shared::kWorkMedium:
      return c.medium_block;
    case shared::kWorkSecond:
      return c.light_block;
    default:
      return 1;
  }
}

}  // namespace

AskedGroups Work::groups(std::uint32_t kind) const {
  const uvec2 blocks = groups_over({constants.width, constants.height}, block_of(kind, constants));
  return {&counters, shared::work_word(kind, constants.work_parity), groups_over(blocks, 8)};
}

void Work::begin(gpu::Commands& commands) const {
  std::array<std::uint32_t, shared::kWorkKinds * shared::kWorkWords> words{};
  for (std::uint32_t kind = 0; kind < shared::kWorkKinds; ++kind) {
    const uvec2 most = groups(kind).most;
    const bool everywhere = kind == shared::kWorkMedium && constants.medium.w + constants.camera_fog_square > 0;
    const bool counts = kind == shared::kWorkWater;
    const std::array<std::uint32_t, shared::kWorkWords> work{everywhere ? most.x : 0, counts ? 0 : most.y, 1, 0};
    std::ranges::copy(work, words.begin() + shared::kWorkWords * kind);
  }
  commands.update(counters, words, shared::work_word(0, constants.work_parity) * sizeof(std::uint32_t));
  commands.barrier();
}

void add_gbuffer(PassList& list, ShaderSet& shaders, const Variant& variant, const Work& work,
                 const gpu::Buffer& tiles) {
  const uvec2 groups = groups_over({work.constants.width, work.constants.height}, 8);
  const gpu::ComputePipeline& straight = shaders.get("gbuffer", variant);
  if (!variant.water && (variant.surfaces & shared::kFeatureVeils) == 0)
    return list.dispatch("gbuffer", PassKind::kFrame, straight, groups);
  const gpu::ComputePipeline& by_water = shaders.get("gbuffer_water", variant);
  if (work.constants.camera_liquid != shared::kNoIndex)
    return list.dispatch("gbuffer_water", PassKind::kFrame, by_water, groups);
  list.add("gbuffer", PassKind::kFrame, [&tiles, &straight, groups](gpu::Commands& commands) {
    commands.fill(tiles, 0, 0, VkDeviceSize{groups.x} * groups.y * sizeof(std::uint32_t));
    commands.barrier();
    commands.dispatch(straight, groups.x, groups.y);
    commands.barrier();
  });
  list.dispatch("gbuffer_water", PassKind::kFrame, by_water, work.groups(shared::kWorkWater));
}

}  // namespace fb::render
