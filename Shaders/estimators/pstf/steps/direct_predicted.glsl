// Step `direct` as lib/steps/direct_list.glsl, at vertices of whose light a part may be predicted: that is looked-for
// light's part, too.
#ifndef FB_PSTF_DIRECT_PREDICTED
#define FB_PSTF_DIRECT_PREDICTED
#include "lib/look_for_light.glsl"

const bool kLooksForLight = true;

Direct look_for_light(Vertex v, inout Guidance g, inout Path path, inout uint rng) {
  Aim aim = aim_at_light(v, kBoth, rng);
  Direct direct = light_of_aim(v, aim, proposal_pdf(v, g, aim.direction, aim.bsdf_pdf), rng);
  g.prediction.found = direct.radiance;
  direct.radiance *= g.prediction.direct_scale;
  return direct;
}
float met_share(Vertex v, Segment way, Proposal p, vec3 emission, inout Path path) {
  return met_share_of(v, way, p, emission, kBoth);
}
Direct last_light(Vertex v, inout Path path, inout uint rng) { return light_in_turns(v, rng); }
#endif
