// New candidates of a pixel's reservoir of light.
#ifndef FB_RESTIR_CANDIDATES
#define FB_RESTIR_CANDIDATES
#include "estimators/restir/steps/fresh.glsl"

// How many rays and how many sets of candidates of the list a reservoir has. A set: light_candidates() of the list, one
// of the suns.
struct Draws {
  uint rays, sets;
};
Draws draws_of_pixel() {
  Draws d;
  d.rays = scatters_candidates() ? uint(frame.spp) : 0u;
  d.sets = restir.restir_candidates != 1 ? uint(frame.spp * restir.restir_sets) : 0u;
  return d;
}

// How often candidates are this sample, in its measure. `of_set`: how often one set's are.
float often(Draws n, float of_set, LightWay w) {
  return float(n.sets) * of_set + (n.rays > 0u && w.seen > 0.0 ? float(n.rays) * w.bsdf / w.seen : 0.0);
}

// What scattered rays meet. Of one ray: its sample, if reservoirs may have it.
LightSample scattered_sample(Vertex v, inout uint rng) {
  Proposal s = propose_scattered(v, rng);
  bool goes = s.weight != vec3(0.0) && (s.flags & kScatterDelta) == 0u;
  Segment way = segment_from(v, s.direction, goes ? kRayEnd : 0.0, kTurnByChance, rng);
  float seen;
  return goes ? reusable_sample(v, way, rng, seen) : kNoSample;
}

// One sample of all candidates (resampled importance sampling, Talbot 2005, by the balance heuristic). What past rays
// found decides which lights of the list there are, and how much of their light is hoped for.
LightReservoir new_candidates(Domain d, Hope hope, inout uint rng) {
  Reservoir r = empty_reservoir();
  LightSample s = kNoSample;
  Draws n = draws_of_pixel();
  uint count = has_lights() ? light_candidates() * n.sets : 0u, i = 0u;
  GpuLight chosen;
  bool of_list = false;
  if (count > 0u) do {
      GpuLight light;
      bool there = draw_candidate(hope.lamps, i % light_candidates(), rng, light);
      LightPoint p = point_on(light, rng_next(rng), false);
      p.there = p.there && there &&
                !(scatters_candidates() && ends_by_chance(Hit(0.0, vec2(0.0), light.instance, light.triangle)));
      LightWay w = way_to_light(d, p);
      float target = target_of_way(d, p, w) * hope_for(hope, p), all = often(n, draws_of(hope.lamps, light), w);
      if (update_reservoir(r, all > 0.0 ? target / all : 0.0, target, 0.0, rng_uniform(rng))) {
        chosen = light;
        s.place = p.packed_place;
        of_list = true;
      }
    } while (++i < count);
  if (of_list) s = sample_of(chosen, s.place);
  uint drawn = has_feature(kFeatureSuns) && frame.sun_count > 0u ? n.sets : 0u;
  i = 0u;
  if (drawn > 0u) do {
      LightPoint p = point_in_sun(random_below(frame.sun_count, rng), rng_next(rng));
      LightWay w = way_to_light(d, p);
      float target = target_of_way(d, p, w) * hope_for(hope, p);
      if (update_reservoir(r, target / often(n, 1.0 / float(frame.sun_count), w), target, 0.0, rng_uniform(rng)))
        s = LightSample(kKindSun | p.number, p.packed_place);
    } while (++i < drawn);
  i = 0u;
  if (n.rays > 0u) do {
      LightSample met = scattered_sample(d.v, rng);
      LightPoint p = point_of(met);
      LightWay w = way_to_light(d, p);
      float of_set = p.sun ? 1.0 / float(max(frame.sun_count, 1u)) : draws_of(hope.lamps, p.light);
      float target = target_of_way(d, p, w) * hope_for(hope, p), all = often(n, of_set, w);
      if (update_reservoir(r, all > 0.0 ? target / all : 0.0, target, 0.0, rng_uniform(rng))) s = met;
    } while (++i < n.rays);
  finish_reservoir(r, 1.0);
  return LightReservoir(s, r.contribution_weight, 1.0, 0.0);
}
#endif
