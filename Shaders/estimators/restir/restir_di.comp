// Technique `restir_di`: as `nee`, but that the light that a pixel's first vertex looks for is chosen by a reservoir,
// from new candidates, the former frame and neighbours (passes/). Unbiased for paths of at most frame.bounces
// reflections where r_restir_mis and r_restir_visibility are 0.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kReusesIndirect = false;
#include "estimators/restir/steps/all.glsl"
#include "estimators/restir/steps/views.glsl"

#include "lib/paths_main.glsl"
