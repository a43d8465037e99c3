// What shadow rays reached in past frames, in three memories: how often suns and listed lights were met, by cell of a
// hash grid; which lamps, by cell; and how often rays arrived between two places. Next-event estimation chooses one
// light of a few by what each would bring, and light that is behind walls brings nothing: what past rays met is the
// factor on it (the idea of learnt visibility: Vevoda 2018). Any positive factor leaves the estimate right.
#ifndef FB_SHARED_SEEN_GRID_H
#define FB_SHARED_SEEN_GRID_H
#include "shared/bindings.h"
#include "shared/hash_grid.h"
FB_NAMESPACE_BEGIN

// kBindSeen: uvec4[kSeenCells]: x, y: fold_seen of suns and of the list; z, w: this frame's rays, kSeenRay each,
// kSeenMet more for those that arrived. Then uvec4[kSeenCells][2]: lamps that rays found, SeenLamps; then
// uint[kSeenCells]: one that a ray found in this frame, lamp_found. Then two tables of kSeenWays, below.
FB_CONST uint kSeenCells = 32768u;
FB_CONST float kSeenWidth = 64.0f;  // of a cell, units
FB_CONST uint kSeenMet = 1u, kSeenRay = 65536u;
FB_CONST uint kSeenLampQuads = kSeenCells, kSeenFoundWords = 12u * kSeenCells;  // where they begin
FB_CONST uint kSeenWays = 131072u, kSeenWaysWords = 13u * kSeenCells;
FB_CONST uint kSeenBytes = 52u * kSeenCells + 16u * kSeenWays;
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

// A cell remembers lamps that its rays found, one a frame of all that found one, chosen in proportion to the light that
// they brought (Efraimidis and Spirakis 2006): as much as a lamp brings, so often it is there. Lamps have names: their
// number + 1, in 16 bits.
FB_CONST uint kSeenLamps = 16u;
struct SeenLamps {
  uvec4 a, b;  // two names a word, the lower half first; names from the front on, zeros behind them
};

// How many of them have a name; 0 asks for those that are still empty.
FB_FN uint times_seen(SeenLamps s, uint name) {
  uvec4 low_a = s.a & uvec4(0xffffu), high_a = s.a >> uvec4(16u), low_b = s.b & uvec4(0xffffu),
        high_b = s.b >> uvec4(16u);
  uvec4 times = uvec4(equal(low_a, uvec4(name))) + uvec4(equal(high_a, uvec4(name))) +
                uvec4(equal(low_b, uvec4(name))) + uvec4(equal(high_b, uvec4(name)));
  return times.x + times.y + times.z + times.w;
}

FB_FN uint seen_name(SeenLamps s, uint place) {
  uint i = (place >> 1u) & 3u;
  uint word = place < 8u ? s.a[i] : s.b[i];
  return (place & 1u) != 0u ? word >> 16u : word & 0xffffu;
}

// One of a frame's rays that found a lamp, from the sum of the light that it brought (above zero) and a random number
// in (0, 1): the greatest is kept. Not zero.
FB_FN uint lamp_found(uint name, float light, float random) {
  uint race = floatBitsToUint(-log(random) / light) >> 16u;  // the bits of positive numbers are in their order
  return (0xffffu - min(race, 0xffffu)) << 16u | name;
}

// Whether rays from one cube of kWayWidth to points of lights in another arrived: visibility between two places,
// whatever shines there. An entry has two words, the rays and those that arrived; ways that share one share what they
// know. One table is read, of an epoch of frames that is over; this frame's rays are counted in the other, so that
// frames do not depend on the order of threads.
FB_CONST float kWayWidth = 128.0f;
FB_FN uint seen_place(vec3 p, uint from) {
  return grid_key(int(floor(p.x / kWayWidth)), int(floor(p.y / kWayWidth)), int(floor(p.z / kWayWidth)), from).hash;
}
FB_FN uint seen_way(uint from, vec3 point) { return seen_place(point, from) % kSeenWays; }

// The factor on what a candidate would bring, `hoped` where nothing is known: the root of the share of rays that
// arrived. Of lights that arrive with chance p and bring v then, one is chosen best in proportion to the root of the
// mean of squares, v sqrt(p).
FB_CONST float kLeastSeen = 0.05f, kHopeWeighs = 0.25f;  // as so many rays
FB_FN float seen_hope(uvec2 rays_met, float hoped) {
  float share = (float(rays_met.y) + kHopeWeighs * hoped * hoped) / (float(rays_met.x) + kHopeWeighs);
  return max(sqrt(share), kLeastSeen);
}

FB_NAMESPACE_END
#endif
