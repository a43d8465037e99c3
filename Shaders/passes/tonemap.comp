// Radiance to displayable colour: what the lens does (LENS), exposure, a filmic curve that keeps colours, sRGB, half a
// step of dither against banding.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/pixel.glsl"
#include "lib/shown.glsl"
#if LENS
#include "lib/lens.glsl"
#endif
#include "shared/rng.h"
#include "shared/tone.h"

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x;
  vec3 linear = shown_radiance(at) * exposure_now();
#if LENS
  vec2 middle = vec2(pixel) + 0.5;
  linear = mix(linear, bloom_at(middle), frame.bloom);
  linear *= local_exposure(middle, luminance(linear));
#endif
  vec3 color = srgb_from_linear(frame.tone_map != 0u ? filmic(linear) : linear);
  float dither = float(hash_u32(at) >> 8u) * (1.0 / 16777216.0) - 0.5;
  ldr.at[at] = packUnorm4x8(vec4(color + dither / 255.0, 1.0));
}
