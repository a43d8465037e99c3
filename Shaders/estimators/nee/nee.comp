// Technique `nee`: next-event estimation. Every vertex looks for one light, of the list or a sun, and goes on by the
// BSDF; the last vertex does one or the other. Unbiased for paths of at most frame.bounces reflections. It remembers
// what shadow rays reach.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "estimators/nee/nee.h"
#include "lib/steps/one_path.glsl"
#include "lib/steps/no_field.glsl"
#include "lib/steps/propose_scatter.glsl"
#include "lib/steps/direct_list.glsl"
layout(set = kSetScene, binding = kBindTechniqueConstants, std140) uniform NeeBlock { NeeConstants nee; };
uint light_candidates() { return uint(nee.nee_candidates); }
uint remembered_candidates() { return uint(nee.nee_remembered); }
uint light_seen_stride() { return nee.seen_stride; }
bool knows_ways() { return nee.nee_visibility != 0; }
uint known_ways() { return nee.seen_ways; }
#include "lib/steps/no_control.glsl"
#include "lib/steps/no_learning.glsl"
#include "lib/steps/no_record.glsl"
#include "lib/steps/no_views.glsl"

#include "lib/paths_main.glsl"
