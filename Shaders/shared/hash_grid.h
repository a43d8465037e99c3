// Hash grids over the world: which cell a point belongs to, and where in a table that cell's entry lies (Alber 2025,
// Section 4; the idea of a hashed multi-resolution grid: Müller 2022). Nothing is stored but a check against
// collisions, so any number of cells shares a table of fixed size.
#ifndef FB_SHARED_HASH_GRID_H
#define FB_SHARED_HASH_GRID_H
#include "shared/rng.h"
FB_NAMESPACE_BEGIN

// A cell's hash and its check: computed from different linear forms, so that cells that share a slot differ in it.
struct GridKey {
  uint hash;
  uint check;  // 16 bits, never 0: 0 is an entry that was never written
};

// Which of six faces of a cube a direction points through.
FB_FN uint cube_face(vec3 n) {
  vec3 a = vec3(abs(n.x), abs(n.y), abs(n.z));
  if (a.x >= a.y && a.x >= a.z) return n.x < 0.0f ? 1u : 0u;
  if (a.y >= a.z) return n.y < 0.0f ? 3u : 2u;
  return n.z < 0.0f ? 5u : 4u;
}

// `tag` tells grids, levels and normals apart.
FB_FN GridKey grid_key(int x, int y, int z, uint tag) {
  uint ux = uint(x), uy = uint(y), uz = uint(z);
  GridKey key;
  // Added: joined by exclusive or, cells mirrored at the origin would share a slot (-a ^ -b is a ^ b for odd a and b).
  key.hash = hash_u32(ux * 2654435761u + uy * 805459861u + uz * 3674653429u + tag * 2097192037u);
  key.check = (hash_u32(ux * 1434869437u + uy * 2097592831u + uz * 1610612741u + tag * 402653189u) & 0xffffu) | 1u;
  return key;
}

// The vertex, out of the eight about `p` in a grid of `width`, that uniform numbers u choose: each with its trilinear
// weight.
FB_FN GridKey grid_vertex(vec3 p, float width, uint tag, vec3 u) {
  vec3 q = vec3(p.x / width + u.x, p.y / width + u.y, p.z / width + u.z);
  return grid_key(int(floor(q.x)), int(floor(q.y)), int(floor(q.z)), tag);
}

// Levels of the adaptive grid: cells of level l are 2^l units wide. The level whose cells are seen under `tan_angle`
// from `distance`; between two levels u chooses, so that no border shows.
FB_CONST uint kGridLevels = 16u;
FB_FN uint grid_level(float distance, float tan_angle, float u) {
  float level = log2(max(distance * tan_angle, 1.0f)) + u;
  return uint(min(level, float(kGridLevels - 1u)));
}

// How many levels coarser than that: k with probability (1 - rho) rho^k.
FB_FN uint grid_coarsening(float rho, float u) {
  if (rho <= 0.0f) return 0u;
  return uint(min(floor(log(max(1.0f - u, 1e-7f)) / log(min(rho, 0.99f))), float(kGridLevels)));
}

FB_FN uint adaptive_tag(uint level, vec3 n) { return level * 8u + cube_face(n); }
FB_CONST uint kStaticTag = 1024u;
FB_CONST uint kCacheTag = 2048u;
FB_CONST uint kMediumTag = 4096u;  // of the cache in a medium: another mean than surfaces' there

FB_NAMESPACE_END
#endif
