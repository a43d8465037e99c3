// Which state learns from a sample, and of what score, for cells of several states. Beyond the paper: the sample goes
// to the lobe of the cell that explains it, or else takes the least one's place; a score is a lobe's share of the
// energy.
#ifndef FB_MCPG_TRANSITION_BUCKETS
#define FB_MCPG_TRANSITION_BUCKETS
#include "estimators/mcpg/steps/transition.glsl"

// Where guiding does not pay now a state's score still says what its lobe could bring: at a share of zero it would be
// zero, and the cell would lose what it knows.
const float kLeastScoreShare = 0.1;

bool bucket_transition(Vertex v, Guidance g, vec3 hit_position, float score, float emitted, inout uint rng,
                       out Transition t) {
  GuideSlot slot = g.slot;
  bool share_score = guide.mc_share_score != 0;
  float share = max(g.share, kLeastScoreShare);
  t.slot = slot.at;
  t.check = slot.check;
  t.matched = slot.matched;
  t.near = slot.near;
  if (slot.matched) {
    // At a path's end reflected light counts for nothing: a state that aims at it is left alone.
    t.state = load_guide_state(slot.at);
    if (g.last && emitted == 0.0 && t.state.emissive <= 0.5) return false;
    t.value = score * (share_score ? slot.part * share : 1.0);
    return true;
  }
  if (!(score > 0.0)) return false;
  if (g.choice.state != kNoIndex) {
    t.state = load_guide_state(g.choice.state);
    t.value = score * (share_score ? g.choice.part / g.total * share : 1.0);
  } else {
    // Nothing is known of it but one point that is seen: as much light as if it filled the prior's lobe.
    t.state = empty_guide_state();
    t.state.target = hit_position;
    float peak = vmf_normalization(vmf_kappa(view_state(t.state, hit_position - v.position, v.scatter).spread));
    t.value = score * (share_score ? g.pdf / (peak + g.bsdf_pdf) : 1.0);
  }
  float narrow = vmf_normalization(vmf_kappa(view_state(t.state, t.state.target - v.position, v.scatter).spread));
  return !(rng_uniform(rng) * slot.worth >= t.value * t.value * narrow);
}
#endif
