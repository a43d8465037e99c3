// For each pixel at which light is sampled: candidates of the list of lights and of scattered rays, one of which a
// reservoir keeps with the former frame's (Majercik 2022, Section 3.2); and the light that is not theirs: suns, what
// bends, and what the bounded geometry term leaves (Eq. 9).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
#include "lib/steps/one_path.glsl"
#include "lib/steps/no_field.glsl"
#include "lib/steps/propose_scatter.glsl"
#include "lib/steps/no_learning.glsl"
#include "estimators/ddgi/steps/resampled.glsl"

// Candidates of the list: places on lights, with what these send if they are even.
void add_listed(Vertex v, Candidates lamps, uint here, float rays, inout Reservoir r, inout LitSample chosen,
                inout uint rng) {
  uint listed = has_lights() ? light_candidates() : 0u, i = 0u;
  if (listed > 0u) do {
      GpuLight light;
      bool there = draw_candidate(lamps, i, rng, light);
      LitSample s = LitSample(light.instance, light.triangle, packUnorm2x16(sample_triangle(rng)), 0u);
      float pick = rng_uniform(rng);
      LitPlace p = place_of_sample(s, false);
      LitWay w = way_to_sample(v, p);
      float area = 0.5 * length(cross(p.triangle.e1.xyz, p.triangle.e2.xyz));
      // The list knows a light's power alone, as the sum of its channels.
      s.sent = pack_rgb9e5(vec3(frame.light_power * light_probability(light) / (3.0 * max(area, 1e-12))), 0.5);
      bool scattered = !ends_by_chance(Hit(0.0, vec2(0.0), light.instance, light.triangle));
      float all = draws_of(lamps, light) + (w.seen > 0.0 ? rays * w.bsdf / w.seen : 0.0);
      bool counts = there && scattered && all > 0.0 && !is_within_light(v, w.reach);
      float target = counts ? lit_target(w, s.sent) * hope_of(lamps, light, seen_way(here, p.place)) : 0.0;
      if (update_reservoir(r, target / max(all, 1e-30), target, 0.0, pick)) chosen = s;
    } while (++i < listed);
}

// Of a scattered ray: its sample, if reservoirs may have it, and what they do not have of its light.
vec3 add_scattered(Vertex v, Candidates lamps, uint here, float rays, inout Reservoir r, inout LitSample chosen,
                   inout uint rng) {
  Proposal q = propose_scattered(v, rng);
  bool goes = q.weight != vec3(0.0);
  Segment way = segment_from(v, q.direction, goes ? kRayEnd : 0.0, kTurnByChance, rng);
  float pick = rng_uniform(rng);
  if (!goes) return vec3(0.0);
  vec3 sent = sent_light(v, way, rng), reflected = q.weight * way.left * sent / rays;
  if (!is_reusable(way) || (q.flags & kScatterDelta) != 0u) return reflected;
  LitSample s = LitSample(way.hit.instance, way.hit.triangle, packUnorm2x16(way.hit.bary), pack_rgb9e5(sent, 0.5));
  LitPlace p = place_of_sample(s, false);
  LitWay w = way_to_sample(v, p);
  float listed =
      is_within_light(v, way.hit.t) || w.seen <= 0.0 ? 0.0 : hit_light_pdf(cell_of(v), way.hit, q.direction) / w.seen;
  float all = listed + (w.seen > 0.0 ? rays * w.bsdf / w.seen : 0.0), target = all > 0.0 ? lit_target(w, s.sent) : 0.0;
  if (update_reservoir(r, target / max(all, 1e-30), target, 0.0, pick)) chosen = s;
  vec3 normal = normalize(cross(p.triangle.e1.xyz, p.triangle.e2.xyz));
  float share = bounded_share(w.reach, max(dot(v.scatter.normal, w.direction), 0.0), abs(dot(normal, w.direction)));
  return reflected * (1.0 - share);
}

// A sun, by a ray of its own.
vec3 sun_light(Vertex v, inout uint rng) {
  float radiance;
  bool bends = bends_suns(v);
  vec3 direction = sample_sun(v, bends, rng, radiance);
  float bsdf, density = bends ? refracted_density(v, direction) : sun_pdf(direction);
  vec3 f = scatter_eval(v.scatter, v.view, direction, bsdf);
  Segment way = segment_from(v, direction, density > 0.0 ? kRayEnd : 0.0, bends ? kTurnByChance : kTurnNowhere, rng);
  if (!(density > 0.0) || !is_sky(way.hit) || !(sun_pdf(way.direction) > 0.0)) return vec3(0.0);
  return f * light_emission(way.hit, way.direction, !bends) * way.left / density;
}

LitReservoir former_reservoir(FormerTexel f) {
  if (!f.known || ddgi.reservoirs_former == kNoIndex) return no_lit_reservoir();
  LitReservoir r = FB_LOAD_LIT(ddgi_reservoirs, ddgi.reservoirs_former + f.element);
  if (r.chosen.instance != kNoIndex) r.chosen.instance = instance_now(r.chosen.instance);
  return r;
}

Vertex former_vertex(FormerTexel f) {
  Vertex v = first_vertex(f.texel, f.pixel);
  v.view = normalize(frame.prev_camera_position.xyz - v.position);
  return v;
}

// Generalised balance heuristic (Lin 2022), of targets without visibility: all are of functions that hold for both
// frames.
LitReservoir over_time(LitReservoir fresh, Vertex here, GBufferTexel g, PathPixel p, inout uint rng) {
  FormerTexel f = former_lit_texel(g, p.pixel, ivec2(0));
  LitReservoir old = former_reservoir(f);
  old.confidence = min(old.confidence, ddgi.restir_history);
  if (!(old.confidence > 0.0)) return fresh;
  Vertex there = former_vertex(f);
  float fresh_here = target_at(here, fresh.chosen, false), fresh_there = target_at(there, fresh.chosen, true);
  float old_here = target_at(here, old.chosen, false), old_there = target_at(there, old.chosen, true);
  float a = mis_score(fresh.confidence, fresh_here), b = mis_score(old.confidence, fresh_there);
  float fresh_share = mis_balance(a, a + b);
  a = mis_score(fresh.confidence, old_here);
  b = mis_score(old.confidence, old_there);
  float old_share = mis_balance(b, a + b);
  Reservoir r = empty_reservoir();
  LitReservoir result = no_lit_reservoir();
  if (update_reservoir(r, fresh_share * fresh_here * fresh.weight, fresh_here, fresh.confidence, rng_uniform(rng)))
    result.chosen = fresh.chosen;
  if (update_reservoir(r, old_share * old_here * old.weight, old_here, old.confidence, rng_uniform(rng)))
    result.chosen = old.chosen;
  finish_reservoir(r, 1.0);
  result.weight = r.contribution_weight;
  result.confidence = r.confidence;
  return result;
}

void main() {
  PathPixel p = path_pixel(invocation_pixel());
  if (any(greaterThanEqual(p.block, lit_blocks()))) return;
  LitReservoir r = no_lit_reservoir();
  vec3 rest = vec3(0.0);
  if (within_picture(p)) {
    GBufferTexel g = gbuffer_at(p.at);
    if (reflects_light(g)) {
      Vertex v;
      uint rng;
      begin_pixel(p, g, v, rng);
      Candidates lamps = candidates_of(cell_of(v));
      uint here = seen_place(scatter_origin(v.scatter, v.position), 0u), i = 0u;
      float rays = float(frame.spp);
      Reservoir fresh = empty_reservoir();
      add_listed(v, lamps, here, rays, fresh, r.chosen, rng);
      do rest += add_scattered(v, lamps, here, rays, fresh, r.chosen, rng);
      while (++i < frame.spp);
      if (has_feature(kFeatureSuns) && frame.sun_count > 0u) rest += sun_light(v, rng);
      finish_reservoir(fresh, 1.0);
      r.weight = fresh.contribution_weight;
      if (may_reuse(p.at, g)) {
        r.confidence = 1.0;
        if (ddgi.restir_history > 0.0) r = over_time(r, v, g, p, rng);
      }
    }
  }
  uint at = element_of(p.block);
  FB_STORE_LIT(ddgi_merged, at, r)
  ddgi_rest.at[at] = vec4(rest, 0.0);
}
