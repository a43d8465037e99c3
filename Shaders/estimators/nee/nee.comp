// Estimator `nee`: next-event estimation. Every vertex samples the list of lights, the suns and the BSDF, combined by the
// balance heuristic. Unbiased for paths of at most frame.bounces reflections; learns nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#define ESTIMATOR_LEARNS 0
#define ESTIMATOR_SAMPLES_LIGHTS
#include "lib/paths_main.glsl"
