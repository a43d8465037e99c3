// Histogram of log2 luminance of the picture, every second pixel each way: bins of 0.1875 from 2^-14 to 2^10; and the
// grid of luminance by place. A workgroup's pixels count to one place.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/pixel.glsl"
#include "lib/exposure.glsl"
#include "lib/shown.glsl"

shared uint bins[kHistogramBins];
shared uint cell_count[kGridBins], cell_sum[kGridBins];

void main() {
  uint lane = gl_LocalInvocationID.x;
  for (uint i = lane; i < kHistogramBins; i += 64u) bins[i] = 0u;
  if (lane < kGridBins) cell_count[lane] = cell_sum[lane] = 0u;
  barrier();
  uvec2 pixel = invocation_pixel() * 2u;
  if (pixel.x < frame.width && pixel.y < frame.height) {
    float y = luminance(shown_radiance(pixel.y * frame.width + pixel.x));
    if (y > 0.0) {
      atomicAdd(bins[luminance_bin(y)], 1u);
      float above = clamp(log2(y) - kMinLog2Luminance, 0.0, kLog2PerCell * float(kGridBins) - 0.01);
      uint cell = uint(above / kLog2PerCell);
      atomicAdd(cell_count[cell], 1u);
      atomicAdd(cell_sum[cell], uint(256.0 * above));
    }
  }
  barrier();
  for (uint i = lane; i < kHistogramBins; i += 64u) {
    if (bins[i] != 0u) atomicAdd(exposure_buffer.at[0].histogram[i], bins[i]);
  }
  if (lane < kGridBins && cell_count[lane] != 0u) {
    vec2 middle = min(vec2(gl_WorkGroupID.xy * 16u + 8u), vec2(frame.width, frame.height) - 0.5);
    uvec2 place = uvec2(grid_place(middle, 0.0).xy + 0.5);
    uint at = grid_cell(uvec3(place, lane));
    atomicAdd(exposure_buffer.at[0].grid_count[at], cell_count[lane]);
    atomicAdd(exposure_buffer.at[0].grid_sum[at], cell_sum[lane]);
  }
}
