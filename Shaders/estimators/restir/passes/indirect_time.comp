// A reservoir of light of two reflections for each pixel: of what its paths found in this frame (steps/fresh.glsl) and
// of the former frame's reservoir there.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kReusesIndirect = true;
#include "estimators/restir/steps/pixel.glsl"

const float kRounding = 0.01;  // of former_world, in units; 500 units away twice as much

IndirectReservoir former_reservoir(FormerTexel f) {
  if (!f.known || restir.former_indirect == kNoIndex) return no_indirect_reuse();
  IndirectReservoir r = FB_LOAD_INDIRECT(indirect_reservoirs, restir.former_indirect + f.element);
  if (r.chosen.instance != kNoIndex) r.chosen.instance = instance_now(r.chosen.instance);
  return r;
}

// The most that a former sample counts as, from a history of so many frames.
float most_confidence(float history, FormerTexel f, IndirectSample s, inout uint rng) {
  if (restir.restir_duplicates == 0) return history;
  uvec4 words = uvec4(s.instance, s.triangle, s.bary.x, s.light.name);
  uint alike = 0u, i = 0u;
  do {
    uint element = 2u * (restir.former_indirect + near_former(f, rng));
    uvec4 other = indirect_reservoirs.at[element];
    if (other.x != kNoIndex) other.x = instance_now(other.x);
    alike += other == words && indirect_reservoirs.at[element + 1u].x == s.light.place ? 1u : 0u;
  } while (++i < kNearFormer);
  return confidence_among(history, alike);
}

// The targets of a fresh sample and of an old one, here and where the history is.
struct Targets {
  float fresh_here, fresh_there, old_here, old_there;
};
// `moved`: what the pixel shows was elsewhere, where something else may be now.
Targets targets_of(Domain here, Domain there, bool moved, IndirectPoint fresh_point, IndirectPoint old_point,
                   inout uint rng) {
  Targets t = Targets(0.0, 0.0, 0.0, 0.0);
  uint i = 0u;
  do {
    bool old = (i & 1u) != 0u, is_there = (i & 2u) != 0u;
    Domain d = here;
    if (is_there) d = there;
    IndirectPoint p = fresh_point;
    if (old) p = old_point;
    IndirectWay w = indirect_way(d, p);
    // What a path found has met nothing on its ways, so targets in which that is left out would promise too much
    // elsewhere. Where a light that moves came from it may have been hidden. What moved itself may be within something
    // now: nothing is asked there.
    bool asks = restir.restir_gi_visibility != 0 && old != is_there;
    bool lit = w.target > 0.0,
         light_moved = !keeps_radiance() && is_there && p.light.place != p.light.before && p.place == p.before;
    uint k = is_there && moved ? 1u : 0u, ways = light_moved ? 2u : 1u;
    if (asks && lit && k < ways) do {
        vec3 to = p.place - d.origin;
        float reach = length(to);
        Vertex from = d.v;
        vec3 direction = to / max(reach, 1e-20);
        if (k == 1u) {
          from = w.second;
          direction = w.light.direction;
          reach = w.light.reach * 0.998 - 0.02;
        }
        Segment way = segment_from(from, direction, k == 0u ? reach * 1.001 + 0.01 : reach, kTurnNowhere, rng);
        lit = k == 0u ? ends_there(p, way) : way.hit.instance == kNoIndex;
      } while (lit && ++k < ways);
    if (!lit) w.target = 0.0;
    if (i == 0u)
      t.fresh_here = w.target;
    else if (i == 1u)
      t.old_here = w.target;
    else if (i == 2u)
      t.fresh_there = w.target;
    else
      t.old_there = w.target;
  } while (++i < 4u);
  return t;
}

IndirectReservoir over_time(IndirectReservoir fresh, Domain here, GBufferTexel g, PathPixel p, inout uint rng) {
  FormerTexel f = history_of(g, p);
  IndirectReservoir old = former_reservoir(f);
  if (!reuses(old)) return fresh;
  old.confidence = min(old.confidence, most_confidence(restir.restir_gi_history, f, old.chosen, rng));
  vec3 before = former_world(g, vec2(p.pixel) + 0.5 + jitter_of(p.pixel));
  bool moved = distance(before, g.position_t.xyz) > kRounding + kRounding * 2e-3 * g.position_t.w;
  Targets t = targets_of(here, domain_of(former_vertex(f), true), moved, indirect_point(fresh.chosen),
                         indirect_point(old.chosen), rng);
  float a = mis_score(fresh.confidence, t.fresh_here), b = mis_score(old.confidence, t.fresh_there);
  float fresh_share = mis_balance(a, a + b);
  a = mis_score(fresh.confidence, t.old_here);
  b = mis_score(old.confidence, t.old_there);
  float old_share = mis_balance(b, a + b);

  Reservoir r = empty_reservoir();
  IndirectReservoir result = no_indirect();
  if (update_reservoir(r, fresh_share * t.fresh_here * fresh.weight, t.fresh_here, fresh.confidence, rng_uniform(rng)))
    result.chosen = fresh.chosen;
  if (update_reservoir(r, old_share * t.old_here * old.weight, t.old_here, old.confidence, rng_uniform(rng))) {
    result.chosen = old.chosen;
    result.age = min(old.age + 1.0, 2047.0);
  }
  finish_reservoir(r, 1.0);
  result.weight = r.contribution_weight;
  result.confidence = r.confidence;
  return result;
}

void main() {
  PathPixel p = path_pixel(invocation_pixel());
  if (!is_block(p)) return;
  uint at = element_of(p.block);
  IndirectReservoir r = no_indirect_reuse();
  if (within_picture(p) && reuses(unpack_light(final_reservoirs.at[at]))) {
    r = fresh_reservoir(at);
    if (restir.restir_gi_history > 0.0) {
      GBufferTexel g = gbuffer_at(p.at);
      uint rng = pass_seed(p, 0x2c1b3c6du);
      r = over_time(r, domain_of(first_vertex(g, p.pixel), false), g, p, rng);
    }
  }
  FB_STORE_INDIRECT(fresh, at, r)
  if (restir.restir_keep == 0) {
    FB_STORE_INDIRECT(indirect_reservoirs, restir.now + at, r)
  }
}
