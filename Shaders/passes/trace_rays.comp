// Traces a list of rays: for tests and the traversal benchmark. Of the hits that must ask, those on triangles whose
// first vertex is even count.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/trace.glsl"
#include "shared/ray_list.h"

layout(local_size_x = 64) in;
FB_FRAME_ARRAY(kBindRays, 16, readonly, RayArray, ListRay, rays)
FB_FRAME_ARRAY(kBindHits, 16, writeonly, HitArray, ListHit, hits)
layout(push_constant) uniform Constants { uint ray_count; };

bool accept_candidate(Hit candidate, inout uint rng) {
  return (attribute_at(instance_at(candidate.instance).first_attribute + candidate.triangle).vertex0 & 1u) == 0u;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= ray_count) return;
  ListRay ray = rays.at[i];
  uint rng = i;
  Hit hit = trace(ray.origin, ray.direction, ray.t_min, ray.t_max, ray.mask, rng);
  ListHit result = ListHit(hit.t, hit.bary.x, hit.bary.y, hit.instance, 0u, 0u, 0u, 0u);
  if (hit.instance != kNoIndex) {
    result.id = instance_at(hit.instance).id;
    result.vertex0 = attribute_at(instance_at(hit.instance).first_attribute + hit.triangle).vertex0;
    result.triangle = hit.triangle;
  }
  hits.at[i] = result;
}
