// Technique `mcpg_tail`: as `mcpg`, but paths end in the irradiance cache after one reflection, where it knows enough.
// Biased: a Lambertian tail of any number of reflections, averaged over cells, some frames late.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kEndsInField = true;
#include "estimators/mcpg/steps/all.glsl"
#include "lib/steps/no_direct.glsl"
#include "lib/steps/no_control.glsl"
#include "lib/steps/no_record.glsl"
#include "estimators/mcpg/steps/views.glsl"

#include "lib/paths_main.glsl"
