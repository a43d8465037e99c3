// Technique `restir_gi`: as `restir_di`, and what falls straight on a path's second vertex is a sample for a reservoir
// of its own, which passes resample over time and neighbours and whose light they add to the picture (Ouyang 2021; Lin
// 2022).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kReusesIndirect = true;
#include "estimators/restir/steps/all.glsl"
#include "estimators/restir/steps/views.glsl"

#include "lib/paths_main.glsl"
