// Step `views` of a technique without debug views of its own.
#include "lib/path_state.glsl"

bool shows_directions() { return false; }
bool measures_moments() { return false; }
vec3 view_color(Vertex v, Path path, uint rng) { return vec3(0.0); }
vec3 view_of_directions(uvec2 block, uint number, uvec2 pixel) { return vec3(0.0); }
vec3 view_of_moments(Vertex v, Path path, uint rng) { return vec3(0.0); }
