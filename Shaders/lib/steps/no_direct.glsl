// Step `direct` of a technique that leaves light to be met by chance.
#include "lib/path_state.glsl"

const bool kLooksForLight = false;

Direct look_for_light(Vertex v, inout Guidance g, inout Path path, inout uint rng) {
  return Direct(vec3(0.0), vec3(0.0));
}
Direct last_light(Vertex v, inout Path path, inout uint rng) { return Direct(vec3(0.0), vec3(0.0)); }
bool point_of_light(inout uint rng, out vec3 place) {
  place = vec3(0.0);
  return false;
}
float met_share(Vertex v, Segment way, Proposal p, vec3 emission, inout Path path) { return 1.0; }
