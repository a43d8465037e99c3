// Technique `nee`: next-event estimation. Every vertex looks for a light of the list and for a sun, and goes on by the BSDF;
// the three share what they may both find. Unbiased for paths of at most frame.bounces reflections; learns nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/steps/one_path.glsl"
#include "lib/steps/no_field.glsl"
#include "lib/steps/propose_scatter.glsl"
#include "lib/steps/direct_list.glsl"
layout(set = kSetTechnique, binding = kBindTechniqueConstants, std140) uniform NeeBlock { NeeConstants nee; };
uint light_candidates() { return uint(nee.nee_candidates); }
#include "lib/steps/no_learning.glsl"
#include "lib/steps/no_views.glsl"

#include "lib/paths_main.glsl"
