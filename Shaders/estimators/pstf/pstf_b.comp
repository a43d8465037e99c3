// Technique `pstf_b`: as `pstf_cv`, but of the light of one vertex of a path, its first or second, the field says all
// but a part gamma (Pantaleoni 2020, Section 5). Biased: light of any number of reflections, averaged over cells, some
// frames late.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "estimators/pstf/pstf.h"
layout(constant_id = kSpecEndsInField) const bool kEndsInField = false;  // at second vertices
const bool kPredicts = true;                                             // at first ones, else
#include "estimators/pstf/steps/control.glsl"
#include "lib/steps/no_direct.glsl"
#include "estimators/pstf/steps/learn.glsl"
#include "estimators/pstf/steps/views.glsl"

#include "lib/paths_main.glsl"
