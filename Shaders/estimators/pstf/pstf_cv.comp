// Technique `pstf_cv`: as `pt`, and what a field of light in the world knows of incident light is a control variate
// (Pantaleoni 2020, Section 4.2). Unbiased for paths of at most frame.bounces reflections, whatever the field holds.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kEndsInField = false, kPredicts = false;
#include "estimators/pstf/steps/control.glsl"
#include "lib/steps/no_direct.glsl"
#include "estimators/pstf/steps/learn.glsl"
#include "estimators/pstf/steps/views.glsl"

#include "lib/paths_main.glsl"
