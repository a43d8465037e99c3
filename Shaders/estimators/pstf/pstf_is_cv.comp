// Technique `pstf_is_cv`: as `pstf_is`, with the difference of the two densities as a control variate (Pantaleoni 2020,
// Eq. 27).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kEndsInField = false, kPredicts = false;
const bool kMixtureControl = true;
#include "estimators/pstf/steps/guide.glsl"
#include "lib/steps/no_direct.glsl"
#include "estimators/pstf/steps/learn.glsl"
#include "estimators/pstf/steps/views.glsl"

#include "lib/paths_main.glsl"
