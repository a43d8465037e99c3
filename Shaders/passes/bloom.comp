// The light that a lens spreads: the picture made small, and smoothed by a Gaussian along each axis.
// STEP 0: small, 1: along x, 2: along y.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/pixel.glsl"
#include "lib/lens.glsl"
#include "lib/shown.glsl"

const float kBloomSigma = 0.02;  // of the picture's height

void main() {
  uvec2 pixel = invocation_pixel();
  if (pixel.x >= kBloomWidth || pixel.y >= kBloomHeight) return;
  uint at = pixel.y * kBloomWidth + pixel.x;
#if STEP == 0
  uvec2 size = uvec2(frame.width, frame.height), whole = uvec2(kBloomWidth, kBloomHeight);
  uvec2 first = pixel * size / whole, end = max((pixel + 1u) * size / whole, first + 1u), block = end - first;
  vec3 sum = vec3(0.0);
  for (uint i = 0u; i < block.x * block.y; ++i) {
    uvec2 p = first + uvec2(i % block.x, i / block.x);
    sum += min(shown_radiance(p.y * frame.width + p.x) * exposure_now(), vec3(kBloomBrightest));
  }
  write_bloom(at, sum / float(block.x * block.y));
#else
  float sigma =
      kBloomSigma * (STEP == 1 ? float(kBloomWidth * frame.height) / float(frame.width) : float(kBloomHeight));
  int reach = int(ceil(2.5 * sigma));
  uint from = STEP == 1 ? 0u : kBloomPixels;
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    ivec2 p =
        clamp(ivec2(pixel) + (STEP == 1 ? ivec2(i, 0) : ivec2(0, i)), ivec2(0), ivec2(kBloomWidth, kBloomHeight) - 1);
    float weight = exp(-0.5 * float(i * i) / (sigma * sigma));
    sum += weight * read_bloom(from + uint(p.y) * kBloomWidth + uint(p.x));
    weights += weight;
  }
  write_bloom(STEP == 1 ? kBloomPixels + at : at, sum / weights);
#endif
}
