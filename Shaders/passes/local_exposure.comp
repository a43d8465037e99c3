// Smooths the grid of luminance: over neighbouring places and bins, whose numbers of pixels are its weights. What a
// pixel finds in it is the mean log luminance of its surroundings, of those that are about as bright as it is.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/frame_bindings.glsl"
#include "lib/exposure.glsl"

layout(local_size_x = 64) in;

void main() {
  uint cell = gl_GlobalInvocationID.x;
  if (cell >= kGridCells) return;
  ivec3 at = ivec3(cell % kGridWidth, cell / kGridWidth % kGridHeight, cell / (kGridWidth * kGridHeight));
  vec2 sum = vec2(0.0);
  for (int i = 0; i < 27; ++i) {
    ivec3 step = ivec3(i % 3, i / 3 % 3, i / 9) - 1;
    ivec3 p = at + step;
    bool inside = all(greaterThanEqual(p, ivec3(0))) && all(lessThan(p, ivec3(kGridSize)));
    vec3 near = vec3(1.0) - 0.5 * vec3(abs(step));
    uint from = inside ? grid_cell(uvec3(p)) : 0u;
    float weight = inside ? near.x * near.y * near.z : 0.0;
    float count = float(exposure_buffer.at[0].grid_count[from]);
    float total = float(exposure_buffer.at[0].grid_sum[from]) * (1.0 / 256.0) + count * kMinLog2Luminance;
    sum += weight * vec2(count, total);
  }
  exposure_buffer.at[0].grid[cell] = packHalf2x16(vec2(min(sum.x, 60000.0), sum.y / max(sum.x, 1e-6)));
}
