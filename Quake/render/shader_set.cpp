#include "render/shader_set.h"

#include <utility>

#include "base/parallel.h"

namespace fb::render {

const gpu::ComputePipeline& ShaderSet::get(std::string_view name, const Variant& variant) {
  const auto [found, fresh] = pipelines_.try_emplace(Key(name, variant));
  if (fresh) asked_.push_back(found);
  return found->second;
}

void ShaderSet::make() {
  const auto asked = std::exchange(asked_, {});
  try {
    if (asked.empty()) return;
    parallel_for(
        asked.size(), 1, [&](std::size_t i) { asked[i]->second = compile(asked[i]->first); }, waiting_);
  } catch (...) {
    for (const auto& pipeline : asked)
      if (!pipeline->second) pipelines_.erase(pipeline);
    throw;
  }
}

gpu::ComputePipeline ShaderSet::compile(const Key& key) const {
  const auto& [name, variant] = key;
  std::vector<gpu::SpecializationConstant> constants{
      {shared::kSpecCandidates, variant.candidates}, {shared::kSpecSpecular, variant.specular},
      {shared::kSpecShowView, variant.show_view},    {shared::kSpecMedium, variant.medium},
      {shared::kSpecFeatures, variant.surfaces},     {shared::kSpecWater, variant.water},
      {shared::kSpecOneBounce, variant.one_bounce}};
  for (std::uint32_t i = 0; i < variant.technique.size(); ++i)
    constants.push_back({shared::kSpecTechnique + i, variant.technique[i]});
  return make_pipeline(device_, table_, name, variant.ray_query, by_address_, constants);
}

}  // namespace fb::render
