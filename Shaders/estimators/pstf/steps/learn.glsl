// Steps `learning` and `record`: what paths meet teaches the fields, as one application of light's transport to those
// of the former frames (Eq. 8, 9, 12 and 13; Algorithm 2).
//
// A vertex counts where it sent a direction on, useful or not. Algorithms 1 and 2 are printed with counters of all
// vertices: ends of paths, which bring nothing reflected, would darken the fields.
#ifndef FB_PSTF_LEARN
#define FB_PSTF_LEARN
#include "estimators/pstf/steps/guidance.glsl"
#include "estimators/pstf/steps/teach.glsl"
#include "lib/incident.glsl"

const bool kLearns = true;
const bool kFollowsMotion = false;
const bool kRecords = true;

// Of the direction that was drawn: moments of its estimate and of the control variate's, over the mean.
void set_direction(inout Lesson l, Guidance g, vec3 incident, vec3 reflected, vec3 direction) {
  float scale = luminance(g.reflectance) * g.luminance, white = ycocg_from_rgb(held(incident)).x,
        relative = TWO_LEVEL ? luminance(held(reflected)) / max(scale, 1e-20) : white / g.luminance;
  bool known = g.luminance > 0.0 && (!TWO_LEVEL || scale > 0.0);
  set_incident(l, incident, direction, known ? relative - 1.0 : 0.0, g.luminance > 0.0 ? g.off : 0.0);
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
  bool takes = takes_sample(g.place, g.crowd, g.taught, path.own.teaches, rng_next(bits));
  Lesson l;
  vec3 straight = over_reflectance(path.own.looked_for, g.reflectance, vec3(0.0));
  set_outgoing(l, straight, straight, g.normal);
  set_direction(l, g, vec3(0.0), vec3(0.0), vec3(0.0));
  place_cell(g.place.slot, region_about(path.own.from), g.taught, takes);
  teach(g.place.slot, l, takes, bits);
}

void learn_hit(Vertex v, inout Guidance g, Proposal p, Incident incident, inout Path path, inout uint rng) {
  uint bits = rng_next(rng);
  bool takes =
      g.pdf > 0.0 && teaches_here(path) && takes_sample(g.place, g.crowd, g.taught, path.own.teaches, rng_next(bits));
  vec3 met = incident.emission + incident.reflection, white = met * g.over;
  Lesson l;
  vec3 straight =
      over_reflectance(g.weight * incident.emission + path.own.looked_for, g.reflectance, incident.emission * g.over);
  set_outgoing(l, over_reflectance(g.weight * met + path.own.looked_for, g.reflectance, white), straight, g.normal);
  set_direction(l, g, white, g.weight * met, p.direction);
  place_cell(g.place.slot, region_about(v.position), g.taught, takes);
  teach(g.place.slot, l, takes, bits);
  if (kHasTrees && takes)
    teach_directions(g.place.slot, g.tree, p.direction, luminance(held(g.weight * met)), rng_next(bits));
}

void learn_last(Field here, Direct direct, Path path, inout uint rng) {
  if (pstf.pstf_ends == 0 || !teaches_here(path) || here.place.slot == kNoIndex) return;
  uint bits = rng_next(rng);
  vec2 counts = uintBitsToFloat(pstf_texel(here.place.slot, 0u).zw);
  bool takes = takes_sample(here.place, counts.x, counts.y, path.own.teaches, rng_next(bits));
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
  bool takes = first.scale > 0.0 && takes_sample(first.place, first.crowd, 0.0, path.own.teaches, rng_next(bits));
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
