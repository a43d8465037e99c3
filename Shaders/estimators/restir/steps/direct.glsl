// Step `direct`: as direct_list, but that the light that a pixel's first vertex looks for is its reservoir's.
#ifndef FB_RESTIR_DIRECT
#define FB_RESTIR_DIRECT
#include "estimators/restir/steps/arrays.glsl"

const bool kLooksForLight = true;

// How a first path looks for what the reservoir holds: for all paths of the pixel.
Aim reservoir_aim(Vertex v, LightReservoir r) {
  Aim aim;
  Domain d = domain_of(v, false);
  LightPoint p = point_of(r.chosen);
  light_target(d, p, aim);
  aim.cell = cell_of(v);
  if (!p.sun) aim.way = seen_way(seen_place(d.origin, 0u), p.place);
  aim.weight *= r.weight * float(frame.spp);
  return aim;
}

Direct look_for_light(Vertex v, inout Guidance g, inout Path path, inout uint rng) {
  path.own.reuses = false;
  Aim aim = kNoAim;
  if (!IN_MEDIUM && path.depth == 0u) {
    LightReservoir r = unpack_light(final_reservoirs.at[lit_index(path.pixel)]);
    path.own.reuses = reuses(r);
    if (path.own.reuses && path.own.asks) aim = reservoir_aim(v, r);
  }
  if (!path.own.reuses) aim = aim_at_light(v, kBoth, rng);
  return light_of_aim(v, aim, proposal_pdf(v, g, aim.direction, aim.bsdf_pdf), rng);
}

float met_share(Vertex v, Segment way, Proposal p, vec3 emission, inout Path path) {
  if (!path.own.reuses || path.depth > 0u) return met_share_of(v, way, p, emission, kBoth);
  if (emission == vec3(0.0) || (p.flags & kScatterDelta) != 0u) return 1.0;
  float all = plain_density(v, p.direction, way) + p.pdf;
  return all > 0.0 ? p.pdf / all : 1.0;
}

Direct last_light(Vertex v, inout Path path, inout uint rng) { return light_in_turns(v, rng); }
#endif
