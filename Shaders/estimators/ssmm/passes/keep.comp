// Last stage of r_ssmm_world: a cell of the world keeps what the chain of the pixel that claimed it ended with.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimators/ssmm/steps/world.glsl"

void main() {
  uvec2 at = invocation_pixel();
  uint slot = at.y * 256u + at.x, claim = world_claims.at[slot];
  if (claim == 0u) return;
  world_claims.at[slot] = 0u;
  uint element = claiming_element(claim);
  GridKey cell;
  if (!world_cell(uvec2(element % frame.light_width, element / frame.light_width), cell)) return;
  uint rng = rng_seed(slot, frame.frame, 0x27d4eb2fu, frame.seed);
  store_cell(cell, kept_in_world(state_of_cell(cell), FB_LOAD_CHAIN(chain_states, element), rng_uniform(rng)));
}
