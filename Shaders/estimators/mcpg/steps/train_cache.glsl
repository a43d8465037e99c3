// What a vertex's sample teaches the irradiance cache's cell, and the second moments there of every probability of
// guiding.
#ifndef FB_MCPG_TRAIN_CACHE
#define FB_MCPG_TRAIN_CACHE
#include "estimators/mcpg/steps/propose.glsl"
#include "lib/incident.glsl"

const float kLeastMean = 0.25;  // of all cells' mean

// How much larger the second moment of an estimate of that light is than its square, about.
float reflected_moment(CacheCell there) {
  vec4 m = cached_moments(there.entry);
  float least = min(min(m.x, m.y), min(m.z, m.w));
  return least > 0.0 ? max(least, 1.0) : 2.0;
}

void add_to_cache(uint entry, vec3 reflection, float u) {
  for (uint i = 0u; i < 3u; ++i) {
    uint x = to_fixed(reflection[i], kCacheFixed, kCacheLargest, u);
    if (x != 0u) atomicAdd(guide_cache.at[entry + kCacheSum + i], x);
  }
}

// `emitted` and `reflected`: f / pdf times light from the hit; the latter will be an estimate, whose own second moment
// counts.
void train_cell(Vertex v, Guidance g, vec3 direction, Incident incident, float emitted, float reflected,
                inout uint rng) {
  CacheCell cell = g.cache;
  if (cell.entry == kNoIndex) {
    claim_cache(cell);
    return;
  }
  uint entry = cell.entry;
  float u = rng_uniform(rng);
  list_touched(entry, atomicAdd(guide_cache.at[entry + kCacheTouched], 1u));
  vec3 incoming = incident.emission + incident.reflection;
  add_to_cache(entry, incoming * (max(scatter_cosine(v.scatter, direction), 0.0) / (kPiShared * g.pdf)), u);
  // Not relative to a mean of next to nothing: where light is seldom seen, the first to be found would outweigh all
  // others.
  float mean = max(luminance(cached_reflection(entry)), kLeastMean * mean_luminance());
  float scale = luminance(scatter_albedo(v.scatter)) * mean;
  if (!(g.total > 0.0) || !(scale > 0.0)) return;
  float e = emitted / scale, r = reflected / scale;
  float second = e * (e + 2.0 * r) + (r > 0.0 ? r * r * reflected_moment(incident.field.cell) : 0.0);
  vec4 p = guide_shares() * g.guided_pdf + (1.0 - guide_shares()) * g.bsdf_pdf;
  vec4 m = bound_moments((second * g.pdf) / p, kMomentLargest);
  for (uint i = 0u; i < 4u; ++i) {
    uint x = to_fixed(m[i], kMomentFixed, kMomentLargest, u);
    if (x != 0u) atomicAdd(guide_cache.at[entry + kCacheMomentSum + i], x);
  }
}
#endif
