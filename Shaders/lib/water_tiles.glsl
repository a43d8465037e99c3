// The tiles of the picture where some pixel shows an interface of water or glass: found by gbuffer.comp, worked on by
// gbuffer_water.comp, a workgroup each, in rows as long as the picture's.
#ifndef FB_LIB_WATER_TILES
#define FB_LIB_WATER_TILES
#include "lib/pixel.glsl"
#include "lib/work.glsl"

// In `ldr`, which the frame needs later: a word for each tile, 1: it is one; behind these the list.
uvec2 picture_tiles() { return uvec2((frame.width + 7u) / 8u, (frame.height + 7u) / 8u); }

void add_water_tile(uvec2 tile) {
  uvec2 tiles = picture_tiles();
  uint index = tile.y * tiles.x + tile.x;
  if (atomicExchange(ldr.at[index], 1u) != 0u) return;
  uint word = work_word(kWorkWater, frame.work_parity), number = atomicAdd(counters.at[word + 3u], 1u);
  ldr.at[tiles.x * tiles.y + number] = index;
  counters.at[word] = tiles.x;
  atomicMax(counters.at[word + 1u], number / tiles.x + 1u);
}

// The pixel of this invocation; false: its workgroup has no tile.
bool water_pixel(out uvec2 pixel) {
  pixel = invocation_pixel();
  if (frame.camera_liquid != kNoIndex) return true;
  uvec2 tiles = picture_tiles();
  uint number = gl_WorkGroupID.y * tiles.x + gl_WorkGroupID.x;
  if (number >= counters.at[work_word(kWorkWater, frame.work_parity) + 3u]) return false;
  uint index = ldr.at[tiles.x * tiles.y + number];
  pixel = uvec2(index % tiles.x, index / tiles.x) * 8u + pixel % 8u;
  return true;
}
#endif
