// The path loop that every estimator shares. An estimator is a policy: it defines
//   vec3 sample_direction(PathVertex v, inout uint rng, out vec3 direction);
// before including this file, which returns f cos / pdf (zero ends the path), and may train itself in
//   void path_hit(PathVertex v, vec3 direction, vec3 emission);
// All transport is here: emission met on the way, at most frame.bounces + 0 further vertices.
#ifndef FB_LIB_PATH
#define FB_LIB_PATH
#include "lib/path_vertex.glsl"

// Radiance that reaches the first vertex's viewer by reflection: paths of 1 to frame.bounces further vertices.
vec3 trace_path(PathVertex v, inout uint rng) {
  vec3 sum = vec3(0.0), throughput = vec3(1.0);
  for (uint bounce = 0u; bounce < frame.bounces; ++bounce) {
    vec3 direction;
    vec3 weight = sample_direction(v, rng, direction);
    if (weight == vec3(0.0)) break;
    throughput *= weight;
    Hit hit = trace(offset_origin(v.position, v.normal), direction, 0.0, kRayEnd, kMaskIndirect, rng);
    bool missed = hit.instance == kNoIndex;
    if (missed && frame.sky_beyond == 0u) break;
    bool last = bounce + 1u == frame.bounces;
    Surface s = load_surface(hit, direction, false, last);
    sum += throughput * s.emission;
    if (missed || last) break;
    v = make_path_vertex(s, -direction);
  }
  return sum;
}
#endif
