// Each pixel's reservoir of light of two reflections takes up those of a few neighbours by pairwise MIS, and its light
// is added to the picture.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kReusesIndirect = true;
#include "estimators/restir/steps/pixel.glsl"
#include "lib/store_light.glsl"

IndirectReservoir reservoir_of(Neighbor n) {
  if (!n.there) return no_indirect_reuse();
  return FB_LOAD_INDIRECT(fresh, element_of(n.block));
}

// The target of a sample at a vertex where others brought it from.
float target_at(Domain d, IndirectPoint p, inout uint rng) {
  IndirectWay w = indirect_way(d, p);
  if (restir.restir_gi_visibility != 0 && w.target > 0.0 &&
      !ends_there(p, segment_from(d.v, w.direction, w.reach * 1.001 + 0.01, kTurnNowhere, rng)))
    w.target = 0.0;
  return w.target;
}

IndirectReservoir with_neighbors(IndirectReservoir own, Domain here, GBufferTexel g, PathPixel p, inout uint rng) {
  uint again = rng, neighbors = uint(restir.restir_gi_neighbors), i = 0u;
  float others = 0.0;
  do {
    IndirectReservoir r = reservoir_of(neighbor_of(p, g, again));
    others += reuses(r) ? r.confidence : 0.0;
  } while (++i < neighbors);

  PairwiseMis pairs = pairwise_mis(own.confidence, others, defensive_share(own.confidence, others));
  IndirectPoint own_point = indirect_point(own.chosen);
  float own_target = indirect_way(here, own_point).target, own_share = pairs.defensive;
  Reservoir r = empty_reservoir();
  IndirectReservoir result = no_indirect();
  i = 0u;
  do {
    Neighbor n = neighbor_of(p, g, rng);
    IndirectReservoir other = reservoir_of(n);
    float u = rng_uniform(again);
    if (reuses(other)) {
      Domain about = domain_of(first_vertex(gbuffer_at(n.pixel.y * frame.width + n.pixel.x), n.pixel), false);
      IndirectPoint point = indirect_point(other.chosen);
      float target_here = target_at(here, point, again), own_there = target_at(about, own_point, again);
      float target_there = indirect_way(about, point).target;
      own_share += mis_pairwise_canonical(pairs, other.confidence, own_there, own_target);
      float share = mis_pairwise(pairs, other.confidence, target_there, target_here);
      if (update_reservoir(r, share * target_here * other.weight, target_here, other.confidence, u)) {
        result.chosen = other.chosen;
        result.age = other.age;
      }
    }
  } while (++i < neighbors);
  if (update_reservoir(r, own_share * own_target * own.weight, own_target, own.confidence, rng_uniform(again))) {
    result.chosen = own.chosen;
    result.age = own.age;
  }
  finish_reservoir(r, 1.0);
  result.weight = r.contribution_weight;
  result.confidence = r.confidence;
  return result;
}

// What a reservoir's sample brings: both its ways are asked by rays.
vec3 light_of(Domain here, IndirectReservoir r, inout uint rng) {
  IndirectPoint p = indirect_point(r.chosen);
  IndirectWay w = indirect_way(here, p);
  if (!(w.target > 0.0) || !(r.weight > 0.0)) return vec3(0.0);
  Vertex from = here.v;
  vec3 direction = w.direction, emission = vec3(0.0);
  float reach = w.reach * 1.001 + 0.01;
  uint i = 0u;
  do {
    Segment way = segment_from(from, direction, reach, kTurnNowhere, rng);
    if (i == 1u) {
      Aim aim = kNoAim;
      aim.instance = p.light.sun ? kNoIndex : p.light.light.instance;
      aim.triangle = p.light.sun ? kNoIndex : p.light.light.triangle;
      if (way.certain && is_found(aim, way)) emission = light_emission(way.hit, way.direction, true) * way.left;
      break;
    }
    if (!ends_there(p, way)) break;
    if (keeps_radiance()) {
      emission = vec3(1.0);
      break;
    }
    from = w.second;
    direction = w.light.direction;
    reach = p.light.sun ? kRayEnd : w.light.reach * 1.001 + 0.01;
  } while (++i < 2u);
  // The medium of both ways is in w.f and in the last one's `left`.
  return w.f * emission * r.weight;
}

void main() {
  PathPixel p = path_pixel(invocation_pixel());
  if (!is_block(p)) return;
  uint at = element_of(p.block);
  IndirectReservoir r = FB_LOAD_INDIRECT(fresh, at);
  if (reuses(r)) {
    GBufferTexel g = gbuffer_at(p.at);
    uint rng = pass_seed(p, 0x297a2d39u);
    Domain here = domain_of(first_vertex(g, p.pixel), false);
    if (restir.restir_gi_neighbors > 0) r = with_neighbors(r, here, g, p, rng);
    add_light(p, g, light_of(here, r, rng));
  }
  if (restir.restir_keep != 0) {
    FB_STORE_INDIRECT(indirect_reservoirs, restir.now + at, r)
  }
}
