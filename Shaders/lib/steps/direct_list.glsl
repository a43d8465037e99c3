// Step `direct` by a list of lights and suns (lib/look_for_light.glsl), which every vertex looks for.
#ifndef FB_LIB_STEPS_DIRECT_LIST
#define FB_LIB_STEPS_DIRECT_LIST
#include "lib/look_for_light.glsl"

const bool kLooksForLight = true;

Direct look_for_light(Vertex v, inout Guidance g, inout Path path, inout uint rng) {
  Aim aim = aim_at_light(v, kBoth, rng);
  return light_of_aim(v, aim, proposal_pdf(v, g, aim.direction, aim.bsdf_pdf), rng);
}

float met_share(Vertex v, Segment way, Proposal p, vec3 emission, inout Path path) {
  return met_share_of(v, way, p, emission, kBoth);
}

Direct last_light(Vertex v, inout Path path, inout uint rng) { return light_in_turns(v, rng); }
#endif
