// Each pixel's reservoir takes up those of a few neighbours, by pairwise MIS (Bitterli 2022; Lin 2022).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kReusesIndirect = false;
#include "estimators/restir/steps/pixel.glsl"

LightReservoir reservoir_of(Neighbor n) { return n.there ? unpack_light(merged.at[element_of(n.block)]) : no_reuse(); }

void main() {
  PathPixel p = path_pixel(invocation_pixel());
  if (!is_block(p)) return;
  uint at = element_of(p.block);
  LightReservoir own = unpack_light(merged.at[at]);
  LightReservoir result = own;
  if (reuses(own)) {
    GBufferTexel g = gbuffer_at(p.at);
    uint rng = pass_seed(p, 0x1b873593u), again = rng;
    Domain here = domain_of(first_vertex(g, p.pixel), false);
    Hope hope = hope_at(here);
    float others = 0.0;
    uint i = 0u, neighbors = uint(restir.restir_neighbors);
    do {
      LightReservoir r = reservoir_of(neighbor_of(p, g, again));
      others += reuses(r) ? r.confidence : 0.0;
    } while (++i < neighbors);

    PairwiseMis pairs = pairwise_mis(own.confidence, others, defensive_share(own.confidence, others));
    LightPoint own_point = point_of(own.chosen);
    float own_target = light_target(here, own_point), own_share = pairs.defensive, all = own.confidence + others;
    Reservoir r = empty_reservoir();
    result = no_reservoir();
    i = 0u;
    do {
      Neighbor n = neighbor_of(p, g, rng);
      LightReservoir other = reservoir_of(n);
      float u = rng_uniform(again);
      if (reuses(other)) {
        uint there = n.pixel.y * frame.width + n.pixel.x;
        Domain about = domain_of(first_vertex(gbuffer_at(there), n.pixel), false);
        LightPoint point = point_of(other.chosen);
        float target_here = light_target(here, point), target_there = light_target(about, point);
        float own_there = light_target(about, own_point);
        if (restir.restir_visibility > 1) {
          if (target_here > 0.0 && !arrives(here, point, again)) target_here = 0.0;
          if (own_there > 0.0 && !arrives(about, own_point, again)) own_there = 0.0;
        }
        own_share += mis_pairwise_canonical(pairs, other.confidence, own_there, own_target);
        float share = restir.restir_mis == 0 ? mis_pairwise(pairs, other.confidence, target_there, target_here)
                                             : mis_by_confidence(other.confidence, all);
        target_here *= hope_for(hope, point);
        if (update_reservoir(r, share * target_here * other.weight, target_here, other.confidence, u)) {
          result.chosen = other.chosen;
          result.age = other.age;
        }
      }
    } while (++i < neighbors);
    if (restir.restir_mis != 0) own_share = mis_by_confidence(own.confidence, all);
    own_target *= hope_for(hope, own_point);
    if (update_reservoir(r, own_share * own_target * own.weight, own_target, own.confidence, rng_uniform(again))) {
      result.chosen = own.chosen;
      result.age = own.age;
    }
    finish_reservoir(r, 1.0);
    result.weight = r.contribution_weight;
    result.confidence = r.confidence;
  }
  final_reservoirs.at[at] = pack_light(result);
  if (restir.restir_keep != 0) reservoirs.at[restir.now + at] = pack_light(result);
}
