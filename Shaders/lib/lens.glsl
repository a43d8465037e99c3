// What lies between the scene's radiance and the tone curve: the light that a lens spreads, and an exposure of its own
// for every part of the picture.
#ifndef FB_LIB_LENS
#define FB_LIB_LENS
#include "lib/exposure.glsl"
#include "lib/frame_bindings.glsl"
#include "shared/denoise.h"

const float kBloomBrightest = 200.0;  // times white: a sun's disc does not fill the picture

vec3 read_bloom(uint at) { return unpack_rgb9e5(exposure_buffer.at[0].bloom[at]); }
void write_bloom(uint at, vec3 exposed) { exposure_buffer.at[0].bloom[at] = pack_rgb9e5(exposed, 0.5); }

// Exposed; bilinear.
vec3 bloom_at(vec2 pixel) {
  vec2 place = pixel / vec2(frame.width, frame.height) * vec2(kBloomWidth, kBloomHeight) - 0.5, corner = floor(place);
  vec2 f = place - corner;
  vec3 sum = vec3(0.0);
  for (uint i = 0u; i < 4u; ++i) {
    vec2 offset = vec2(i & 1u, i >> 1u), weights = mix(1.0 - f, f, offset);
    uvec2 p = uvec2(clamp(corner + offset, vec2(0.0), vec2(kBloomWidth, kBloomHeight) - 1.0));
    sum += weights.x * weights.y * read_bloom(p.y * kBloomWidth + p.x);
  }
  return sum;
}

const float kShadows = 0.5;  // of what is taken from bright parts is given to dark ones

// Factor on a pixel's exposed radiance: its surroundings, of those as bright as it is, come nearer to mid-grey; what it
// differs from them by stays.
float local_exposure(vec2 pixel, float exposed) {
  float exposure = log2(exposure_now()), own = log2(max(exposed, 1e-6)) - exposure;
  vec3 place = grid_place(pixel, own), corner = floor(place), f = place - corner;
  vec2 sum = vec2(0.0);
  for (uint i = 0u; i < 8u; ++i) {
    vec3 offset = vec3(i & 1u, (i >> 1u) & 1u, i >> 2u), weights = mix(1.0 - f, f, offset);
    uvec3 at = uvec3(clamp(corner + offset, vec3(0.0), vec3(kGridSize) - 1.0));
    vec2 cell = unpackHalf2x16(exposure_buffer.at[0].grid[grid_cell(at)]);
    sum += weights.x * weights.y * weights.z * cell.x * vec2(1.0, cell.y);
  }
  float around = sum.x > 0.0 ? sum.y / sum.x : own;
  float above = around + exposure - log2(0.18);
  return exp2(-frame.local_exposure * (above > 0.0 ? above : kShadows * above));
}
#endif
