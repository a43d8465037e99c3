// Technique `pstf_is`: as `pt`, and directions are drawn from trees that cells in the world hold, too (Pantaleoni 2020,
// Section 4.1). Unbiased for paths of at most frame.bounces reflections, whatever the trees hold.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kEndsInField = false, kPredicts = false;
const bool kMixtureControl = false;
#include "estimators/pstf/steps/guide.glsl"
#include "lib/steps/no_direct.glsl"
#include "estimators/pstf/steps/learn.glsl"
#include "estimators/pstf/steps/views.glsl"

#include "lib/paths_main.glsl"
