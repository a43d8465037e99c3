// Suns that are looked for: straight, refracted by the surface of the liquid that a vertex is in, or mirrored by one
// (shared/bent_sun.h). All densities are per solid angle as seen from the vertex.
#ifndef FB_LIB_SUNS
#define FB_LIB_SUNS
#include "lib/interaction.glsl"
#include "shared/bent_sun.h"
#include "shared/sun_disc.h"

// One sun of all, each as often; 0: outside of all discs.
float sun_pdf(vec3 direction) {
  if (frame.sun_count == 0u) return 0.0;
  float p = 0.0;
  uint i = 0u;
  do {
    vec4 sun = frame.sun_direction[i];
    if (within_sun(direction, sun.xyz, sun.w)) p += 1.0 / sun_solid_angle(sun.w);
  } while (++i < frame.sun_count);
  return p / float(frame.sun_count);
}

float wave_slope() { return kWaveMeanSlope * frame.water_height / frame.water_size; }

// Within a liquid, whose surface lets suns in: all ways from there that end inside of a sun's disc are looked for, bent
// or not.
bool bends_suns(Vertex v) {
  return FEATURE_WATER && has_feature(kFeatureSuns) && v.liquid != kNoIndex &&
         (material_at(v.liquid & kNoMaterial).flags & kMaterialLiquid) != 0u;
}
// In air, where some level surface may mirror one: ways that an interface reflects first.
bool mirrors_suns(Vertex v) {
  return FEATURE_WATER && has_feature(kFeatureSuns) && frame.mirrors != 0u && frame.sun_count > 0u &&
         v.liquid == kNoIndex;
}

BentSun refracted_sun_of(Vertex v, uint i) {
  vec4 sun = frame.sun_direction[i];
  return refracted_sun(sun.xyz, sun.w, medium_index(v.liquid), wave_slope());
}
BentSun mirrored_sun_of(uint i) {
  vec4 sun = frame.sun_direction[i];
  return mirrored_sun(sun.xyz, sun.w, wave_slope());
}

float refracted_density(Vertex v, vec3 direction) {
  float p = 0.0;
  uint i = 0u;
  do p += bent_sun_pdf(refracted_sun_of(v, i), direction);
  while (++i < frame.sun_count);
  return p / float(frame.sun_count);
}
float mirrored_density(vec3 direction) {
  float p = 0.0;
  uint i = 0u;
  do p += bent_sun_pdf(mirrored_sun_of(i), direction);
  while (++i < frame.sun_count);
  return p / float(frame.sun_count);
}

// A direction in a sun's disc, uniform for u in [0, 1)^2; and what u it has.
vec3 in_disc(vec4 sun, vec2 u) {
  float k = u.x * sun.w, phi = 2.0 * kPiShared * u.y;  // k: 1 - cos
  float r = sqrt(k * (2.0 - k));
  return frame_about(sun.xyz) * vec3(r * cos(phi), r * sin(phi), 1.0 - k);
}
vec2 place_in_disc(vec4 sun, vec3 direction) {
  vec3 local = direction * frame_about(sun.xyz);
  float square = dot(local.xy, local.xy), k = square / (1.0 + sqrt(max(1.0 - square, 0.0)));
  return vec2(clamp(k / sun.w, 0.0, 1.0), fract(atan(local.y, local.x) / (2.0 * kPiShared) + 1.0));
}

// Towards a sun, straight or, where the vertex bends them, refracted; zero: there is none. `radiance`: sum of the
// channels.
vec3 sample_sun(Vertex v, bool bends, inout uint rng, out float radiance) {
  uint i = rng_next(rng) % frame.sun_count;
  vec4 sun = frame.sun_direction[i];
  radiance = frame.sun_radiance[i].w;
  vec2 u = vec2(rng_uniform(rng), rng_uniform(rng));
  if (bends) return bent_sun_sample(refracted_sun_of(v, i), u);
  return in_disc(sun, u);
}

// Towards where level water mirrors one. `radiance`: of the sun times what water reflects of it.
vec3 sample_mirrored_sun(inout uint rng, out float radiance) {
  uint i = rng_next(rng) % frame.sun_count;
  radiance = frame.sun_radiance[i].w * dielectric_reflectance(max(frame.sun_direction[i].z, 0.0), kIndexOfWater);
  return bent_sun_sample(mirrored_sun_of(i), vec2(rng_uniform(rng), rng_uniform(rng)));
}
#endif
