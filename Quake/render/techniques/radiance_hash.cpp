#include "render/techniques/radiance_hash.h"

#include <algorithm>
#include <string>

#include "base/hash.h"
#include "render/techniques/technique.h"

namespace fb::render {
namespace {

// What runs behind the mean radiance.
constexpr std::string_view kDisplayShaders[] = {
    "antialias",
    "bloom_small",
    "bloom_x",
    "bloom_y",
    "debug_view",
    "denoise_baked",
    "denoise_baked_join",
    "denoise_baked_sums",
    "denoise_change",
    "denoise_change_decide",
    "denoise_change_sparse",
    "denoise_light",
    "denoise_mean",
    "denoise_medium",
    "denoise_medium_temporal",
    "denoise_second",
    "denoise_second_temporal",
    "denoise_temporal",
    "denoise_temporal_sparse",
    "denoise_wavelet",
    "denoise_wavelet_first",
    "denoise_wavelet_last",
    "exposure",
    "exposure_histogram",
    "local_exposure",
    "present",
    "present_warped",
    "temporal_antialias",
    "temporal_upscale",
    "tonemap",
    "tonemap_lens",
};

// What the names of a folder's techniques and passes begin with: restir of restir_di, restir_guided, restir_spatial.
std::string_view family_of(std::string_view name) { return name.substr(0, name.find('_')); }

// Another technique's paths, or a pass of a family that this one neither is of nor stands on.
bool is_of_another(std::string_view shader, const TechniqueInfo& own) {
  const std::string_view family = family_of(shader);
  bool of_technique = false;
  for (const TechniqueInfo& t : techniques()) {
    if (shader == t.name || shader == std::string(t.name) + "_medium") return t.name != own.name;
    of_technique |= family_of(t.name) == family;
  }
  return of_technique && family != family_of(own.name) && family != own.stands_on;
}

// A technique that has no paths from a medium of its own takes those of its folder (ddgi_restir: ddgi_plus's).
bool borrows_fog(std::string_view shader, std::string_view estimator, std::span<const CompiledShader> shaders) {
  const std::string own = std::string(estimator) + "_medium";
  const std::string_view folder = estimator.substr(0, estimator.find('_') + 1);
  return shader.ends_with("_medium") && shader.starts_with(folder) &&
         std::ranges::find(shaders, own, &CompiledShader::name) == shaders.end();
}

}  // namespace

std::span<const std::string_view> display_shaders() { return kDisplayShaders; }

std::uint64_t radiance_hash(std::string_view estimator, const RadianceCode& code) {
  std::uint64_t hash = code.light_list;
  const TechniqueInfo* own = find_technique(estimator);
  for (const CompiledShader& shader : code.shaders) {
    if (std::ranges::count(kDisplayShaders, shader.name) > 0) continue;
    if (own != nullptr && is_of_another(shader.name, *own) && !borrows_fog(shader.name, estimator, code.shaders))
      continue;
    hash = hash_bytes(shader.name.data(), shader.name.size(), hash);
    for (const auto variant : {shader.bound, shader.address, shader.query}) hash = hash_span(variant, hash);
  }
  return hash;
}

}  // namespace fb::render
