// Step `direct` of a technique that leaves light to be met by chance.
#include "lib/path_state.glsl"

const bool kLooksForLight = false;

const float kLooks = 0.0;
Aim aim_at_light(Vertex v, Guidance g, bool one, inout uint rng) { return kNoAim; }
bool found(Aim aim, Hit hit, inout uint rng) { return false; }
Direct direct_light(Vertex v, Aim aim, vec3 emission) { return Direct(vec3(0.0), vec3(0.0)); }
Direct look_for_light(Vertex v, Aim aim, inout uint rng) { return Direct(vec3(0.0), vec3(0.0)); }
float met_share(Vertex v, Hit hit, Proposal p, vec3 emission, bool one) { return 1.0; }
