#include "render/shader_set.h"

#include <array>

#include "shared/guide.h"

namespace fb::render {

const gpu::ComputePipeline& ShaderSet::get(std::string_view name, const Variant& variant) {
  auto key = std::make_tuple(std::string(name), variant);
  if (auto found = pipelines_.find(key); found != pipelines_.end()) return found->second;
  const std::array constants{gpu::SpecializationConstant{shared::kSpecCandidates, variant.candidates},
                             gpu::SpecializationConstant{shared::kSpecSpecular, variant.specular},
                             gpu::SpecializationConstant{shared::kSpecResolve, variant.resolve},
                             gpu::SpecializationConstant{shared::kSpecAccesses, variant.accesses},
                             gpu::SpecializationConstant{shared::kSpecBucket, variant.bucket},
                             gpu::SpecializationConstant{shared::kSpecShowView, variant.show_view}};
  gpu::ComputePipeline pipeline = make_pipeline(device_, table_, name, variant.ray_query, access_, constants);
  return pipelines_.emplace(std::move(key), std::move(pipeline)).first->second;
}

const gpu::ComputePipeline& ShaderSet::gbuffer(const Variant& variant) { return get("gbuffer", variant); }
const gpu::ComputePipeline& ShaderSet::paths(std::string_view estimator, const Variant& variant) {
  return get(estimator, variant);
}
const gpu::ComputePipeline& ShaderSet::pass(std::string_view name) { return get(name, Variant{}); }

}  // namespace fb::render
