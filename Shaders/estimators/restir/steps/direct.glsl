// Step `direct`: as direct_list, but that the light that a pixel's first vertex looks for is its reservoir's and, with
// kReusesIndirect, that what is found from its second vertex is handed to the indirect reservoir.
#ifndef FB_RESTIR_DIRECT
#define FB_RESTIR_DIRECT
#include "estimators/restir/steps/fresh.glsl"

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

// What was found, or nothing if the pixel's indirect reservoir has it.
Direct counted_here(FoundLight found, inout Path path, inout uint rng) {
  Direct direct = found.direct;
  if (kReusesIndirect && !IN_MEDIUM && hand_over(path, found.way, found.weight, direct.radiance, rng))
    direct.radiance = vec3(0.0);
  return direct;
}

Direct look_for_light(Vertex v, inout Guidance g, inout Path path, inout uint rng) {
  Aim aim = kNoAim;
  bool first = !IN_MEDIUM && path.depth == 0u, by_reservoir = false;
  if (first) {
    LightReservoir r = unpack_light(final_reservoirs.at[lit_index(path.pixel)]);
    path.own.reused.reuses = by_reservoir = reuses(r);
    if (by_reservoir && path.own.reused.asks) aim = reservoir_aim(v, r);
  }
  if (!by_reservoir) aim = aim_at_light(v, kBoth, rng);
  // A reservoir's light is shared with the vertex's own scattering, whatever proposes directions: what has been learnt
  // must not decide over samples that taught it.
  float proposed = by_reservoir ? shared_density(aim.bsdf_pdf) : proposal_pdf(v, g, aim.direction, aim.bsdf_pdf);
  FoundLight found = find_by_aim(v, aim, proposed, rng);
  if (by_reservoir && scatters_candidates() && !found.way.certain) found.direct = Direct(vec3(0.0), vec3(0.0));
  return counted_here(found, path, rng);
}

float met_share(Vertex v, Segment way, Proposal p, vec3 emission, inout Path path) {
  if (path.own.reused.reuses && path.depth == 0u) {
    if (kReusesIndirect) open_second(path, way, p);
    if (emission == vec3(0.0) || (p.flags & kScatterDelta) != 0u) return 1.0;
    if (scatters_candidates()) {
      uint rng = 0u;  // which of the suns it is does not matter
      float seen;
      return reusable_sample(v, way, rng, seen).name == 0u ? 1.0 : 0.0;
    }
    float own = p.pdf;
    if (!kScatters) scatter_eval(v.scatter, v.view, p.direction, own);
    float all = plain_density(v, p.direction, way) + own;
    return all > 0.0 ? own / all : 1.0;
  }
  float share = met_share_of(v, way, p, emission, kBoth);
  if (!kReusesIndirect || IN_MEDIUM) return share;
  uint rng = rng_seed(path.number, frame.frame, 0x7f4a7c15u, frame.seed);
  bool handed = hand_over(path, way, p.pdf > 0.0 ? share / p.pdf : 0.0, p.weight * emission * way.left * share, rng);
  return handed ? 0.0 : share;
}

Direct last_light(Vertex v, inout Path path, inout uint rng) { return counted_here(find_in_turns(v, rng), path, rng); }
#endif
