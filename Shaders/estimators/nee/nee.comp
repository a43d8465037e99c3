// Estimator `nee`: next-event estimation. Every vertex looks for a light of the list and for a sun, and goes on by the BSDF;
// the three share what they may both find. Unbiased for paths of at most frame.bounces reflections; learns nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#define ESTIMATOR_LEARNS 0
#define ESTIMATOR_SAMPLES_LIGHTS 1
#include "lib/path_vertex.glsl"

vec3 sample_direction(PathVertex v, bool first, bool last, inout uint rng, out vec3 direction) {
  return sample_vertex_bsdf(v, rng, direction);
}

#include "lib/paths_main.glsl"
