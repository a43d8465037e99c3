// Technique `mir`: guided by distributions of directions that the host learns between iterations from the paths that
// are stored here (Müller 2017), and weighs all of them anew for the picture (Fan 2025). A frame alone is unbiased for
// paths of at most frame.bounces reflections.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "estimators/mir/steps/begin.glsl"
#include "lib/steps/no_field.glsl"
#include "estimators/mir/steps/propose.glsl"
#include "lib/steps/no_direct.glsl"
#include "lib/steps/no_control.glsl"
#include "lib/steps/no_learning.glsl"
#include "estimators/mir/steps/record.glsl"
#include "lib/steps/no_views.glsl"

#include "lib/paths_main.glsl"
