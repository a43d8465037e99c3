// Steps `learning` and `record`: what paths meet teaches the fields, as one application of light's transport to those
// of the former frames (Eq. 8, 9, 12 and 13; Algorithm 2).
//
// A vertex counts where it sent a direction on, useful or not. Algorithms 1 and 2 are printed with counters of all
// vertices: ends of paths, which bring nothing reflected, would darken the fields.
#ifndef FB_PSTF_LEARN
#define FB_PSTF_LEARN
#include "estimators/pstf/steps/guidance.glsl"
#include "lib/incident.glsl"
#include "shared/color.h"

const bool kLearns = true;
const bool kFollowsMotion = false;
const bool kRecords = true;

const float kTaughtMuch = 512.0;  // samples

// A cell that has none asks for one; of many samples a share is taken. True: this one is.
bool takes_sample(CellPlace place, float crowd, float taught, Path path, uint bits) {
  if (place.slot == kNoIndex) {
    if (place.claim == kNoIndex) return false;
    atomicMax(pstf_sums.at[pstf_claim_at(place.claim)], place.check);
    list_cell(place.claim, atomicOr(pstf_sums.at[pstf_samples_at(place.claim)], kPstfClaimed));
    return false;
  }
  return (path.own.teaches || taught < kTaughtMuch) && rng_uniform(bits) * crowd < float(pstf.pstf_samples);
}

vec3 held(vec3 light) {
  float most = max(light.r, max(light.g, light.b));
  return most <= kPstfLargest ? max(light, vec3(0.0)) : most > kPstfLargest ? light * (kPstfLargest / most) : vec3(0.0);
}

// A sample, in the order of a cell's sums and in their steps.
struct Lesson {
  float words[kPstfSumWords];
};
void set_light(inout Lesson l, uint word, vec3 light, vec3 axis) {
  vec3 c = ycocg_from_rgb(light) * kPstfSteps;
  l.words[word] = c.x;
  for (uint i = 0u; i < 3u; ++i) l.words[word + 1u + i] = c.x * axis[i];
  l.words[word + 4u] = c.y;
  l.words[word + 5u] = c.z;
}
// `outgoing`: over reflectance; `straight`: its part that came without a reflection between.
void set_outgoing(inout Lesson l, vec3 outgoing, vec3 straight, vec3 normal) {
  vec3 light = held(outgoing);
  set_light(l, 0u, light, normal);
  for (uint i = 0u; i < 3u; ++i) l.words[kPstfSumNormal + i] = normal[i] * kPstfSteps;
  float y = ycocg_from_rgb(light).x;
  l.words[kPstfSumStraight] = min(ycocg_from_rgb(held(straight)).x, y) * kPstfSteps;
  l.words[kPstfSumSecond] = min(y * y, kPstfMomentLargest) * kPstfMomentSteps;
}
// `incident` as a white Lambert surface reflects it, over the density of its direction; `reflected` by this surface.
void set_incident(inout Lesson l, Guidance g, vec3 incident, vec3 reflected, vec3 direction) {
  vec3 light = held(incident);
  set_light(l, kPstfSumIncident, light, direction);
  float scale = luminance(g.reflectance) * g.luminance,
        relative = TWO_LEVEL ? luminance(held(reflected)) / max(scale, 1e-20) : ycocg_from_rgb(light).x / g.luminance,
        off = g.luminance > 0.0 && (!TWO_LEVEL || scale > 0.0) ? relative - 1.0 : 0.0,
        control = g.luminance > 0.0 ? g.off : 0.0;
  vec3 moments = clamp(vec3(off * control, control * control, off * off), -kPstfMomentLargest, kPstfMomentLargest);
  for (uint i = 0u; i < 3u; ++i) l.words[kPstfSumMoments + i] = moments[i] * kPstfMomentSteps;
  l.words[kPstfSumDirected] = 1.0;
}

// Of what a cell knows nothing of: its part of the world.
void place_cell(uint slot, uint region, float taught, bool takes) {
  if (takes && taught == 0.0 && region != 0u) atomicMax(pstf_sums.at[pstf_sums_at(slot) + kPstfSumRegion], region);
}

// Lanes are in the loop only as long as one has words to add: lavapipe would run all of them through it otherwise.
void teach(uint slot, Lesson l, bool takes, uint bits) {
  uint sums = takes ? pstf_sums_at(slot) : 0u, count = takes ? kPstfSumRegion : 0u, i = 0u;
  if (takes) list_cell(slot, atomicAdd(pstf_sums.at[pstf_samples_at(slot)], 1u));
  do {
    uint x = i < count ? fixed_point(l.words[i], 1.0, -kPstfLargest * kPstfSteps, kPstfLargest * kPstfSteps,
                                     rng_uniform(bits))
                       : 0u;
    if (x != 0u) atomicAdd(pstf_sums.at[sums + i], x);
  } while (++i < count);
}

// Light that a vertex reflects over its reflectance; `white` in channels of which it reflects next to nothing.
vec3 over_reflectance(vec3 reflected, vec3 reflectance, vec3 white) {
  return mix(white, reflected / max(reflectance, vec3(1e-6)), greaterThan(reflectance, vec3(1e-3)));
}

// The path's last reflection, of several: nothing that is reflected comes from there.
bool is_end(Path path) { return path.last && path.most > 1u; }
bool teaches_here(Path path) {
  return (!is_end(path) || pstf.pstf_ends != 0) && (!kPredicts || pstf.pstf_progressive != 0);
}

void learn_direct(Guidance g, Direct direct, Path path, inout uint rng) {}

void learn_waste(Guidance g, Path path) {
  uint bits = rng_seed(path.number, path.depth, frame.frame, frame.seed ^ 0x5be0cd19u);
  if (g.pdf == 0.0 || g.prediction.scale == 0.0 || !teaches_here(path)) return;
  bool takes = takes_sample(g.place, g.crowd, g.taught, path, rng_next(bits));
  Lesson l;
  vec3 straight = over_reflectance(path.own.looked_for, g.reflectance, vec3(0.0));
  set_outgoing(l, straight, straight, g.normal);
  set_incident(l, g, vec3(0.0), vec3(0.0), vec3(0.0));
  place_cell(g.place.slot, region_about(path.own.from), g.taught, takes);
  teach(g.place.slot, l, takes, bits);
}

void learn_hit(Vertex v, inout Guidance g, Proposal p, Incident incident, inout Path path, inout uint rng) {
  uint bits = rng_next(rng);
  bool takes = g.pdf > 0.0 && teaches_here(path) && takes_sample(g.place, g.crowd, g.taught, path, rng_next(bits));
  vec3 met = incident.emission + incident.reflection, white = met * g.over;
  Lesson l;
  vec3 straight =
      over_reflectance(g.weight * incident.emission + path.own.looked_for, g.reflectance, incident.emission * g.over);
  set_outgoing(l, over_reflectance(g.weight * met + path.own.looked_for, g.reflectance, white), straight, g.normal);
  set_incident(l, g, white, g.weight * met, p.direction);
  place_cell(g.place.slot, region_about(v.position), g.taught, takes);
  teach(g.place.slot, l, takes, bits);
  if (kHasTrees && takes)
    teach_directions(g.place.slot, g.tree, p.direction, luminance(held(g.weight * met)), rng_next(bits));
}

void learn_last(Field here, Direct direct, Path path, inout uint rng) {
  if (pstf.pstf_ends == 0 || !teaches_here(path) || here.place.slot == kNoIndex) return;
  uint bits = rng_next(rng);
  vec2 counts = uintBitsToFloat(pstf_texel(here.place.slot, 0u).zw);
  bool takes = takes_sample(here.place, counts.x, counts.y, path, rng_next(bits));
  Lesson l;
  for (uint i = 0u; i < kPstfSumWords; ++i) l.words[i] = 0.0;
  set_outgoing(l, direct.irradiance, direct.irradiance, here.normal);
  teach(here.place.slot, l, takes, bits);
}

// The path's light as its first vertex reflects it, without what was predicted there.
void add_to_tail(inout Path path, vec3 light, bool scaled) {
  if (path.own.first.scale > 0.0) path.own.first.tail += scaled ? light / path.own.first.scale : light;
}

// Before the same vertex learns what its own direction met.
void record_direct(inout Path path, Vertex v, Guidance g, Direct direct, vec3 throughput) {
  path.own.looked_for = kPredicts && path.depth == 0u ? g.prediction.found : direct.radiance;
  if (kPredicts) add_to_tail(path, throughput * path.own.looked_for, path.depth > 0u);
}
void record_hit(inout Path path, Vertex v, Guidance g, Proposal p, Incident incident, vec3 throughput) {
  if (kPredicts) add_to_tail(path, throughput * p.weight * incident.emission, true);
}
void record_last(inout Path path, Vertex v, Direct direct, vec3 throughput) {
  if (kPredicts) add_to_tail(path, throughput * direct.radiance, true);
}
// Without progression: a first vertex teaches all that its path brought.
void record_path(Path path, vec3 sum, inout uint rng) {
  if (!kPredicts || pstf.pstf_progressive != 0) return;
  FirstVertex first = path.own.first;
  uint bits = rng_next(rng);
  bool takes = first.scale > 0.0 && takes_sample(first.place, first.crowd, 0.0, path, rng_next(bits));
  Lesson l;
  for (uint i = 0u; i < kPstfSumWords; ++i) l.words[i] = 0.0;
  vec3 all = over_reflectance(first.tail, first.reflectance, vec3(0.0));
  set_outgoing(l, all, all, first.normal);
  if (first.place.slot != kNoIndex)
    place_cell(first.place.slot, first.region, uintBitsToFloat(pstf_texel(first.place.slot, 0u).w), takes);
  teach(first.place.slot, l, takes, bits);
}
void record_none(uvec2 block, uvec2 pixel) {}
#endif
