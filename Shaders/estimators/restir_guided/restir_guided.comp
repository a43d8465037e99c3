// Technique `restir_guided`: as `restir_gi`, with paths that are guided as those of `mcpg_nee` are, whose samples
// reservoirs take up.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kEndsInField = false;
const bool kReusesIndirect = true;
#include "estimators/restir_guided/steps/begin.glsl"
#include "estimators/mcpg/steps/field.glsl"
#include "estimators/mcpg/steps/propose.glsl"
#include "estimators/restir_guided/steps/learn.glsl"
#include "estimators/restir/steps/direct.glsl"
#include "lib/steps/no_control.glsl"
#include "lib/steps/no_record.glsl"
#include "estimators/restir/steps/views.glsl"

#include "lib/paths_main.glsl"
