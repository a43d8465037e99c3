// Folds this frame's shadow rays into the grid of what they reach.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/seen_grid.glsl"

layout(local_size_x = 64) in;

void main() {
  uint at = gl_GlobalInvocationID.x;
  if (at >= kSeenCells) return;
  uvec4 cell = seen_cells.at[at];
  if ((cell.z | cell.w) == 0u) return;
  seen_cells.at[at] = uvec4(fold_seen(cell.x, cell.z), fold_seen(cell.y, cell.w), 0u, 0u);
}
