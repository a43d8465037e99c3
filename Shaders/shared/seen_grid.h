// How often shadow rays reach what they look for, by cell of a hash grid and by kind of light. Next-event estimation
// chooses one light of a few by what each would bring, and light that is behind walls brings nothing: what past rays
// met is the factor on it (the idea of learnt visibility: Vevoda 2018). Any positive factor leaves the estimate right.
#ifndef FB_SHARED_SEEN_GRID_H
#define FB_SHARED_SEEN_GRID_H
#include "shared/hash_grid.h"
FB_NAMESPACE_BEGIN

FB_CONST uint kBindSeen = 3u;  // uvec4[kSeenCells] in the technique's set: x, y: fold_seen of suns and of the list;
                               // z, w: this frame's rays, kSeenRay each, kSeenMet more for those that arrived
FB_CONST uint kSeenCells = 32768u;
FB_CONST float kSeenWidth = 64.0f;  // of a cell, units
FB_CONST uint kSeenMet = 1u, kSeenRay = 65536u;
FB_CONST float kSeenMost = 512.0f;  // rays that are remembered

// Cells that share a slot share what they know.
FB_FN uint seen_cell(vec3 position, vec3 normal) {
  vec3 q = vec3(floor(position.x / kSeenWidth), floor(position.y / kSeenWidth), floor(position.z / kSeenWidth));
  return grid_key(int(q.x), int(q.y), int(q.z), cube_face(normal)).hash % kSeenCells;
}

// Share of rays that arrived; 0 where none was sent.
FB_FN float seen_share(uint packed_) {
  vec2 rays_met = unpackHalf2x16(packed_);
  return rays_met.x > 0.0f ? rays_met.y / rays_met.x : 0.0f;
}
// Rays that are remembered.
FB_FN float seen_rays(uint packed_) { return unpackHalf2x16(packed_).x; }
// A frame's rays join those before: two halves, rays and how many of them arrived.
FB_FN uint fold_seen(uint packed_, uint tally) {
  vec2 rays_met = unpackHalf2x16(packed_);
  float rays = rays_met.x + float(tally >> 16u), met = rays_met.y + float(tally & 0xffffu);
  float keep = rays > kSeenMost ? kSeenMost / rays : 1.0f;
  return packHalf2x16(vec2(rays * keep, met * keep));
}

FB_NAMESPACE_END
#endif
