// Whether a candidate hit counts: holes of alpha-tested textures let the ray through, translucent surfaces do so with
// probability 1 - alpha (unbiased for straight-through transmission).
#ifndef FB_LIB_CANDIDATE
#define FB_LIB_CANDIDATE
#include "lib/trace.glsl"
#include "lib/material.glsl"

// Where the last ray passed the nearest translucent surface, as a distance; beyond its end it may not know of any.
float passed_at;

// A pass may have the ray end at the first veil that it meets (shared/veils.h) in place of passing it by chance.
#ifndef STOPS_AT_VEILS
#define STOPS_AT_VEILS false
#endif

GpuMaterial material_of(uint instance, uint triangle) {
  uint record = instance_at(instance).first_attribute + triangle;
  return material_at(instance_at(instance).material_base + attribute_at(record).material);
}
float alpha_of(GpuMaterial m, uint instance) { return m.base_color.w * instance_at(instance).alpha; }
bool is_opaque(Hit hit) { return alpha_of(material_of(hit.instance, hit.triangle), hit.instance) >= 1.0; }

bool accept_candidate(Hit candidate, inout uint rng) {
  GpuMaterial m = material_of(candidate.instance, candidate.triangle);
  if ((m.flags & kMaterialAlphaTest) != 0u && m.base != kNoIndex) {
    uint record = instance_at(candidate.instance).first_attribute + candidate.triangle;
    vec2 uv = hit_uv(record, candidate.bary);
    if (nearest_texel(m.base, uv, (m.flags & kMaterialClampTexture) != 0u).alpha < 0.5) return false;
  }
  float alpha = alpha_of(m, candidate.instance);
  bool veil = STOPS_AT_VEILS && (m.flags & kMaterialLiquid) != 0u && alpha > 0.0;
  bool accepted = alpha >= 1.0 || veil || rng_uniform(rng) < alpha;
  if (!accepted) passed_at = min(passed_at, candidate.t);
  return accepted;
}
#endif
