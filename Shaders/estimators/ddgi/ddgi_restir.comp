// Technique `ddgi_restir`: light of a pixel's first vertex is of one sample of all surfaces, which reservoirs chose by
// what they emit and what probes know that they reflect (passes/candidates.comp). Here a pixel takes up its neighbours'
// samples and asks by a ray for the one that is left (Majercik 2022, Sections 3.2, 3.6 and 3.7). Biased as `ddgi_plus`
// is.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#if INTERSECTOR_QUERY
#extension GL_EXT_ray_query : require
#endif
const bool kPlus = true;
#include "estimators/ddgi/steps/field.glsl"
#include "lib/steps/propose_scatter.glsl"
#include "lib/steps/no_learning.glsl"
#include "estimators/ddgi/steps/resampled.glsl"
#include "estimators/ddgi/steps/views.glsl"

layout(constant_id = kSpecShowView) const bool SHOW_VIEW = false;

const float kLikeNormal = 0.8, kLikeDepth = 0.1;

struct Neighbor {
  bool there;
  uvec2 block, pixel;
};
// A block within r_restir_radius, that shows a surface like this one.
Neighbor neighbor_of(PathPixel p, GBufferTexel g, inout uint rng) {
  float radius = max(ddgi.restir_radius * float(frame.height) / (1080.0 * float(frame.light_block)), 1.5);
  float far = radius * sqrt(rng_uniform(rng)), turn = 2.0 * kPiShared * rng_uniform(rng);
  ivec2 block = ivec2(floor(vec2(p.block) + 0.5 + far * vec2(cos(turn), sin(turn))));
  Neighbor n;
  n.there =
      all(greaterThanEqual(block, ivec2(0))) && all(lessThan(block, ivec2(lit_blocks()))) && block != ivec2(p.block);
  n.block = n.there ? uvec2(block) : p.block;
  n.pixel = light_pixel(n.block);
  n.there = n.there && n.pixel.x < frame.width && n.pixel.y < frame.height;
  n.pixel = n.there ? n.pixel : p.pixel;
  uint at = n.pixel.y * frame.width + n.pixel.x;
  float depth = uintBitsToFloat(gbuffer_quad(at, 4u).z);
  n.there = n.there && dot(unpack_direction(gbuffer_quad(at, 3u).x), unpack_direction(g.normal)) > kLikeNormal &&
            abs(depth - g.motion.z) < kLikeDepth * g.motion.z;
  return n;
}
LitReservoir reservoir_of(Neighbor n) {
  if (!n.there) return no_lit_reservoir();
  return FB_LOAD_LIT(ddgi_merged, element_of(n.block));
}

// By pairwise MIS (Bitterli 2022; Lin 2022).
LitReservoir with_neighbors(LitReservoir own, Vertex here, GBufferTexel g, PathPixel p, inout uint rng) {
  uint again = rng, neighbors = uint(ddgi.restir_neighbors), i = 0u;
  float others = 0.0;
  do others += reservoir_of(neighbor_of(p, g, again)).confidence;
  while (++i < neighbors);
  PairwiseMis pairs = pairwise_mis(own.confidence, others, defensive_share(own.confidence, others));
  float own_target = target_at(here, own.chosen, false), own_share = pairs.defensive;
  Reservoir r = empty_reservoir();
  LitReservoir result = no_lit_reservoir();
  i = 0u;
  do {
    Neighbor n = neighbor_of(p, g, rng);
    LitReservoir other = reservoir_of(n);
    float u = rng_uniform(again);
    if (other.confidence > 0.0) {
      Vertex about = first_vertex(gbuffer_at(n.pixel.y * frame.width + n.pixel.x), n.pixel);
      float target_here = target_at(here, other.chosen, false), target_there = target_at(about, other.chosen, false);
      own_share += mis_pairwise_canonical(pairs, other.confidence, target_at(about, own.chosen, false), own_target);
      float share = mis_pairwise(pairs, other.confidence, target_there, target_here);
      if (update_reservoir(r, share * target_here * other.weight, target_here, other.confidence, u))
        result.chosen = other.chosen;
    }
  } while (++i < neighbors);
  if (update_reservoir(r, own_share * own_target * own.weight, own_target, own.confidence, rng_uniform(again)))
    result.chosen = own.chosen;
  finish_reservoir(r, 1.0);
  result.weight = r.contribution_weight;
  result.confidence = r.confidence;
  return result;
}

// What a reservoir's sample sends here is asked for anew: what it was chosen by was sent elsewhere (Section 3.7).
vec3 light_of(Vertex v, LitReservoir r, inout uint rng) {
  LitWay w = way_to_sample(v, place_of_sample(r.chosen, false));
  bool asks = r.weight > 0.0 && w.f != vec3(0.0);
  Segment way = segment_from(v, w.direction, asks ? w.reach * 1.001 + 0.01 : 0.0, kTurnNowhere, rng);
  bool found = asks && way.hit.instance == r.chosen.instance && way.hit.triangle == r.chosen.triangle && way.certain;
  if (asks)
    count_way(seen_way(seen_place(scatter_origin(v.scatter, v.position), 0u), v.position + w.direction * w.reach),
              found);
  return found ? w.f * sent_light(v, way, rng) * r.weight : vec3(0.0);
}

void main() {
  PathPixel p = path_pixel(invocation_pixel());
  if (any(greaterThanEqual(p.block, lit_blocks()))) return;
  uint at = element_of(p.block);
  LitReservoir r = no_lit_reservoir();
  if (within_picture(p)) {
    GBufferTexel g = gbuffer_at(p.at);
    bool lit = reflects_light(g);
    Vertex v = first_vertex(g, p.pixel);
    if (lit) {
      uint rng;
      Path path = begin_pixel(p, g, v, rng);
      rng = rng_seed(p.at, frame.frame, 0u, frame.seed ^ 0x1b873593u);
      r = FB_LOAD_LIT(ddgi_merged, at);
      if (r.confidence > 0.0 && ddgi.restir_neighbors > 0) r = with_neighbors(r, v, g, p, rng);
      PixelLight light = no_light();
      add_sample(light, path, light_of(v, r, rng) + ddgi_rest.at[at].rgb);
      store_light(p, g, light, 1.0);
    } else {
      store_emission(p, g);
    }
    if (SHOW_VIEW) draw_view(p, lit, v);
  }
  FB_STORE_LIT(ddgi_reservoirs, ddgi.reservoirs_now + at, r)
}
