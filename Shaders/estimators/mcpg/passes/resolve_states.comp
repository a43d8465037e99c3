// Writes the states that this frame's paths proposed: of all proposals for a slot, the one of highest rank.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimators/mcpg/steps/cache.glsl"

layout(local_size_x = 64) in;

void main() {
  uint proposal = gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * 64u) + gl_GlobalInvocationID.x;
  if (proposal >= guide.vertices) return;
  uvec4 rest = guide_proposals.at[proposal * 2u + 1u];
  uint at = rest.z, winner = guide_winner_at() + at;
  if (guide_cache.at[winner] != proposal_rank(proposal, rest.w != 0u)) return;
  guide_states.at[at] = guide_proposals.at[proposal * 2u];
  store_guide_motion(at, rest.xy);
  guide_cache.at[winner] = 0u;
}
