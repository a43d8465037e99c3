// Step `views` of a technique without debug views of its own.
#include "lib/path_state.glsl"

vec3 view_color(Vertex v, Path path, uint rng) { return vec3(0.0); }
