// What a surface point is made of: texture coordinates (liquids swing), colour, emission, holes.
#ifndef FB_LIB_MATERIAL
#define FB_LIB_MATERIAL
#include "lib/texture.glsl"
#include "lib/sky.glsl"
#include "shared/bsdf.h"
#include "shared/rng.h"

const uint kMaterialAlphaTest = 1u;
const uint kMaterialWarp = 2u;
const uint kMaterialNoFullbright = 8u;
const uint kMaterialClampTexture = 16u;

const uint kEmissionNone = 0u;
const uint kEmissionFullbright = 1u;
const uint kEmissionLava = 2u;
const uint kEmissionTeleport = 4u;
const uint kEmissionSky = 5u;
const uint kEmissionSprite = 6u;
const uint kEmissionConstant = 10u;

// Quake's turbulence: 8 texels of swing, a period of 128 texels and 2 pi seconds.
vec2 warped_uv(vec2 uv, uint image_index) {
  vec2 size = vec2(image_size(image_index));
  vec2 at = uv * size;
  return (at + 8.0 * sin(at.yx * (kPiShared / 64.0) + frame.time)) / size;
}

vec2 hit_uv(uint record, vec2 bary) {
  GpuAttribute a = attributes[record];
  return a.uv0 + (a.uv1 - a.uv0) * bary.x + (a.uv2 - a.uv0) * bary.y;
}

struct Shade {
  vec3 albedo;
  vec3 emission;
};

// One texel's part of the shade.
Shade shade_texel(GpuMaterial m, uint instance_flags, Texel texel, vec3 luma) {
  Shade s;
  s.albedo = texel.color * m.base_color.rgb;
  s.emission = vec3(0.0);
  if (m.emission_kind == kEmissionFullbright) {
    bool glows = texel.glows && (m.flags & kMaterialNoFullbright) == 0u;
    s.emission = (m.luma != kNoIndex ? luma : glows ? texel.color : vec3(0.0)) * m.emission.rgb;
  } else if ((m.emission_kind >= kEmissionLava && m.emission_kind <= kEmissionTeleport) || m.emission_kind == kEmissionSprite) {
    s.emission = texel.color * m.emission.rgb;
  }
  return s;
}

// Colour and radiance towards -direction of a point. `smooth_texels`: bilinear, else nearest.
Shade shade_point(GpuMaterial m, uint instance_index, vec2 uv, vec3 direction, bool smooth_texels) {
  uint flags = instances[instance_index].flags;
  Shade s;
  if ((flags & kInstanceHasColor) != 0u) {
    s.albedo = instances[instance_index].color.rgb;
    s.emission = instances[instance_index].emission.rgb;
    return s;
  }
  if (m.emission_kind == kEmissionSky) {
    s.albedo = vec3(0.0);
    s.emission = sky_radiance(direction) * m.emission.rgb;
    return s;
  }
  if (m.base == kNoIndex) {
    s.albedo = m.base_color.rgb;
    s.emission = m.emission_kind == kEmissionConstant ? m.emission.rgb : vec3(0.0);
    return s;
  }
  bool clamped = (m.flags & kMaterialClampTexture) != 0u;
  if ((m.flags & kMaterialWarp) != 0u) uv = warped_uv(uv, m.base);
  if (!smooth_texels) {
    vec3 luma = m.luma != kNoIndex ? nearest_texel(m.luma, uv, clamped).color : vec3(0.0);
    s = shade_texel(m, flags, nearest_texel(m.base, uv, clamped), luma);
  } else {
    vec2 size = vec2(image_size(m.base));
    vec2 at = uv * size - 0.5, base = floor(at), f = at - base;
    s.albedo = vec3(0.0);
    s.emission = vec3(0.0);
    for (uint i = 0u; i < 4u; ++i) {
      vec2 corner = vec2(i & 1u, i >> 1u);
      vec2 corner_uv = (base + corner + 0.5) / size;
      float weight = (corner.x > 0.0 ? f.x : 1.0 - f.x) * (corner.y > 0.0 ? f.y : 1.0 - f.y);
      vec3 luma = m.luma != kNoIndex ? nearest_texel(m.luma, corner_uv, clamped).color : vec3(0.0);
      Shade one = shade_texel(m, flags, nearest_texel(m.base, corner_uv, clamped), luma);
      s.albedo += weight * one.albedo;
      s.emission += weight * one.emission;
    }
  }
  if (m.emission_kind == kEmissionConstant) s.emission = m.emission.rgb;
  return s;
}
#endif
