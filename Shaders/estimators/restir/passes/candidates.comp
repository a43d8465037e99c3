// A reservoir for each pixel at which light is sampled: of this frame's candidates and of the former frame's reservoir
// there.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kReusesIndirect = false;
#include "estimators/restir/steps/pixel.glsl"
#include "estimators/restir/steps/candidates.glsl"

LightReservoir former_reservoir(FormerTexel f) {
  if (!f.known || restir.former == kNoIndex) return no_reuse();
  LightReservoir r = unpack_light(reservoirs.at[restir.former + f.element]);
  if ((r.chosen.name & kKindBits) == kKindUnnamed) r.weight = 0.0;  // its place in the list is another's now
  return r;
}

// The most that a former sample counts as, from a history of so many frames.
float most_confidence(float history, FormerTexel f, LightSample s, inout uint rng) {
  if (restir.restir_duplicates == 0) return history;
  uint alike = 0u, i = 0u;
  do {
    alike += reservoirs.at[restir.former + near_former(f, rng)].xy == uvec2(s.name, s.place) ? 1u : 0u;
  } while (++i < kNearFormer);
  return confidence_among(history, alike);
}

LightReservoir over_time(LightReservoir fresh, Domain here, Hope hope, GBufferTexel g, PathPixel p, inout uint rng) {
  FormerTexel f = history_of(g, p);
  LightReservoir old = former_reservoir(f);
  if (!reuses(old)) return fresh;
  old.confidence = min(old.confidence, most_confidence(restir.restir_history, f, old.chosen, rng));
  Domain there = domain_of(former_vertex(f), true);

  LightPoint new_point = point_of(fresh.chosen), old_point = point_of(old.chosen);
  float fresh_here = light_target(here, new_point), fresh_there = light_target(there, new_point);
  float old_here = light_target(here, old_point), old_there = light_target(there, old_point);
  if (restir.restir_visibility > 1) {
    if (fresh_there > 0.0 && !arrives(there, new_point, rng)) fresh_there = 0.0;
    if (old_here > 0.0 && !arrives(here, old_point, rng)) old_here = 0.0;
  }
  float fresh_share, old_share;
  if (restir.restir_mis == 0) {
    float a = mis_score(fresh.confidence, fresh_here), b = mis_score(old.confidence, fresh_there);
    fresh_share = mis_balance(a, a + b);
    a = mis_score(fresh.confidence, old_here);
    b = mis_score(old.confidence, old_there);
    old_share = mis_balance(b, a + b);
  } else {
    float all = fresh.confidence + old.confidence;
    fresh_share = mis_by_confidence(fresh.confidence, all);
    old_share = mis_by_confidence(old.confidence, all);
  }
  Reservoir r = empty_reservoir();
  LightSample s = kNoSample;
  float age = 0.0;
  fresh_here *= hope_for(hope, new_point);
  old_here *= hope_for(hope, old_point);
  if (update_reservoir(r, fresh_share * fresh_here * fresh.weight, fresh_here, fresh.confidence, rng_uniform(rng)))
    s = fresh.chosen;
  if (update_reservoir(r, old_share * old_here * old.weight, old_here, old.confidence, rng_uniform(rng))) {
    s = old.chosen;
    age = min(old.age + 1.0, 2047.0);
  }
  finish_reservoir(r, 1.0);
  return LightReservoir(s, r.contribution_weight, r.confidence, age);
}

void main() {
  PathPixel p = path_pixel(invocation_pixel());
  if (!is_block(p)) return;
  LightReservoir r = no_reuse();
  if (within_picture(p)) {
    GBufferTexel g = gbuffer_at(p.at);
    if (may_reuse(g, p.at)) {
      uint rng = pass_seed(p, 0x3c6ef372u);
      Vertex v = first_vertex(g, p.pixel);
      Domain here = domain_of(v, false);
      Hope hope = hope_at(here);
      r = new_candidates(here, hope, rng);
      if (restir.restir_visibility != 0 && !arrives(here, point_of(r.chosen), rng)) r.weight = 0.0;
      if (restir.restir_history > 0.0) r = over_time(r, here, hope, g, p, rng);
    }
  }
  uint at = element_of(p.block);
  merged.at[at] = pack_light(r);
  if (restir.restir_neighbors == 0) final_reservoirs.at[at] = pack_light(r);
  if (restir.restir_neighbors == 0 || restir.restir_keep == 0) reservoirs.at[restir.now + at] = pack_light(r);
}
