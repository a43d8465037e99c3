// Technique `mir_nee`: as `mir`, and every vertex looks for a light, as in `nee` without a memory. A frame alone is
// unbiased for paths of at most frame.bounces reflections.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "estimators/mir/steps/begin.glsl"
#include "lib/steps/no_field.glsl"
#include "estimators/mir/steps/propose.glsl"
#include "estimators/mir/steps/direct.glsl"
#include "lib/steps/no_control.glsl"
#include "lib/steps/no_learning.glsl"
#include "estimators/mir/steps/record.glsl"
#include "lib/steps/no_views.glsl"

#include "lib/paths_main.glsl"
