// What a pixel shows by way of water, in planes behind those of the G-buffer: a second surface beside the texel's own, since the
// first interface that the camera's ray meets reflects one and lets another through. The texel's albedo is that of both together,
// each with its share, so that what divides light by it (the denoiser) has their mean irradiance.
#ifndef FB_LIB_WATER_TEXEL
#define FB_LIB_WATER_TEXEL
#include "lib/gbuffer_texel.glsl"
#include "lib/interaction.glsl"
#include "shared/color.h"

struct WaterTexel {
  vec3 position;  // of the second surface
  uint liquid;    // that it is in: a material, or kNoIndex
  vec3 albedo;    // times its share; black: there is none
  uint own_liquid;              // that the texel's own surface is in
  uint normal, shading_normal;  // of the second
  bool bent;                    // an interface is before both; else nothing of the second is stored but its albedo
};

const uint kFirstWaterPlane = 5u;

void store_water(uint at, WaterTexel w) {
  gbuffer.at[in_plane(kFirstWaterPlane, at)] = uvec4(floatBitsToUint(w.albedo), w.own_liquid);
  if (!w.bent) return;
  gbuffer.at[in_plane(kFirstWaterPlane + 1u, at)] = uvec4(floatBitsToUint(w.position), w.liquid);
  gbuffer.at[in_plane(kFirstWaterPlane + 2u, at)] = uvec4(w.normal, w.shading_normal, 0u, 0u);
}

WaterTexel water_at(uint at) {
  uvec4 a = gbuffer_quad(at, kFirstWaterPlane), b = gbuffer_quad(at, kFirstWaterPlane + 1u), c = gbuffer_quad(at, kFirstWaterPlane + 2u);
  return WaterTexel(uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(a.xyz), a.w, c.x, c.y, false);
}

// Chooses one of a pixel's two surfaces for a path, by how much each can reflect. `v`: the texel's own. The factor on what the
// path brings.
float choose_surface(inout Vertex v, uint at, bool bent, inout uint rng) {
  WaterTexel w = water_at(at);
  v.liquid = w.own_liquid;
  v.scatter.bsdf.albedo = max(v.scatter.bsdf.albedo - w.albedo, vec3(0.0));
  if (bent) {
    v.previous = v.position;
    v.view = v.scatter.shading_normal;  // Lambertian, whatever its material: no viewer is asked
  }
  float own = luminance(v.scatter.bsdf.albedo), second = luminance(w.albedo);
  float chance = second > 0.0 ? own > 1e-6 * second ? clamp(second / (own + second), 0.05, 0.95) : 1.0 : 0.0;
  if (rng_uniform(rng) >= chance) return 1.0 / (1.0 - chance);
  v.position = v.previous = w.position;
  v.liquid = w.liquid;
  v.scatter.normal = unpack_direction(w.normal);
  v.scatter.shading_normal = unpack_direction(w.shading_normal);
  v.view = v.scatter.shading_normal;
  v.scatter.bsdf = Bsdf(w.albedo, 1.0, 0.0, 0.0);
  return 1.0 / chance;
}
#endif
