// Markov chain path guiding (Alber 2025), as a policy of the path loop: at a vertex, states are taken from an ensemble
// of hash grids, their vMF lobes and the BSDF make a mixture, one direction is sampled from it, and what the ray met
// updates a state. Given the states that were loaded, f cos / (pdf of the mixture) is unbiased whatever they hold.
//
// Beyond the paper (each can be turned off, see Misc/docs/estimators.md): a cell holds GUIDE_BUCKET states, so that a
// mixture has many lobes for few places in memory, and a sample goes to the lobe that explains it or else takes the
// least one's place; a score is a lobe's share of the energy; how often to guide is learnt.
#ifndef FB_LIB_GUIDE
#define FB_LIB_GUIDE
#include "lib/guide_cache.glsl"
#include "lib/path_vertex.glsl"

layout(constant_id = 2) const bool GUIDE_RESOLVE = false;  // store proposals, which a pass resolves in a fixed order
layout(constant_id = 3) const uint GUIDE_ACCESSES = 2u;    // cells that are looked at
layout(constant_id = 4) const uint GUIDE_BUCKET = 4u;      // states in a cell
const uint kGuideLobes = GUIDE_ACCESSES * GUIDE_BUCKET;

layout(constant_id = 5) const bool PATH_TAIL = false;     // paths end in the cache

const float kLeastUseful = 0.06;
const float kMatch = 0.02;  // a direction belongs to a lobe whose pdf there is at least this share of its peak

struct GuideCell {
  uint first;  // index of its first state
  uint check;
};

GuideCell guide_cell(vec3 p, vec3 n, bool adaptive) {
  vec3 u = vec3(rng_uniform(guide_rng), rng_uniform(guide_rng), rng_uniform(guide_rng));
  float width = frame.guide_grid.y;
  uint tag = kStaticTag;
  if (adaptive) {
    uint level = grid_level(distance(p, frame.camera_position.xyz), frame.guide_grid.x, rng_uniform(guide_rng));
    level = min(level + grid_coarsening(frame.guide_grid.w, rng_uniform(guide_rng)), kGridLevels - 1u);
    width = exp2(float(level));
    tag = adaptive_tag(level, n);
  }
  GridKey key = grid_vertex(p, width, tag, u);
  uint buckets = frame.guide_states / GUIDE_BUCKET;
  return GuideCell((key.hash & (buckets - 1u)) * GUIDE_BUCKET, key.check);
}

uvec2 load_guide_motion(uint at) {
  uint word = frame.guide_states + (at >> 1u);
  return (at & 1u) == 0u ? guide_states[word].xy : guide_states[word].zw;
}
GuideState load_guide_state(uint at) {
  return add_guide_motion(unpack_guide_state(guide_states[at]), load_guide_motion(at));
}

uint guide_age(GuideState s) { return (frame.guide_frame - s.time) & 0xffffu; }

// Where its light should be now (Alber 2025, eq. 10), for the few frames that this can be trusted.
vec3 predicted_target(GuideState s) {
  uint age = guide_age(s);
  bool moves = (frame.guide_flags & kGuidePredict) != 0u && age <= 8u;
  return moves ? s.target + s.velocity * (float(age) * max(frame.time - frame.prev_time, 0.0)) : s.target;
}

GuideView view_state(GuideState s, vec3 to_target, vec3 n) {
  return view_guide_state(s, to_target, dot(to_target, n) * inversesqrt(dot(to_target, to_target)), frame.guide_learn.w,
                          (frame.guide_flags & kGuideInWorld) != 0u);
}

// What is remembered of a vertex until its ray has hit.
struct GuideVertex {
  float pdf, guided_pdf, bsdf_pdf;  // of the direction
  bool has_lobes;
  float share;       // probability of guiding
  uint chosen;       // state whose lobe was sampled, or kNoIndex
  float chosen_part; // its weight in the mixture of lobes
  uint slot;         // where the result goes
  uint slot_check;
  bool matched;      // the state there explains the direction
  float slot_part;   // its weight in the mixture
  float slot_worth;  // of the least one, if none is matched
  bool near;         // the direction is nearer to the lobe's mean than its mean cosine
  float mean_score;
  CacheCell cell;
  uint cell_frames;  // that it has been trained in
  bool last;
  bool below;        // the direction points into the surface
};
GuideVertex guide;
CacheCell next_cell;  // about the vertex that was met last

// How often to guide at a point: of several probabilities, which were all tried on the same samples, the ones with low
// second moments of the estimate (off-policy: f^2 / (p_k p) averages f^2 / p_k whatever p the samples are from).
float learnt_share(CacheCell cell) {
  float prior = frame.guide_learn.x;
  if ((frame.guide_flags & kGuideLearnShare) == 0u || cell.entry == kNoIndex) return prior;
  vec4 m = cached_moments(cell.entry);
  if (!(min(min(m.x, m.y), min(m.z, m.w)) > 0.0)) return prior;
  // Moments are over the squared mean: less one they are variances, which the floor keeps from being trusted too far.
  vec4 variance = max(m - 1.0, vec4(0.0)) + 0.03;
  vec4 w = min(min(variance.x, variance.y), min(variance.z, variance.w)) / variance;
  w *= w;
  w *= w;
  float learnt = dot(w, guide_shares()) / dot(w, vec4(1.0));
  float n = float(guide.cell_frames);
  float share = mix(prior, learnt, n / (n + 4.0));
  // A guided sample that finds nothing costs more than it brings where there is next to nothing to guide to.
  return clamp(share < kLeastUseful ? 0.0 : share, frame.guide_pick.z, frame.guide_pick.y);
}

// The mixture of lobes at a vertex.
struct GuideMixture {
  VmfLobe lobes[kGuideLobes];
  vec2 weights[kGuideLobes];  // in the mixture; the state's score here
  GuideCell cells[GUIDE_ACCESSES];
  float total, all;  // sums of the weights
};

// Takes states from the cells about the vertex, and chooses one lobe by weight.
void load_mixture(PathVertex v, bool last, bool moved, inout uint rng, out GuideMixture mixture, out VmfLobe chosen,
                  out float chosen_part) {
  mixture.total = 0.0;
  mixture.all = 0.0;
  chosen = VmfLobe(v.normal, 0.0, 0.0);
  chosen_part = 0.0;
  float stratum = rng_uniform(guide_rng);
  [[unroll]] for (uint a = 0u; a < GUIDE_ACCESSES; ++a) {
    bool adaptive = float(a) + stratum < frame.guide_grid.z * float(GUIDE_ACCESSES);
    bool from_past = moved && a + 1u == GUIDE_ACCESSES;
    GuideCell cell = guide_cell(from_past ? v.previous : v.position, v.normal, adaptive);
    mixture.cells[a] = cell;
    [[unroll]] for (uint j = 0u; j < GUIDE_BUCKET; ++j) {
      uint i = a * GUIDE_BUCKET + j;
      uvec4 words = guide_states[cell.first + j];
      GuideState s = unpack_guide_state(words);
      if (guide_state_moves(words) && s.check == cell.check) s = add_guide_motion(s, load_guide_motion(cell.first + j));
      vec3 to_light = predicted_target(s) - v.position;
      float d2 = dot(to_light, to_light);
      bool valid = s.check == cell.check && s.weight > 0.0 && d2 > 1e-6;
      GuideView view = view_state(s, valid ? to_light : v.normal, v.normal);
      float score = valid ? s.weight * view.scale : 0.0;
      float part = dot(view.direction, v.normal) > 0.0 ? (last ? score * s.emissive : score) : 0.0;
      if (frame.guide_pick.x != 1.0) part = part > 0.0 ? pow(part, frame.guide_pick.x) : 0.0;
      mixture.lobes[i] = vmf_lobe(view.direction, vmf_kappa(view.spread));
      mixture.weights[i] = vec2(part, score);
      mixture.total += part;
      mixture.all += score;
      if (rng_uniform(rng) * mixture.total < part) {
        chosen = mixture.lobes[i];
        chosen_part = part;
        guide.chosen = cell.first + j;
      }
    }
  }
}

// The mixture's density in a direction, and which state the result will go to: of one of the cells, the one that explains
// the direction best, or else the one that is worth least.
void weigh_direction(GuideMixture mixture, vec3 direction, uint home) {
  float best = 0.0, least = 3e38, best_part = 0.0;
  uint best_slot = 0u, least_slot = 0u;
  guide.guided_pdf = 0.0;
  guide.near = false;
  [[unroll]] for (uint i = 0u; i < kGuideLobes; ++i) {
    VmfLobe lobe = mixture.lobes[i];
    vec2 weight = mixture.weights[i];
    float t = vmf_one_minus_cosine(lobe.mu, direction) * lobe.kappa;
    float e = exp(-t), p = e * lobe.scale * weight.x;
    guide.guided_pdf += p;
    bool here = i / GUIDE_BUCKET == home;
    float fit = e > kMatch ? max(p, e * 1e-30) : 0.0;
    if (here && weight.y > 0.0 && fit > best) {
      best = fit;
      best_slot = i;
      best_part = weight.x;
      guide.near = t < 1.0;
    }
    // Light that no lobe stands for is found by the BSDF alone: its second moment is what a slot is worth.
    float worth = weight.y * weight.y * lobe.scale;
    if (here && worth < least) {
      least = worth;
      least_slot = i;
    }
  }
  GuideCell cell = mixture.cells[0];
  [[unroll]] for (uint a = 1u; a < GUIDE_ACCESSES; ++a) {
    if (a == home) cell = mixture.cells[a];
  }
  guide.guided_pdf = mixture.total > 0.0 ? guide.guided_pdf / mixture.total : 0.0;
  guide.matched = GUIDE_BUCKET > 1u && best > 0.0;
  guide.slot = cell.first + (guide.matched ? best_slot : least_slot) % GUIDE_BUCKET;
  guide.slot_check = cell.check;
  guide.slot_part = mixture.total > 0.0 ? best_part / mixture.total : 0.0;
  guide.slot_worth = least;
}

vec3 sample_direction(PathVertex v, bool first, bool last, inout uint rng, out vec3 direction) {
  guide.cell = first ? find_cache_cell(v.position, v.normal) : next_cell;
  guide.cell_frames = guide.cell.entry != kNoIndex ? guide_cache[guide.cell.entry + kCacheCount] & 0xffffu : 0u;
  guide.last = last;
  guide.chosen = kNoIndex;
  GuideMixture mixture;
  VmfLobe chosen;
  float chosen_part;
  bool moved = (frame.guide_flags & kGuidePrevious) != 0u && v.previous != v.position;
  load_mixture(v, last, moved, rng, mixture, chosen, chosen_part);
  guide.mean_score = mixture.all / float(kGuideLobes);
  guide.has_lobes = mixture.total > 0.0;
  guide.share = guide.has_lobes ? learnt_share(guide.cell) : 0.0;

  mat3 to_world = frame_about(v.shading_normal);
  vec3 view = v.view * to_world;
  bool guided = rng_uniform(rng) < guide.share;
  vec3 u = vec3(rng_uniform(rng), rng_uniform(rng), rng_uniform(rng));
  vec3 local;
  if (guided) {
    direction = vmf_sample(chosen.mu, chosen.kappa, u.xy);
    local = direction * to_world;
    guide.chosen_part = chosen_part / mixture.total;
  } else {
    guide.chosen = kNoIndex;
    if (FEATURE_SPECULAR) bsdf_sample(v.bsdf, view, u, local);
    else local = sample_cosine_hemisphere(u.xy);
    direction = to_world * local;
  }

  uint home = moved ? 0u : min(uint(rng_uniform(rng) * float(GUIDE_ACCESSES)), GUIDE_ACCESSES - 1u);
  weigh_direction(mixture, direction, home);

  vec3 f;
  if (FEATURE_SPECULAR) {
    guide.bsdf_pdf = bsdf_pdf(v.bsdf, view, local);
    f = bsdf_eval(v.bsdf, view, local);
  } else {
    guide.bsdf_pdf = pdf_cosine_hemisphere(local);
    f = v.bsdf.albedo * guide.bsdf_pdf;
  }
  guide.pdf = guide.share * guide.guided_pdf + (1.0 - guide.share) * guide.bsdf_pdf;
  guide.below = !(dot(direction, v.normal) > 0.0);
  bool counts = guide.pdf > 0.0 && !guide.below && local.z > 0.0;
  return counts ? f / guide.pdf : vec3(0.0);
}

void store_guide_state(GuideState s, uint at, uint proposal) {
  if (isnan(s.weight) || isinf(s.weight) || any(isnan(s.target)) || any(isinf(s.target))) {
    atomicAdd(counters[kCounterGuideNan], 1u);
    return;
  }
  uvec4 words = pack_guide_state(s);
  uvec2 motion = pack_guide_motion(s);
  if (GUIDE_RESOLVE) {
    guide_proposals[proposal * 2u] = words;
    guide_proposals[proposal * 2u + 1u] = uvec4(motion, at, 0u);
    atomicMax(guide_cache[guide_winner_at() + at], proposal_rank(proposal));
  } else {
    guide_states[at] = words;
    store_guide_motion(at, motion);
  }
}

// How much larger the second moment of an estimate of that light is than its square, about.
float reflected_moment() {
  vec4 m = cached_moments(next_cell.entry);
  float least = min(min(m.x, m.y), min(m.z, m.w));
  return least > 0.0 ? max(least, 1.0) : 2.0;
}

// Adds a sample to the cache's cell and to the second moments of every probability of guiding. `emitted` and
// `reflected`: f / pdf times light from the hit; the latter will be an estimate, whose own second moment counts.
void train_cell(PathVertex v, vec3 direction, vec3 incoming, float emitted, float reflected, inout uint rng) {
  CacheCell cell = guide.cell;
  if (cell.entry == kNoIndex) {
    claim_cache(cell);
    return;
  }
  uint entry = cell.entry;
  float u = rng_uniform(rng);
  list_touched(entry, atomicAdd(guide_cache[entry + kCacheTouched], 1u));
  vec3 sum = incoming * (max(dot(direction, v.normal), 0.0) / (kPiShared * guide.pdf));
  for (uint i = 0u; i < 3u; ++i) {
    uint x = to_fixed(sum[i], kCacheFixed, kCacheLargest, u);
    if (x != 0u) atomicAdd(guide_cache[entry + kCacheSum + i], x);
  }
  float scale = luminance(v.bsdf.albedo) * luminance(cached_reflection(entry));
  if (!guide.has_lobes || !(scale > 0.0)) return;
  float e = emitted / scale, r = reflected / scale;
  float second = e * (e + 2.0 * r) + (r > 0.0 ? r * r * reflected_moment() : 0.0);
  vec4 p = guide_shares() * guide.guided_pdf + (1.0 - guide_shares()) * guide.bsdf_pdf;
  vec4 m = (second * guide.pdf) / p;
  for (uint i = 0u; i < 4u; ++i) {
    uint x = to_fixed(m[i], kMomentFixed, kMomentLargest, u);
    if (x != 0u) atomicAdd(guide_cache[entry + kCacheMomentSum + i], x);
  }
}

// Adds light that was looked for to the cache's cell; the sample is counted where the path's own direction trains it.
void found_lights(vec3 irradiance, inout uint rng) {
  if (guide.cell.entry == kNoIndex || guide.pdf == 0.0 || irradiance == vec3(0.0)) return;
  float u = rng_uniform(rng);
  for (uint i = 0u; i < 3u; ++i) {
    uint x = to_fixed(irradiance[i], kCacheFixed, kCacheLargest, u);
    if (x != 0u) atomicAdd(guide_cache[guide.cell.entry + kCacheSum + i], x);
  }
}

// A direction below the surface: a sample of zero, without which the cell's means would be those of the others.
void path_wasted() {
  uint entry = guide.cell.entry;
  if (guide.below && entry != kNoIndex) list_touched(entry, atomicAdd(guide_cache[entry + kCacheTouched], 1u));
}

void look_at_next(Surface s, inout uint rng) { next_cell = find_cache_cell(s.position, s.normal); }

// Light that leaves the next vertex by reflection, by the cache. A path that ends there must not lack it (nor must the
// cache, which learns from such paths): a place of which nothing is known is thought to be lit like the one that sees it.
vec3 reflected_there(Surface s) {
  uint entry = next_cell.entry;
  if (PATH_TAIL && (entry == kNoIndex || cache_frames(entry) < kTailFrames)) entry = guide.cell.entry;
  bool known = entry != kNoIndex && (frame.guide_flags & kGuideUseCache) != 0u;
  return known ? s.bsdf.albedo * cached_reflection(entry) : vec3(0.0);
}

// Known well enough to stand for all light that the next vertex reflects: where it is not, the path goes on.
bool ends_at_next() {
  uint a = next_cell.entry, b = guide.cell.entry;
  return (a != kNoIndex && cache_frames(a) >= kTailFrames) || (b != kNoIndex && cache_frames(b) >= kTailFrames);
}

const uint kYoungFrames = 32u;
const uint kManyPaths = 16u;  // of a pixel: a share of them is enough, and a cell's sums have no room for all
bool is_new_here() {
  return frame.spp <= kManyPaths && (guide.cell.entry == kNoIndex || guide.cell_frames < kYoungFrames);
}

bool is_discovery() { return guide.chosen == kNoIndex && !guide.matched; }

// What the ray met: `emission` there and, unless the path ends, light that is `reflected` there. Trains the vertex's
// cell of the cache and a state.
void path_hit(PathVertex v, vec3 direction, vec3 weight, vec3 emission, vec3 reflected, vec3 hit_position, vec3 velocity,
              bool trains, uint proposal, inout uint rng) {
  float emitted = luminance(weight * emission);
  float score = emitted + luminance(weight * reflected);  // f / pdf
  if (isnan(score) || isinf(score)) return;
  if (trains) train_cell(v, direction, emission + reflected, emitted, score - emitted, rng);

  bool share_score = (frame.guide_flags & kGuideShareScore) != 0u;
  GuideState s;
  float value;
  if (GUIDE_BUCKET == 1u) {  // as in the paper
    if (rng_uniform(rng) * guide.mean_score >= score) return;
    if (guide.chosen != kNoIndex) s = load_guide_state(guide.chosen);
    else s = empty_guide_state();
    value = score;
    GuideCell cell = guide_cell(v.position, v.normal, rng_uniform(guide_rng) < frame.guide_grid.z);
    guide.slot = cell.first;
    guide.slot_check = cell.check;
  } else if (guide.matched) {
    // At a path's end reflected light counts for nothing: a state that aims at it is left alone.
    s = load_guide_state(guide.slot);
    if (guide.last && emitted == 0.0 && s.emissive <= 0.5) return;
    value = score * (share_score ? guide.slot_part * guide.share : 1.0);
  } else {
    if (!(score > 0.0)) return;
    if (guide.chosen != kNoIndex) {
      s = load_guide_state(guide.chosen);
      value = score * (share_score ? guide.chosen_part * guide.share : 1.0);
    } else {
      // Nothing is known of it but one point that is seen: as much light as if it filled the prior's lobe.
      s = empty_guide_state();
      s.target = hit_position;
      float peak = vmf_normalization(vmf_kappa(view_state(s, hit_position - v.position, v.normal).spread));
      value = score * (share_score ? guide.pdf / (peak + guide.bsdf_pdf) : 1.0);
    }
    float narrow = vmf_normalization(vmf_kappa(view_state(s, s.target - v.position, v.normal).spread));
    if (rng_uniform(rng) * guide.slot_worth >= value * value * narrow) return;
  }
  vec3 expected = predicted_target(s);
  vec3 to_target = (s.count > 0u ? expected : hit_position) - v.position;
  if (!(dot(to_target, to_target) > 1e-6)) return;
  float scale = view_state(s, to_target, v.normal).scale;
  bool seen = score > 0.0 && value >= 0.1 * s.weight * scale;
  // The light is gone: nothing where it should be, and nobody saw it in the former frame (Alber 2025, Section 5).
  bool lost = (frame.guide_flags & kGuideLoss) != 0u && guide.matched && guide.near && value < 0.02 * s.weight * scale && guide_age(s) > 1u;
  if (seen) s.target = expected;
  s = update_guide_state(s, v.position, hit_position, value / scale, score > 0.0 ? emitted / score : 0.0, frame.guide_learn.y,
                         frame.guide_learn.z, (frame.guide_flags & kGuideInWorld) != 0u);
  if (lost) s.weight = 0.0;
  if (seen) {
    s.time = frame.guide_frame & 0xffffu;
    s.velocity = velocity;
  }
  s.check = guide.slot_check;
  store_guide_state(s, guide.slot, proposal);
}
#endif
