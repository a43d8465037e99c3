// Technique `ddgi`: light that falls straight on the first vertex is looked for as in `nee`, what is reflected to it is
// what probes know (Majercik 2019 and 2021; Majercik 2022, Eq. 2). Where they know nothing it is `nee`. Biased: by the
// probes' spacing, lag and leaks, and of any number of reflections.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kPlus = false;
#include "estimators/ddgi/steps/proposal.glsl"
#include "lib/steps/no_learning.glsl"
#include "lib/steps/no_record.glsl"
#include "estimators/ddgi/steps/views.glsl"

#include "lib/paths_main.glsl"
