// Last stage of r_ssmm_world: each cell of the world that a pixel claimed keeps what that pixel's chain ended with.
// Which place of the list it has decides nothing, so that frames repeat.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimators/ssmm/steps/world.glsl"

void main() {
  uint place = gl_GlobalInvocationID.x;
  if (place >= world_claimed.at[3]) return;
  uint slot = world_claimed.at[kSsmmClaimedWords + place],
       element = claiming_element(world_claims.at[slot], claim_order());
  world_claims.at[slot] = 0u;
  GridKey cell;
  if (!world_cell(uvec2(element % frame.light_width, element / frame.light_width), cell)) return;
  uint rng = rng_seed(slot, frame.frame, 0x27d4eb2fu, frame.seed);
  store_cell(cell, kept_in_world(state_of_cell(cell), FB_LOAD_CHAIN(chain_states, element), rng_uniform(rng)));
}
