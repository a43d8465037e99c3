// Whether a candidate hit counts: holes of alpha-tested textures let the ray through, translucent surfaces do so with
// probability 1 - alpha (unbiased for straight-through transmission).
#ifndef FB_LIB_CANDIDATE
#define FB_LIB_CANDIDATE
#include "lib/trace.glsl"
#include "lib/material.glsl"

// Where the last ray passed the nearest translucent surface, as a distance; beyond its end it may not know of any.
float passed_at;

bool is_opaque(Hit hit) {
  uint material = instance_at(hit.instance).material_base + attribute_at(instance_at(hit.instance).first_attribute + hit.triangle).material;
  return material_at(material).base_color.w * instance_at(hit.instance).alpha >= 1.0;
}

bool accept_candidate(Hit candidate, inout uint rng) {
  uint record = instance_at(candidate.instance).first_attribute + candidate.triangle;
  uint material_index = instance_at(candidate.instance).material_base + attribute_at(record).material;
  GpuMaterial m = material_at(material_index);
  if ((m.flags & kMaterialAlphaTest) != 0u && m.base != kNoIndex) {
    vec2 uv = hit_uv(record, candidate.bary);
    if (nearest_texel(m.base, uv, (m.flags & kMaterialClampTexture) != 0u).alpha < 0.5) return false;
  }
  float alpha = m.base_color.w * instance_at(candidate.instance).alpha;
  bool accepted = alpha >= 1.0 || rng_uniform(rng) < alpha;
  if (!accepted) passed_at = min(passed_at, candidate.t);
  return accepted;
}
#endif
