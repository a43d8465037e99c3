// While nothing changes: the denoised picture gives way to the accumulated mean, so that it converges to what is right.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/denoise.glsl"

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= frame.width || pixel.y >= frame.height) return;
  uint at = pixel.y * frame.width + pixel.x, to = section(kSectionDenoised) + at;
  vec4 color = uintBitsToFloat(history[to]);
  history[to] = floatBitsToUint(mix(color, mean_radiance[at], frame.mean_weight));
}
