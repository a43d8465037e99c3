// Step `control` of a technique without a control variate.
#include "lib/path_state.glsl"

const bool kHasControl = false;

vec3 control_mean(Vertex v, Guidance g, Field here) { return vec3(0.0); }
vec3 control_at(Vertex v, Guidance g, Field here, vec3 direction) { return vec3(0.0); }
