// Light that the medium scatters, as the denoiser keeps it: at each block of pixels a texel (shared/denoise.h, MediumTexel).
#ifndef FB_LIB_MEDIUM_HISTORY
#define FB_LIB_MEDIUM_HISTORY
#include "lib/denoise.glsl"
#include "shared/medium.h"

ivec2 medium_size() {
  uint block = frame.medium_block;
  return ivec2(frame.medium_width, (frame.height + block - 1u) / block);
}
uint medium_slot(uint slot) {
  ivec2 size = medium_size();
  return medium_slots(frame.width * frame.height, frame.smooth_width * frame.smooth_height) + slot * uint(size.x * size.y);
}

struct MediumLight {
  vec3 light;        // what the medium would scatter if it took all light, over its albedo
  float frames;      // 0: none
  float near;        // logarithm of where it scatters, in the mean
  float mean, mean_square;  // of luminance
};
MediumLight unpack_medium(uvec4 t) {
  vec2 moments = unpackHalf2x16(t.w);
  return MediumLight(vec3(unpackHalf2x16(t.x), unpackHalf2x16(t.y & 0xffffu).x), float(t.y >> 16u), uintBitsToFloat(t.z), moments.x,
                     moments.y * moments.y);
}
uvec4 pack_medium(MediumLight m) {
  return uvec4(packHalf2x16(m.light.rg), (packHalf2x16(vec2(m.light.b, 0.0)) & 0xffffu) | (uint(m.frames + 0.5) << 16u),
               floatBitsToUint(m.near), packHalf2x16(vec2(m.mean, sqrt(max(m.mean_square, 0.0)))));
}

// Distance along a pixel's ray to its surface, from the depth; far where there is none.
float medium_reach(float depth, vec3 ray) { return depth > 0.0 ? depth * length(ray) : 1e6; }

// What scatters on a pixel's way, fog and a liquid together.
struct MediumThere {
  vec3 factor;     // that would be scattered if light of radiance 1 was everywhere; zero: nothing scatters
  float distance;  // at which, in the mean
};
MediumThere medium_there(uint at, vec3 ray) {
  float reach = medium_reach(uintBitsToFloat(gbuffer_quad(at, 4u).z), ray);
  MediumThere there = MediumThere(frame.medium.rgb * opacity(frame.camera_fog, reach), mean_interaction(frame.camera_fog, reach));
  if (frame.turbid == 0u) return there;
  uvec4 words = gbuffer_quad(at, kFirstWaterPlane + 3u);
  vec2 rest = unpackHalf2x16(words.y);
  vec3 liquid = vec3(unpackHalf2x16(words.x), rest.x);
  float of_fog = luminance_of(there.factor), of_liquid = luminance_of(liquid);
  there.distance = of_liquid > 0.0 ? mix(there.distance, rest.y, of_liquid / (of_fog + of_liquid)) : there.distance;
  there.factor += liquid;
  return there;
}
// How much two places of scattering are apart, as a factor of weight.
float medium_alike(float near, float other) { return exp(-4.0 * abs(near - other)); }
#endif
