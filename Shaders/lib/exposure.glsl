// Luminance and the exposure histogram's bins.
#ifndef FB_LIB_EXPOSURE
#define FB_LIB_EXPOSURE
#include "shared/color.h"
#include "lib/frame_bindings.glsl"

const float kMinLog2Luminance = -14.0;
const float kLog2PerBin = 0.1875;

uint luminance_bin(float y) {
  return uint(clamp((log2(y) - kMinLog2Luminance) / kLog2PerBin, 0.0, float(kHistogramBins) - 1.0));
}
float bin_log2_luminance(uint bin) { return kMinLog2Luminance + (float(bin) + 0.5) * kLog2PerBin; }

// Where a pixel is in the grid of luminance, in cells; whole numbers are their middles.
const float kLog2PerCell = 1.5;
vec3 grid_place(vec2 pixel, float log2_luminance) {
  vec2 at = pixel / vec2(frame.width, frame.height) * vec2(kGridWidth, kGridHeight);
  return vec3(at, (log2_luminance - kMinLog2Luminance) / kLog2PerCell) - 0.5;
}
uint grid_cell(uvec3 at) { return (at.z * kGridHeight + at.y) * kGridWidth + at.x; }
const uvec3 kGridSize = uvec3(kGridWidth, kGridHeight, kGridBins);
#endif
