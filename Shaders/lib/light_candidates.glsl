// Candidates of which a vertex chooses one light to look for: some are drawn of the lamps that rays from hereabouts
// found in past frames (shared/seen_grid.h), the others of the whole list.
#ifndef FB_LIB_LIGHT_CANDIDATES
#define FB_LIB_LIGHT_CANDIDATES
#include "lib/lights.glsl"
#include "lib/seen_grid.glsl"

// How many there are (r_nee_candidates), and how many of them remembered lamps have (r_nee_remembered). The technique
// defines them, from its constants.
uint light_candidates();
uint remembered_candidates();
// Whether they are weighed by what arrived between two places (r_nee_visibility), and by which table of it.
bool knows_ways();
uint known_ways();

struct Candidates {
  SeenLamps lamps;
  uint filled;  // names in it; 0: none, or nothing is asked of them
  uint own;     // candidates of theirs
};

Candidates candidates_of(uint cell) {
  Candidates c;
  c.lamps = seen_lamps(cell);
  c.filled = remembered_candidates() > 0u ? kSeenLamps - times_seen(c.lamps, 0u) : 0u;
  c.own = c.filled > 0u ? min(remembered_candidates(), light_candidates() - 1u) : 0u;
  return c;
}

// The i-th of them; false: its lamp has gone out.
bool draw_candidate(Candidates c, uint i, inout uint rng, out GpuLight light) {
  if (i >= c.own) {
    light = sample_light(rng);
    return true;
  }
  GpuLamp lamp = lamp_at(seen_name(c.lamps, random_below(c.filled, rng)) - 1u);
  light = sample_lamp(lamp, rng);
  return lamp.count > 0u;
}

float times_remembered(Candidates c, GpuLight light) {
  uint name = light.lamp & 0xffffu;
  return name == 0u ? 0.0 : float(times_seen(c.lamps, name));
}

// How many of the candidates are expected to be this light.
float draws_of(Candidates c, GpuLight light) {
  float own = probability_in_lamp(light) * times_remembered(c, light) / float(max(c.filled, 1u));
  return (float(light_candidates()) - float(c.own)) * light_probability(light) + float(c.own) * own;
}

// Density of the candidates where a ray met something; 0: it is not in the list.
float hit_light_pdf(uint cell, Hit hit, vec3 direction) {
  if (!has_lights() || hit.instance == kNoIndex) return 0.0;
  uint first = first_light_of(hit.instance);
  if (first == kNoIndex) return 0.0;
  return draws_of(candidates_of(cell), light_at(first + hit.triangle)) *
         triangle_pdf(world_triangle(hit.instance, hit.triangle), hit.t, direction);
}

// How much of a lamp's light arrives, it is supposed, where a full memory does not have it.
const float kUnseen = 0.5;

float hope_of(Candidates c, GpuLight light, uint way) {
  float hoped = times_remembered(c, light) > 0.0 ? 1.0 : mix(1.0, kUnseen, float(c.filled) / float(kSeenLamps));
  return knows_ways() ? seen_hope(seen_way_entry(known_ways(), way), hoped) : hoped;
}

// A ray went that way.
void count_way(uint way, bool met) {
  if (!knows_ways()) return;
  uint word = way_words(1u - known_ways(), way);
  atomicAdd(seen_words.at[word], 1u);
  if (met) atomicAdd(seen_words.at[word + 1u], 1u);
}

// A ray found a lamp's light, the sum of whose channels is `brought`.
void remember_lamp(uint cell, uint name, float brought, inout uint rng) {
  if (name != 0u && brought > 0.0)
    atomicMax(seen_words.at[kSeenFoundWords + cell], lamp_found(name, brought, rng_uniform(rng)));
}
#endif
