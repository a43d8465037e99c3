// Which state learns from a sample, and of what score, for cells of several states. Beyond the paper: the sample goes to the
// lobe of the cell that explains it, or else takes the least one's place; a score is a lobe's share of the energy.
#ifndef FB_MCPG_TRANSITION_BUCKETS
#define FB_MCPG_TRANSITION_BUCKETS
#include "estimators/mcpg/transition.glsl"

const float kMatch = 0.02;  // a direction belongs to a lobe whose pdf there is at least this share of its peak

// The slot of the home cell whose lobe explains the direction best, or else the one that is worth least.
struct GuideSlot {
  uint at, check;
  bool matched, near;  // as in Transition
  float part;          // weight in the mixture, if matched
  float worth;         // of the least one
};

GuideSlot find_slot(Guidance g, vec3 direction) {
  float best = 0.0, least = 3e38, best_part = 0.0;
  uint best_slot = 0u, least_slot = 0u;
  GuideSlot slot;
  slot.near = false;
  [[unroll]] for (uint i = 0u; i < kGuideLobes; ++i) {
    VmfLobe lobe = g.lobes[i];
    vec2 weight = g.weights[i];
    float t = vmf_one_minus_cosine(lobe.mu, direction) * lobe.kappa;
    float e = exp(-t), p = e * lobe.scale * weight.x;
    bool here = i / GUIDE_BUCKET == g.home;
    float fit = e > kMatch ? max(p, e * 1e-30) : 0.0;
    if (here && weight.y > 0.0 && fit > best) {
      best = fit;
      best_slot = i;
      best_part = weight.x;
      slot.near = t < 1.0;
    }
    // Light that no lobe stands for is found by the BSDF alone: its second moment is what a slot is worth.
    float worth = weight.y * weight.y * lobe.scale;
    if (here && worth < least) {
      least = worth;
      least_slot = i;
    }
  }
  GuideCell cell = g.cells[0];
  [[unroll]] for (uint a = 1u; a < GUIDE_ACCESSES; ++a) {
    if (a == g.home) cell = g.cells[a];
  }
  slot.matched = GUIDE_BUCKET > 1u && best > 0.0;
  slot.at = cell.first + (slot.matched ? best_slot : least_slot) % GUIDE_BUCKET;
  slot.check = cell.check;
  slot.part = g.total > 0.0 ? best_part / g.total : 0.0;
  slot.worth = least;
  return slot;
}

bool bucket_transition(Vertex v, Guidance g, GuideSlot slot, vec3 hit_position, float score, float emitted, inout uint rng,
                       out Transition t) {
  bool share_score = (frame.guide_flags & kGuideShareScore) != 0u;
  t.slot = slot.at;
  t.check = slot.check;
  t.matched = slot.matched;
  t.near = slot.near;
  if (slot.matched) {
    // At a path's end reflected light counts for nothing: a state that aims at it is left alone.
    t.state = load_guide_state(slot.at);
    if (g.last && emitted == 0.0 && t.state.emissive <= 0.5) return false;
    t.value = score * (share_score ? slot.part * g.share : 1.0);
    return true;
  }
  if (!(score > 0.0)) return false;
  if (g.choice.state != kNoIndex) {
    t.state = load_guide_state(g.choice.state);
    t.value = score * (share_score ? g.choice.part / g.total * g.share : 1.0);
  } else {
    // Nothing is known of it but one point that is seen: as much light as if it filled the prior's lobe.
    t.state = empty_guide_state();
    t.state.target = hit_position;
    float peak = vmf_normalization(vmf_kappa(view_state(t.state, hit_position - v.position, v.normal).spread));
    t.value = score * (share_score ? g.pdf / (peak + g.bsdf_pdf) : 1.0);
  }
  float narrow = vmf_normalization(vmf_kappa(view_state(t.state, t.state.target - v.position, v.normal).spread));
  return rng_uniform(rng) * slot.worth < t.value * t.value * narrow;
}
#endif
