// Step `learning`: what a path met trains the irradiance cache and, by maximum likelihood (Alber 2025, Alg. 3), a
// state.
//
// Beyond the paper: only a share of the paths trains where much is known, to save time; an emitter that is new is never
// passed by.
#ifndef FB_MCPG_LEARN
#define FB_MCPG_LEARN
#include "estimators/mcpg/steps/train_cache.glsl"
#include "estimators/mcpg/steps/transition_buckets.glsl"
#include "estimators/mcpg/steps/transition_paper.glsl"
#include "lib/place_of_light.glsl"

const bool kLearns = true;
const bool kFollowsMotion = true;

const uint kYoungFrames = 32u;
const uint kManyPaths = 16u;  // of a pixel: a share of them is enough, and a cell's sums have no room for all

// Little is known at the vertex yet, or it is this path's turn.
bool trains_here(Guidance g, Path path) {
  if (!GUIDES) return false;
  return path.own.guided.trains ||
         (frame.spp <= kManyPaths && (g.cache.entry == kNoIndex || g.cache_frames < kYoungFrames));
}

// Light that was looked for goes into the cell; the sample is counted where the path's own direction trains it.
void learn_direct(Guidance g, Direct direct, Path path, inout uint rng) {
  if (!trains_here(g, path)) return;
  if (g.cache.entry == kNoIndex || g.pdf == 0.0 || direct.irradiance == vec3(0.0)) return;
  add_to_cache(g.cache.entry, direct.irradiance, rng_uniform(rng));
}

// A last vertex is of use to its cell alone: the one sample that has all light there.
void learn_last(Field here, Direct direct, Path path, inout uint rng) {
  if (!GUIDES) return;
  uint entry = here.cell.entry;
  if (!path.own.guided.trains && (frame.spp > kManyPaths || (entry != kNoIndex && cache_frames(entry) >= kYoungFrames)))
    return;
  if (entry == kNoIndex) {
    claim_cache(here.cell);
    return;
  }
  list_touched(entry, atomicAdd(guide_cache.at[entry + kCacheTouched], 1u));
  add_to_cache(entry, direct.irradiance, rng_uniform(rng));
}

// A direction below the surface: a sample of zero, without which the cell's means would be those of the others.
void learn_waste(Guidance g, Path path) {
  uint entry = g.cache.entry;
  if (trains_here(g, path) && g.below && entry != kNoIndex)
    list_touched(entry, atomicAdd(guide_cache.at[entry + kCacheTouched], 1u));
}

vec3 hit_velocity(Hit hit, vec3 position) {
  if (hit.instance == kNoIndex || (instance_at(hit.instance).flags & kInstanceMoves) == 0u) return vec3(0.0);
  return (position - previous_position(hit)) / max(frame.time - frame.prev_time, 1e-4);
}

// Folds the sample into the state of a transition, and stores it. `bent`: the light came by way of an interface, where
// a miss does not tell that it is gone: waves send it elsewhere a unit further on.
void update_state(Vertex v, Transition t, vec3 hit_position, vec3 velocity, bool bent, float score, float emitted,
                  uint proposal) {
  GuideState s = t.state;
  vec3 expected = predicted_target(s);
  vec3 to_target = (s.count > 0u ? expected : hit_position) - v.position;
  if (!(dot(to_target, to_target) > 1e-6)) return;
  float scale = view_state(s, to_target, v.scatter).scale;
  bool seen = score > 0.0 && (t.value >= 0.1 * s.weight * scale || guide.mc_paper != 0);
  bool lost = !bent && is_lost(t, scale);
  if (seen) s.target = expected;
  s = update_guide_state(s, v.position, hit_position, t.value / scale, score > 0.0 ? emitted / score : 0.0,
                         guide.mc_alpha, float(guide.mc_count), guide.mc_in_world != 0);
  if (lost) s.weight = 0.0;
  if (seen) {
    s.time = guide.frame_number & 0xffffu;
    s.velocity = velocity;
  }
  s.check = t.check;
  store_guide_state(s, t.slot, proposal, seen);
}

// What trains at a vertex besides what its path met; the technique defines it.
void learn_besides(Vertex v, Guidance g, Path path, inout uint rng);

void learn_hit(Vertex v, inout Guidance g, Proposal p, Incident incident, inout Path path, inout uint rng) {
  if (!GUIDES) return;
  bool trains = trains_here(g, path);
  if (trains) learn_besides(v, g, path, rng);
  bool is_new = g.choice.state == kNoIndex && !g.slot.matched && incident.emission != vec3(0.0);
  if (!trains && !is_new) return;
  vec3 position = place_of_light(incident, p.direction, guide.mc_apparent != 0);
  vec3 velocity = incident.way.bent ? vec3(0.0) : hit_velocity(incident.way.hit, position);

  float emitted = luminance(p.weight * incident.emission);
  float score = emitted + luminance(p.weight * incident.reflection);  // f / pdf
  if (isnan(score) || isinf(score)) return;
  if (trains) train_cell(v, g, p.direction, incident, emitted, score - emitted, rng);

  Transition t;
  bool accepted;
  if (GUIDE_BUCKET == 1u)
    accepted = paper_transition(v, g, p.direction, score, path.own.guided.group_rng, rng, t);
  else
    accepted = bucket_transition(v, g, position, score, emitted, rng, t);
  if (accepted) update_state(v, t, position, velocity, incident.way.bent, score, emitted, vertex_number(path));
}
#endif
