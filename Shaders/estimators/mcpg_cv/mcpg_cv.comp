// Technique `mcpg_cv`: as `mcpg`, and what a field of light in the world knows of incident light is a control variate
// (Pantaleoni 2020, Section 4.2) of what the directions bring. Unbiased for paths of at most frame.bounces reflections,
// whatever either holds.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kEndsInField = false;
#include "estimators/mcpg_cv/steps/begin.glsl"
#include "estimators/mcpg_cv/steps/propose.glsl"
#include "estimators/mcpg_cv/steps/learn.glsl"
#include "lib/steps/no_direct.glsl"
#include "lib/steps/no_record.glsl"
#include "estimators/mcpg/steps/views.glsl"

#include "lib/paths_main.glsl"
