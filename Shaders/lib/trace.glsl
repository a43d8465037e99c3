// Closest hit of a ray with the scene: one contract, two intersectors. INTERSECTOR_QUERY 1: VK_KHR_ray_query; 0: our
// own trees, traversed in the shader. Inline one call of trace() in a loop: each call is a copy of the whole traversal.
#ifndef FB_LIB_TRACE
#define FB_LIB_TRACE
#include "lib/scene_records.glsl"

// False: every surface stops every ray, nothing is asked.
layout(constant_id = kSpecCandidates) const bool FEATURE_CANDIDATES = true;

layout(constant_id = kSpecGpuLanes) const bool GPU_LANES = false;

struct Hit {
  float t;        // along the direction as it was given, in the world
  vec2 bary;      // weights of vertices 1 and 2
  uint instance;  // kNoIndex: nothing was hit
  uint triangle;  // of the instance's: index into its triangles and attributes
};

// Whether a hit counts that an alpha-tested triangle or a translucent instance offers. The includer defines it.
bool accept_candidate(Hit candidate, inout uint rng);

// Hit trace(vec3 origin, vec3 direction, float t_min, float t_max, uint mask, inout uint rng):
// the closest hit in (t_min, t_max) among instances that are visible to `mask` (scene::Visibility); both sides count.
// `direction` need not be a unit vector; components may be zero.
#if INTERSECTOR_QUERY
#include "lib/trace_query.glsl"
#else
#include "lib/trace_bvh.glsl"
#endif
#endif
