// What a surface point is made of: texture coordinates (liquids swing), colour, emission, holes.
#ifndef FB_LIB_MATERIAL
#define FB_LIB_MATERIAL
#include "shared/spot.h"
#include "lib/frame_bindings.glsl"
#include "lib/texture.glsl"
#include "shared/bsdf.h"
#include "shared/kinds.h"
#include "shared/rng.h"

// Quake's turbulence: 8 texels of swing, a period of 128 texels and 2 pi seconds.
vec2 warped_uv(vec2 uv, uint image_index) {
  vec2 size = vec2(image_size(image_index));
  vec2 at = uv * size;
  return (at + 8.0 * sin(at.yx * (kPiShared / 64.0) + frame.time)) / size;
}

vec2 hit_uv(uint record, vec2 bary) {
  GpuAttribute a = attribute_at(record);
  return a.uv0 + (a.uv1 - a.uv0) * bary.x + (a.uv2 - a.uv0) * bary.y;
}

struct Shade {
  vec3 albedo;
  vec3 emission;
};

// How a texture is looked up: one of kFilter*; `footprint`: what a step of a pixel to the right and one down are in
// texture coordinates, for kFilterFootprint.
struct TextureFilter {
  uint kind;
  mat2 footprint;
};
const TextureFilter kNearest = TextureFilter(kFilterNearest, mat2(0.0));

// Four points of a pixel, one in each quarter of it, relative to where the camera's ray meets the texture. Rays are
// jittered about the pixel's middle; over the frames the points cover the pixel, and no more. Where the picture is
// scaled up over time the pixel is one of the output's, about where the ray meets the texture.
vec2 footprint_tap(TextureFilter filtered, vec2 quarter) {
  vec2 jitter = vec2(frame.jitter_x, frame.jitter_y);
  return filtered.footprint * (frame.tap_size * (0.5 * quarter - 0.25) + frame.tap_shift * jitter);
}

// The share of its radiance that what glows sends along a ray that meets it after a distance.
float emission_share(uint instance_index, GpuMaterial m, vec3 direction, float distance_to) {
  GpuInstance lamp = instance_at(instance_index);
  if ((lamp.flags & kInstanceIsSpot) == 0u) {
    float scale = unpackHalf2x16(m.seen_b).y;
    return scale > 0.0 ? fall_share(kFallLinear, distance_to * scale) : 1.0;
  }
  vec3 axis = vec3(lamp.to_world[0].x, lamp.to_world[1].x, lamp.to_world[2].x);
  float fall = fall_share((lamp.flags >> kInstanceFallShift) & 7u, distance_to * lamp.pose_scale.x);
  return fall * spot_share(-dot(direction, axis) * inversesqrt(dot(axis, axis)), lamp.color.w, lamp.emission.w);
}

// Colour and own radiance of a point; a sky's radiance is added by who knows the direction. All texels come through one
// fetch in a loop, since a driver's compiler takes long over every copy of it.
Shade shade_point(GpuMaterial m, uint instance_index, vec2 uv, TextureFilter filtered) {
  if ((instance_at(instance_index).flags & kInstanceHasColor) != 0u) {
    return Shade(instance_at(instance_index).color.rgb, instance_at(instance_index).emission.rgb);
  }
  bool constant = m.emission_kind == kEmissionConstant;
  if (m.emission_kind == kEmissionSky) return Shade(vec3(0.0), vec3(0.0));
  if (m.base == kNoIndex) return Shade(m.base_color.rgb, constant ? m.emission.rgb : vec3(0.0));

  bool clamped = (m.flags & kMaterialClampTexture) != 0u;
  if (has_feature(kFeatureWarp) && (m.flags & kMaterialWarp) != 0u) uv = warped_uv(uv, m.base);
  bool has_luma = has_feature(kFeatureLuma) && m.luma != kNoIndex && m.emission_kind == kEmissionFullbright;
  bool all_glows = all_texels_glow(m.emission_kind);
  bool some_glow = m.emission_kind == kEmissionFullbright && !has_luma && (m.flags & kMaterialNoFullbright) == 0u;
  vec2 size = vec2(image_size(m.base));
  vec2 corner = floor(uv * size - 0.5), f = uv * size - 0.5 - corner;
  bool smooth_texels = filtered.kind == kFilterBilinear, wide = filtered.kind == kFilterFootprint;
  uint taps = smooth_texels || wide ? 4u : 1u;
  uint fetches = has_feature(kFeatureLuma) ? 2u * taps : taps;
  Shade s = Shade(vec3(0.0), vec3(0.0));
  uint i = 0u;
  do {
    uint tap = i & (taps - 1u);
    vec2 offset = vec2(tap & 1u, tap >> 1u);
    vec2 weights = mix(1.0 - f, f, offset);
    float weight = smooth_texels ? weights.x * weights.y : wide ? 0.25 : 1.0;
    vec2 at = smooth_texels ? (corner + offset + 0.5) / size : wide ? uv + footprint_tap(filtered, offset) : uv;
    Texel texel = nearest_texel(i >= taps && has_luma ? m.luma : m.base, at, clamped);
    if (i >= taps) {
      if (has_luma) s.emission += weight * texel.color;
    } else {
      s.albedo += weight * texel.color;
      if (all_glows || (some_glow && texel.glows)) s.emission += weight * texel.color;
    }
  } while (++i < fetches);
  s.albedo *= m.base_color.rgb;
  s.emission = constant ? m.emission.rgb : s.emission * m.emission.rgb;
  return s;
}
#endif
