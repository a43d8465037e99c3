// Technique `mcpg`: Markov chain path guiding (Alber 2025). Unbiased for paths of at most frame.bounces reflections:
// what it learnt only shapes the density that it samples from.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kEndsInField = false;
#include "estimators/mcpg/steps/all.glsl"
#include "lib/steps/no_direct.glsl"
#include "lib/steps/no_control.glsl"
#include "lib/steps/no_record.glsl"
#include "estimators/mcpg/steps/views.glsl"

#include "lib/paths_main.glsl"
