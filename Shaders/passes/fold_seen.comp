// Folds this frame's shadow rays into the grid of what they reach.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "lib/frame_bindings.glsl"
#include "lib/seen_grid.glsl"

layout(local_size_x = 64) in;

void main() {
  uint at = gl_GlobalInvocationID.x;
  if (at >= kSeenCells) return;
  uvec4 cell = seen_cells.at[at];
  if ((cell.z | cell.w) != 0u) seen_cells.at[at] = uvec4(fold_seen(cell.x, cell.z), fold_seen(cell.y, cell.w), 0u, 0u);
  uint found = seen_words.at[kSeenFoundWords + at];
  if (found == 0u) return;
  seen_words.at[kSeenFoundWords + at] = 0u;
  SeenLamps lamps = seen_lamps(at);
  uint filled = kSeenLamps - times_seen(lamps, 0u), place = filled < kSeenLamps ? filled : frame.frame % kSeenLamps;
  uint word = 4u * (kSeenLampQuads + 2u * at) + place / 2u, shift = 16u * (place & 1u);
  seen_words.at[word] = (seen_words.at[word] & ~(0xffffu << shift)) | ((found & 0xffffu) << shift);
}
