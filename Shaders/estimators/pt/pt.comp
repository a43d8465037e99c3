// Technique `pt`: BSDF sampling only, naive on purpose; the reference for every other technique. Unbiased for paths of
// at most frame.bounces reflections (emission that is met counts, nothing is looked for, nothing is clamped).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/steps/none.glsl"
#include "lib/paths_main.glsl"
