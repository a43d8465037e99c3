#include "render/shader_set.h"

#include <array>

#include "accumulate.spv.h"
#include "antialias.spv.h"
#include "debug_view.spv.h"
#include "denoise_mean.spv.h"
#include "denoise_temporal.spv.h"
#include "denoise_wavelet.spv.h"
#include "denoise_wavelet_first.spv.h"
#include "denoise_wavelet_last.spv.h"
#include "exposure.spv.h"
#include "exposure_histogram.spv.h"
#include "gbuffer_bvh.spv.h"
#include "gbuffer_query.spv.h"
#include "guide_cache.spv.h"
#include "guide_states.spv.h"
#include "mcpg_bvh.spv.h"
#include "mcpg_nee_bvh.spv.h"
#include "mcpg_nee_query.spv.h"
#include "mcpg_query.spv.h"
#include "mcpg_tail_bvh.spv.h"
#include "mcpg_tail_query.spv.h"
#include "nee_bvh.spv.h"
#include "nee_query.spv.h"
#include "present.spv.h"
#include "pt_bvh.spv.h"
#include "pt_query.spv.h"
#include "temporal_antialias.spv.h"
#include "tonemap.spv.h"

#include "base/check.h"
#include "base/hash.h"

namespace fb::render {
namespace {

struct Shader {
  std::string_view name;
  std::span<const std::uint32_t> plain;  // without tracing, or through the BVH
  std::span<const std::uint32_t> query;  // through ray queries
};

const std::array kShaders{
    Shader{"gbuffer", gbuffer_bvh_spv, gbuffer_query_spv},
    Shader{"pt", pt_bvh_spv, pt_query_spv},
    Shader{"nee", nee_bvh_spv, nee_query_spv},
    Shader{"mcpg", mcpg_bvh_spv, mcpg_query_spv},
    Shader{"mcpg_nee", mcpg_nee_bvh_spv, mcpg_nee_query_spv},
    Shader{"mcpg_tail", mcpg_tail_bvh_spv, mcpg_tail_query_spv},
    Shader{"guide_states", guide_states_spv, {}},
    Shader{"guide_cache", guide_cache_spv, {}},
    Shader{"accumulate", accumulate_spv, {}},
    Shader{"debug_view", debug_view_spv, {}},
    Shader{"denoise_mean", denoise_mean_spv, {}},
    Shader{"denoise_temporal", denoise_temporal_spv, {}},
    Shader{"denoise_wavelet_first", denoise_wavelet_first_spv, {}},
    Shader{"denoise_wavelet", denoise_wavelet_spv, {}},
    Shader{"denoise_wavelet_last", denoise_wavelet_last_spv, {}},
    Shader{"temporal_antialias", temporal_antialias_spv, {}},
    Shader{"exposure_histogram", exposure_histogram_spv, {}},
    Shader{"exposure", exposure_spv, {}},
    Shader{"tonemap", tonemap_spv, {}},
    Shader{"antialias", antialias_spv, {}},
    Shader{"present", present_spv, {}},
};

}  // namespace

std::uint64_t shader_hash(std::string_view estimator) {
  std::uint64_t hash = 0;
  for (const Shader& shader : kShaders)
    if (shader.name == estimator || shader.name == "gbuffer") hash = hash_span(shader.plain, hash);
  return hash;
}

const gpu::ComputePipeline& ShaderSet::get(std::string_view name, const Variant& variant) {
  auto key = std::make_tuple(std::string(name), variant);
  if (auto found = pipelines_.find(key); found != pipelines_.end()) return found->second;
  for (const Shader& shader : kShaders) {
    if (shader.name != name) continue;
    const auto tracing = trace_constants(device_);
    const std::array constants{gpu::SpecializationConstant{0, variant.candidates},
                               gpu::SpecializationConstant{1, variant.specular},
                               gpu::SpecializationConstant{2, variant.resolve},
                               gpu::SpecializationConstant{3, variant.accesses},
                               gpu::SpecializationConstant{4, variant.bucket},
                               gpu::SpecializationConstant{6, variant.show_view},
                               tracing[0],
                               tracing[1]};
    gpu::ComputePipeline pipeline(device_, table_, variant.ray_query ? shader.query : shader.plain, std::string(name),
                                  constants);
    return pipelines_.emplace(std::move(key), std::move(pipeline)).first->second;
  }
  fatal(__FILE__, __LINE__, "no shader named " + std::string(name));
}

const gpu::ComputePipeline& ShaderSet::gbuffer(const Variant& variant) { return get("gbuffer", variant); }
const gpu::ComputePipeline& ShaderSet::paths(std::string_view estimator, const Variant& variant) {
  return get(estimator, variant);
}
const gpu::ComputePipeline& ShaderSet::pass(std::string_view name) { return get(name, Variant{}); }

}  // namespace fb::render
