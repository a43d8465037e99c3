// Technique `pstf_is_nee`: as `pstf_is`, and every vertex looks for a light, as in `nee`; trees are of what this
// leaves.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kEndsInField = false, kPredicts = false;
const bool kMixtureControl = false;
#include "estimators/pstf/steps/guide.glsl"
#include "lib/steps/direct_list.glsl"
uint light_candidates() { return uint(pstf.nee_candidates); }
uint remembered_candidates() { return uint(pstf.nee_remembered); }
uint light_seen_stride() { return pstf.seen_stride; }
bool knows_ways() { return pstf.nee_visibility != 0; }
uint known_ways() { return pstf.seen_ways; }
#include "estimators/pstf/steps/learn.glsl"
#include "estimators/pstf/steps/views.glsl"

#include "lib/paths_main.glsl"
