// The list of lights (shared/scene_gpu.h): triangles that glow, each with a probability, and the lamps that they are
// of. All densities are per solid angle as seen from the origin of the ray.
#ifndef FB_LIB_LIGHTS
#define FB_LIB_LIGHTS
#include "lib/frame_bindings.glsl"
#include "lib/surface.glsl"

layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsLights) uniform usamplerBuffer light_texels;

bool has_lights() { return frame.light_count > 0u; }

// The light that an instance's triangle 0 is; kNoIndex: nothing of it glows.
uint first_light_of(uint instance) { return texelFetch(light_texels, int(instance >> 2u))[instance & 3u]; }

GpuLight light_at(uint index) {
  int at = int(frame.light_first + 2u * index);
  uvec4 a = texelFetch(light_texels, at), b = texelFetch(light_texels, at + 1);
  return GpuLight(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w);
}

uvec2 lamp_words(uint number) {
  uvec4 two = texelFetch(light_texels, int(frame.lamp_first + (number >> 1u)));
  return (number & 1u) != 0u ? two.zw : two.xy;
}
GpuLamp lamp_at(uint number) {
  uvec2 words = lamp_words(number);
  return GpuLamp(words.x & ~kLampIsNew, words.y);
}

float light_probability(GpuLight light) { return float(light.probability) / float(kLightRange); }

uint random_below(uint count, inout uint rng) {
  uint place, unused;
  umulExtended(rng_next(rng), count, place, unused);
  return place;
}

// One of all, by its probability.
GpuLight sample_light(inout uint rng) {
  uint place = random_below(frame.light_count, rng);
  GpuLight light = light_at(place);
  bool itself = (rng_next(rng) & (kLightRange - 1u)) < light.threshold;
  return light_at(itself ? place : light.other);
}

// One of a lamp's, likewise; the lamp has some.
GpuLight sample_lamp(GpuLamp lamp, inout uint rng) {
  GpuLight place = light_at(lamp.first + random_below(lamp.count, rng));
  bool itself = (rng_next(rng) & (kLampRange - 1u)) < place.lamp_threshold;
  return light_at(lamp.first + (itself ? place.lamp_lights & 0xffffu : place.lamp_lights >> 16u));
}

float probability_in_lamp(GpuLight light) { return float(light.lamp >> 16u) / float(kLampRange); }

// Uniform on a triangle: weights of its vertices 1 and 2.
vec2 sample_triangle(inout uint rng) {
  float root = sqrt(rng_uniform(rng)), along = rng_uniform(rng);
  return vec2(root * (1.0 - along), root * along);
}

// A point of the list's lights, to choose distances in a medium by; false: it has none.
bool point_of_light(inout uint rng, out vec3 place) {
  place = vec3(0.0);
  if (!has_lights()) return false;
  GpuLight light = sample_light(rng);
  vec2 at = sample_triangle(rng);
  GpuTriangle t = world_triangle(light.instance, light.triangle);
  place = t.v0.xyz + t.e1.xyz * at.x + t.e2.xyz * at.y;
  return true;
}

// Density of a uniform point on a triangle of the world, seen at `distance`; 0: it is edge on.
float triangle_pdf(GpuTriangle t, float distance, vec3 direction) {
  vec3 area = 0.5 * cross(t.e1.xyz, t.e2.xyz);
  float facing = abs(dot(area, direction));  // area times cosine
  return facing > 0.0 ? distance * distance / facing : 0.0;
}
#endif
