// How a sample teaches a cell.
#ifndef FB_PSTF_TEACH
#define FB_PSTF_TEACH
#include "estimators/pstf/steps/cells.glsl"
#include "shared/color.h"

const float kTaughtMuch = 512.0;  // samples

// A cell that has none asks for one; of many samples a share is taken. True: this one is.
bool takes_sample(CellPlace place, float crowd, float taught, bool teaches, uint bits) {
  if (place.slot == kNoIndex) {
    if (place.claim == kNoIndex) return false;
    atomicMax(pstf_sums.at[pstf_claim_at(place.claim)], place.check);
    list_cell(place.claim, atomicOr(pstf_sums.at[pstf_samples_at(place.claim)], kPstfClaimed));
    return false;
  }
  return (teaches || taught < kTaughtMuch) && rng_uniform(bits) * crowd < float(pstf.pstf_samples);
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
// `incident` as a white Lambert surface reflects it, over the density of its direction; `off`: its estimate over the
// cell's mean, less one; `control`: of the control variate, whose mean is zero.
void set_incident(inout Lesson l, vec3 incident, vec3 direction, float off, float control) {
  set_light(l, kPstfSumIncident, held(incident), direction);
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
#endif
