// Technique `ssmm_nee`: as `ssmm`, and every vertex looks for a light, as in `nee`. Unbiased as `ssmm` is.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "estimators/ssmm/steps/begin.glsl"
#include "lib/steps/no_field.glsl"
#include "estimators/ssmm/steps/propose.glsl"
#include "lib/steps/direct_list.glsl"
uint light_candidates() { return uint(ssmm.nee_candidates); }
uint remembered_candidates() { return uint(ssmm.nee_remembered); }
uint light_seen_stride() { return ssmm.seen_stride; }
bool knows_ways() { return ssmm.nee_visibility != 0; }
uint known_ways() { return ssmm.seen_ways; }
#include "lib/steps/no_control.glsl"
#include "lib/steps/no_learning.glsl"
#include "estimators/ssmm/steps/record.glsl"
#include "estimators/ssmm/steps/views.glsl"

#include "lib/paths_main.glsl"
