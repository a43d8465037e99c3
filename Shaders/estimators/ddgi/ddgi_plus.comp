// Technique `ddgi_plus`: paths end at their second vertex in what probes know of all the light that falls on it
// (Majercik 2022, Eq. 5 to 8). Where they know nothing it is `nee`. Biased as `ddgi` is, less where it shows.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kPlus = true;
#include "estimators/ddgi/steps/proposal.glsl"
#include "lib/steps/no_learning.glsl"
#include "lib/steps/no_record.glsl"
#include "estimators/ddgi/steps/views.glsl"

#include "lib/paths_main.glsl"
