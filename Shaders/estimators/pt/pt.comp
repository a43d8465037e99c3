// Estimator `pt`: BSDF sampling only, naive on purpose; the reference for every other estimator. Unbiased for paths of
// at most frame.bounces reflections (emission that is met counts, nothing is looked for, nothing is clamped).
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#define ESTIMATOR_LEARNS 0
#define ESTIMATOR_SAMPLES_LIGHTS 0
#include "lib/path_vertex.glsl"

vec3 sample_direction(PathVertex v, bool first, bool last, inout uint rng, out vec3 direction) {
  return sample_vertex_bsdf(v, rng, direction);
}

#include "lib/paths_main.glsl"
