#include "render/shader_set.h"

#include <vector>

namespace fb::render {

const gpu::ComputePipeline& ShaderSet::get(std::string_view name, const Variant& variant) {
  auto key = std::make_tuple(std::string(name), variant);
  if (auto found = pipelines_.find(key); found != pipelines_.end()) return found->second;
  std::vector<gpu::SpecializationConstant> constants{{shared::kSpecCandidates, variant.candidates},
                                                     {shared::kSpecSpecular, variant.specular},
                                                     {shared::kSpecShowView, variant.show_view},
                                                     {shared::kSpecMedium, variant.medium},
                                                     {shared::kSpecInMedium, variant.in_medium},
                                                     {shared::kSpecFeatures, variant.surfaces},
                                                     {shared::kSpecWater, variant.water}};
  for (std::uint32_t i = 0; i < variant.technique.size(); ++i)
    constants.push_back({shared::kSpecTechnique + i, variant.technique[i]});
  gpu::ComputePipeline pipeline = make_pipeline(device_, table_, name, variant.ray_query, access_, constants);
  return pipelines_.emplace(std::move(key), std::move(pipeline)).first->second;
}

}  // namespace fb::render
