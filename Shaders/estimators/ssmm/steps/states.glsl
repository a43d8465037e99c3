// The block and the arrays of screen-space mixtures, and which lobe is whose.
#ifndef FB_SSMM_STATES
#define FB_SSMM_STATES
#include "estimators/ssmm/ssmm.h"
#include "lib/pixel.glsl"
#include "shared/rng.h"
#include "shared/scene_gpu.h"

layout(set = kSetScene, binding = kBindTechniqueConstants, std140) uniform SsmmBlock { SsmmConstants ssmm; };
FB_TECHNIQUE_ARRAY(kSsmmStates, 16, , ChainArray, uvec4, chain_states)
FB_TECHNIQUE_ARRAY(kSsmmLobes, 16, , LobeArray, uvec4, chain_lobes)

ChainState unpack_chain_state(uvec4 a, uvec4 b) {
  ChainState s;
  s.target = uintBitsToFloat(a.xyz);
  s.weight = uintBitsToFloat(a.w);
  s.spread = uintBitsToFloat(b.x);
  s.count = uintBitsToFloat(b.y);
  s.score = uintBitsToFloat(b.z);
  return s;
}
#define FB_STORE_CHAIN(array, element, s)                                                 \
  array.at[2u * (element)] = uvec4(floatBitsToUint(s.target), floatBitsToUint(s.weight)); \
  array.at[2u * (element) + 1u] =                                                         \
      uvec4(floatBitsToUint(s.spread), floatBitsToUint(s.count), floatBitsToUint(s.score), 0u);
#define FB_LOAD_CHAIN(array, element) unpack_chain_state(array.at[2u * (element)], array.at[2u * (element) + 1u])

uvec2 lit_blocks() { return uvec2(frame.light_width, (frame.height + frame.light_block - 1u) / frame.light_block); }

// A tile, and what its lanes exchange in this frame: the same for all of its pixels.
struct Tile {
  uvec2 at;
  uint lanes, lane;  // lane: the pixel's own
  uint draw;         // even over all lanes
};
Tile tile_at(uvec2 block, uint path) {
  Tile t;
  t.lanes = lanes_of(ssmm.ssmm_tile);
  t.at = tile_of(block, t.lanes);
  t.lane = lane_of(block, t.lanes);
  uint of_path = ssmm.ssmm_temporal != 0 ? 0u : path;
  t.draw = ssmm.ssmm_shuffle != 0
               ? rng_seed(t.at.y << 16u | t.at.x, frame.frame, of_path ^ 0x5bd1e995u, frame.seed) % t.lanes
               : 0u;
  return t;
}
// The lane whose lobe a pixel's path samples.
uint sampled_lane(Tile t, uint path) { return sampled_lane(t.lane, t.draw, path, t.lanes, ssmm.ssmm_temporal != 0); }
// The pixel's element; kNoIndex beyond the picture's edge, where a lane has no state.
uint element_of_lane(Tile t, uint lane) {
  uvec2 block = block_of_lane(t.at, lane, t.lanes);
  return all(lessThan(block, lit_blocks())) ? block.y * frame.light_width + block.x : kNoIndex;
}
ChainState lobe_of_element(uint element) {
  if (element == kNoIndex) return no_chain_state();
  return FB_LOAD_CHAIN(chain_lobes, element);
}
#endif
