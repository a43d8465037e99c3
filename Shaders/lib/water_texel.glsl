// What a pixel shows by way of water, in planes behind those of the G-buffer: a second surface beside the texel's own,
// since the first interface that the camera's ray meets reflects one and lets another through. The texel's albedo is
// that of both together, each with its share.
#ifndef FB_LIB_WATER_TEXEL
#define FB_LIB_WATER_TEXEL
#include "lib/gbuffer_texel.glsl"
#include "lib/interaction.glsl"
#include "lib/second_surface.glsl"
#include "lib/work.glsl"

struct WaterTexel {
  vec3 position;  // of the second surface
  uint liquid;    // that it is in: a material, or kNoIndex
  SecondTexel seen;
  uint own_liquid;              // that the texel's own surface is in; with a veil its share, a float's bits
  uint normal, shading_normal;  // of the second
  bool bent;                    // an interface is before both; else nothing of the second is stored but its albedo
};
const WaterTexel kNoWater = WaterTexel(vec3(0.0), kNoIndex, kNoSecond, kNoIndex, 0u, 0u, false);

// The piece of the camera's way on which a liquid scatters light to it: where the camera is in one its straight way to
// the first surface or interface, else the way behind the first interface. All other pieces are left out.
struct LiquidPiece {
  vec3 direction;
  float reach;     // 0: there is none
  float start;     // distance at which it begins, along the camera's straight ray
  float through;   // share of its light that the camera sees
  uint liquid;     // as Vertex::liquid
  float straight;  // units of the camera's straight ray that one of it looks like
};
const LiquidPiece kNoPiece = LiquidPiece(vec3(0.0), 0.0, 0.0, 1.0, kNoIndex, 1.0);

// What it would scatter if light of radiance 1 was everywhere.
vec3 scattered_by(LiquidPiece p) {
  if (p.reach <= 0.0) return vec3(0.0);
  GpuMaterial m = material_at(p.liquid & kNoMaterial);
  vec3 way = vec3(transmittance_integral(m.extinction_r, p.reach), transmittance_integral(m.extinction_g, p.reach),
                  transmittance_integral(m.extinction_b, p.reach));
  return way * (m.scattering * p.through * haze_left(camera_haze(), p.start));
}

void store_water(uint at, WaterTexel w, LiquidPiece p) {
  gbuffer.at[in_plane(kFirstWaterPlane, at)] = uvec4(pack_second(w.seen), w.own_liquid);
  if (w.seen.albedo != vec3(0.0)) ask_for(kWorkSecond, frame.light_width);
  if (frame.turbid != 0u) {
    if (p.reach > 0.0) ask_for(kWorkMedium, frame.medium_width);
    vec3 light = scattered_by(p);
    float mean = p.reach > 0.0 ? p.start + p.straight * mean_interaction(
                                                            material_at(p.liquid & kNoMaterial).extinction_g, p.reach)
                               : 0.0;
    gbuffer.at[in_plane(kLiquidPlane, at)] = uvec4(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, mean)),
                                                   floatBitsToUint(p.reach), pack_direction(p.direction));
  }
  if (!w.bent) return;
  gbuffer.at[in_plane(kFirstWaterPlane + 1u, at)] = uvec4(floatBitsToUint(w.position), w.liquid);
  gbuffer.at[in_plane(kFirstWaterPlane + 2u, at)] =
      uvec4(w.normal, w.shading_normal, floatBitsToUint(p.start),
            (p.liquid & kNoMaterial) | uint(p.through * 65535.0 + 0.5) << 16u);
}

WaterTexel water_at(uint at) {
  uvec4 a = gbuffer_quad(at, kFirstWaterPlane), b = gbuffer_quad(at, kFirstWaterPlane + 1u),
        c = gbuffer_quad(at, kFirstWaterPlane + 2u);
  return WaterTexel(uintBitsToFloat(b.xyz), b.w, second_texel(a), a.w, c.x, c.y, false);
}

LiquidPiece liquid_piece_at(uint at, vec3 camera_ray) {
  uvec4 d = gbuffer_quad(at, kLiquidPlane);
  float reach = frame.turbid != 0u ? uintBitsToFloat(d.z) : 0.0;
  if (frame.camera_liquid != kNoIndex) return LiquidPiece(camera_ray, reach, 0.0, 1.0, frame.camera_liquid, 1.0);
  if (!(reach > 0.0)) return kNoPiece;
  uvec4 c = gbuffer_quad(at, kFirstWaterPlane + 2u);
  return LiquidPiece(unpack_direction(d.w), reach, uintBitsToFloat(c.z), float(c.w >> 16u) / 65535.0,
                     medium_within(kNoIndex, c.w & kNoMaterial), 1.0);
}

// Chooses one of a pixel's two surfaces for a path. `v`: the texel's own. The factor on what the path brings.
float choose_surface(inout Vertex v, uint at, bool bent, inout uint rng, out bool second) {
  WaterTexel w = water_at(at);
  vec3 own = max(v.scatter.bsdf.albedo - w.seen.albedo, vec3(0.0));
  // A veil's surface keeps its gloss, so that its share is the path's factor, not the albedo's.
  bool veiled = has_feature(kFeatureVeils) && w.own_liquid != kNoIndex;
  float share = veiled ? uintBitsToFloat(w.own_liquid) : 1.0;
  v.liquid = veiled ? kNoIndex : w.own_liquid;
  v.scatter.bsdf.albedo = own / share;
  if (bent) {
    v.previous = v.position;
    v.view = v.scatter.shading_normal;  // Lambertian, whatever its material: no viewer is asked
  }
  if (veiled) own += share * v.scatter.bsdf.specular;
  float chance = chance_of_second(own, w.seen.albedo);
  second = rng_uniform(rng) < chance;
  if (!second) return share / (1.0 - chance);
  v.position = v.previous = w.position;
  v.liquid = w.liquid;
  v.glows = false;
  v.scatter.normal = unpack_direction(w.normal);
  v.scatter.shading_normal = unpack_direction(w.shading_normal);
  v.view = v.scatter.shading_normal;
  v.scatter.bsdf = Bsdf(w.seen.albedo, 1.0, 0.0, 0.0);
  return 1.0 / chance;
}
#endif
