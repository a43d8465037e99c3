// Technique `mcpg_nee_tail`: as `mcpg_nee` at the first vertex; what its ray meets ends the path in the irradiance
// cache, which looked-for light trains, where it knows enough. Biased as `mcpg_tail` is.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kEndsInField = true;
#include "estimators/mcpg/steps/all.glsl"
#include "lib/steps/direct_list.glsl"
uint light_candidates() { return uint(guide.nee_candidates); }
uint remembered_candidates() { return uint(guide.nee_remembered); }
uint light_seen_stride() { return guide.seen_stride; }
bool knows_ways() { return guide.nee_visibility != 0; }
uint known_ways() { return guide.seen_ways; }
#include "lib/steps/no_control.glsl"
#include "lib/steps/no_record.glsl"
#include "estimators/mcpg/steps/views.glsl"

#include "lib/paths_main.glsl"
