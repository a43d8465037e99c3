// Which probes have a turn in this frame: first how urgent each is, where the volume has moved on to another cell as
// one of which nothing is known; then the rank of each among all.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "estimators/ddgi/steps/probes.glsl"
#include "shared/scene_gpu.h"

layout(constant_id = kSpecDdgiRanks) const bool RANKS = false;
layout(local_size_x = 64) in;

const uint kInSight = 8u;  // frames since a path asked
const uint kNew = 1u << 28u, kNewInSight = 1u << 29u;

uint urgency_of(uint probe) {
  ivec3 cell = cell_of_probe(probe);
  uint key = ddgi_cell_key(cell.x, cell.y, cell.z);
  if (ddgi_probes.at[2u * probe].w != key) {
    ddgi_probes.at[2u * probe] =
        uvec4(ddgi.stands != 0u ? texelFetch(ddgi_table_texels, int(probe)).xyz : uvec3(0u), key);
    ddgi_probes.at[2u * probe + 1u] = uvec4(0u);
  }
  if (stands_nowhere(probe)) return 0u;
  uvec4 record = ddgi_probes.at[2u * probe + 1u];
  bool in_sight = record.z != 0u && ddgi.frame_number - record.z <= kInSight;
  if ((record.x & kDdgiUpdates) == 0u) return (in_sight ? kNewInSight : kNew) + ddgi.frame_number - record.y;
  uint often = (record.x & kDdgiAsleep) != 0u ? (in_sight ? 4u : 1u) : in_sight ? 16u : 4u;
  return min(ddgi.frame_number - record.y, 0xffffffu) * often;
}

void main() {
  uint probe = gl_GlobalInvocationID.x;
  if (probe >= ddgi.probes) return;
  if (!RANKS) {
    ddgi_turns.at[ddgi.probes + probe] = urgency_of(probe);
    return;
  }
  uint mine = ddgi_turns.at[ddgi.probes + probe], rank = 0u, i = 0u;
  do {
    uint other = ddgi_turns.at[ddgi.probes + i];
    rank += other > mine || (other == mine && i < probe) ? 1u : 0u;
  } while (++i < ddgi.probes);
  if (rank < ddgi.turns) ddgi_turns.at[rank] = probe;
}
