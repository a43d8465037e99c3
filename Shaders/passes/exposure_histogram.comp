// Histogram of log2 luminance of the picture, every second pixel each way: bins of 0.1875 from 2^-14 to 2^10.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/pixel.glsl"
#include "lib/exposure.glsl"
#include "lib/shown.glsl"

shared uint bins[kHistogramBins];

void main() {
  uint lane = gl_LocalInvocationID.x;
  for (uint i = lane; i < kHistogramBins; i += 64u) bins[i] = 0u;
  barrier();
  uvec2 pixel = invocation_pixel() * 2u;
  if (pixel.x < frame.width && pixel.y < frame.height) {
    float y = luminance(shown_radiance(pixel.y * frame.width + pixel.x));
    if (y > 0.0) atomicAdd(bins[luminance_bin(y)], 1u);
  }
  barrier();
  for (uint i = lane; i < kHistogramBins; i += 64u) {
    if (bins[i] != 0u) atomicAdd(exposure_buffer.at[0].histogram[i], bins[i]);
  }
}
