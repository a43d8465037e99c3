// The grid of what shadow rays reach (shared/seen_grid.h), of techniques that look for light.
#ifndef FB_LIB_SEEN_GRID
#define FB_LIB_SEEN_GRID
#include "lib/arrays.glsl"
#include "shared/bindings.h"
#include "shared/seen_grid.h"

FB_TECHNIQUE_ARRAY(kBindSeen, 16, , SeenArray, uvec4, seen_cells)
FB_TECHNIQUE_ARRAY(kBindSeen, 4, , SeenWordArray, uint, seen_words)
layout(set = kSetScene, binding = kBindTexelBuffers + kTexelsTechnique + kBindSeen) uniform usamplerBuffer seen_texels;

SeenLamps seen_lamps(uint cell) {
  int at = int(kSeenLampQuads + 2u * cell);
  return SeenLamps(texelFetch(seen_texels, at), texelFetch(seen_texels, at + 1));
}

uint way_words(uint table, uint way) { return kSeenWaysWords + 2u * (table * kSeenWays + way); }
uvec2 seen_way_entry(uint table, uint way) {
  uvec4 two = texelFetch(seen_texels, int(way_words(table, way) / 4u));
  return (way & 1u) != 0u ? two.zw : two.xy;
}
#endif
