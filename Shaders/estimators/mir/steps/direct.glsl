// Step `direct` of `mir_nee`: lights of the list and suns, as lib/steps/direct_list.glsl looks for them, but without a
// memory: candidates are drawn by the list's own probabilities, and no ray teaches which of them to choose. So the
// density of looking is the same in all iterations, and a function of the vertex and the direction; each length of a
// path can end by what is met or by what is looked for, and both densities are kept (Fan 2025, Section 5).
#ifndef FB_MIR_DIRECT
#define FB_MIR_DIRECT
#include "estimators/mir/steps/begin.glsl"
uint light_candidates() { return uint(mir.nee_candidates); }
uint remembered_candidates() { return 0u; }
bool knows_ways() { return false; }
uint known_ways() { return 0u; }
uint light_seen_stride() { return 0x80000000u; }  // nothing folds what is counted: it is never read
#include "lib/look_for_light.glsl"

const bool kLooksForLight = true;

Direct look_for_light(Vertex v, inout Guidance g, inout Path path, inout uint rng) {
  Aim aim = aim_at_light(v, kBoth, rng);
  FoundLight found = find_by_aim(v, aim, proposal_pdf(v, g, aim.direction, aim.bsdf_pdf), rng);
  path.own.looked = aim.direction;
  path.own.looked_pdf = aim.bsdf_pdf;
  // Of the path's own directions as many take a mirrored sun's way as the liquid mirrors.
  path.own.look_density = aim.turn == kTurnBack ? aim.density / max(found.way.mirrored, 1e-20) : aim.density;
  return found.direct;
}

float met_share(Vertex v, Segment way, Proposal p, vec3 emission, inout Path path) {
  bool shared_light = emission != vec3(0.0) && (p.flags & kScatterDelta) == 0u;
  path.own.met_density = shared_light ? looked_for_density(v, p.direction, way) : 0.0;
  float all = path.own.met_density + p.pdf;
  return shared_light && all > 0.0 ? p.pdf / all : 1.0;
}

Direct last_light(Vertex v, inout Path path, inout uint rng) { return light_in_turns(v, rng); }
#endif
