// Technique `ssmm`: the first vertices of pixels sample a mixture of lobes that the pixels of a tile hold (Dittebrandt
// 2023), one for each, which Markov chains move to where light is. Unbiased for paths of at most frame.bounces
// reflections.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "estimators/ssmm/steps/begin.glsl"
#include "lib/steps/no_field.glsl"
#include "estimators/ssmm/steps/propose.glsl"
#include "lib/steps/no_direct.glsl"
#include "lib/steps/no_control.glsl"
#include "lib/steps/no_learning.glsl"
#include "estimators/ssmm/steps/record.glsl"
#include "estimators/ssmm/steps/views.glsl"

#include "lib/paths_main.glsl"
