// States that cells of the world keep, and which cell a pixel's surface is in.
#ifndef FB_SSMM_WORLD
#define FB_SSMM_WORLD
#include "estimators/ssmm/steps/states.glsl"
#include "lib/gbuffer_texel.glsl"
#include "shared/hash_grid.h"
#include "shared/packing.h"

FB_TECHNIQUE_ARRAY(kSsmmWorld, 16, , WorldArray, uvec4, world_states)
FB_TECHNIQUE_ARRAY(kSsmmClaims, 4, , ClaimArray, uint, world_claims)
FB_TECHNIQUE_ARRAY(kSsmmClaimed, 4, , ClaimedArray, uint, world_claimed)

uint slot_of(GridKey cell) { return cell.hash & (kSsmmCells - 1u); }

// The cell that a block's pixel asks and teaches in this frame: one of eight about it at random, so that no border
// shows; walls' two sides have different ones. False where it sees no surface.
bool world_cell(uvec2 block, out GridKey cell) {
  uvec2 pixel = light_pixel(block);
  cell = GridKey(0u, 0u);
  if (pixel.x >= frame.width || pixel.y >= frame.height) return false;
  uint at = pixel.y * frame.width + pixel.x;
  vec4 position = uintBitsToFloat(gbuffer_quad(at, 0u));
  if (position.w == 0.0) return false;
  uint rng = rng_seed(at, frame.frame, 0xc2b2ae35u, frame.seed);
  float x = rng_uniform(rng), y = rng_uniform(rng), z = rng_uniform(rng);
  uint face = cube_face(unpack_direction(gbuffer_quad(at, 3u).x));
  cell = grid_vertex(position.xyz, ssmm.ssmm_cell, face, vec3(x, y, z));
  return true;
}

// The order of this frame's claims.
uint claim_order() { return rng_seed(0u, frame.frame, 0x165667b1u, frame.seed); }

// A pixel would teach the cell in this frame. The first to say so lists it for passes/keep.comp, with a workgroup where
// the last is full.
void claim_cell(GridKey cell, uint claim) {
  uint slot = slot_of(cell);
  if (claim == 0u) return;
  if (atomicMax(world_claims.at[slot], claim) == 0u) {
    uint place = atomicAdd(world_claimed.at[3], 1u);
    world_claimed.at[kSsmmClaimedWords + place] = slot;
    if (place % kSsmmKeepGroup == 0u) atomicAdd(world_claimed.at[0], 1u);
  }
}

ChainState state_of_cell(GridKey cell) {
  uint at = 2u * slot_of(cell);
  uvec4 b = world_states.at[at + 1u];
  if (b.w != cell.check) return no_chain_state();
  return unpack_chain_state(world_states.at[at], b);
}
void store_cell(GridKey cell, ChainState s) {
  uint at = slot_of(cell);
  FB_STORE_CHAIN(world_states, at, s)
  world_states.at[2u * at + 1u].w = cell.check;
}
#endif
