// Step `direct` of a technique that leaves light to be met by chance.
#include "lib/path_state.glsl"

const uint kDirectRays = 0u;

Aim aim_for_light(Vertex v, vec3 origin, uint ray, inout uint rng) {
  return Aim(vec3(0.0), vec3(0.0), 0.0, 0.0, kNoIndex, kNoIndex, 0.0);
}
bool light_is_met(inout Aim aim, Hit hit, uint ray) { return false; }
float met_share(Vertex v, Hit hit, vec3 direction, vec3 emission) { return 1.0; }
