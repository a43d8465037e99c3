// Which state learns from a sample, and of what score: the paper's transition (Alber 2025, Alg. 3 lines 1 to 3, eq. 8),
// for cells of one state.
#ifndef FB_MCPG_TRANSITION_PAPER
#define FB_MCPG_TRANSITION_PAPER
#include "estimators/mcpg/steps/transition.glsl"

bool paper_transition(Vertex v, Guidance g, vec3 direction, float score, inout uint group_rng, inout uint rng,
                      out Transition t) {
  bool guided = g.choice.state != kNoIndex;
  t.matched = guided;
  t.near = guided && vmf_one_minus_cosine(g.choice.lobe.mu, direction) * g.choice.lobe.kappa < 1.0;
  t.value = score;
  if (guided)
    t.state = load_guide_state(g.choice.state);
  else
    t.state = empty_guide_state();
  if (rng_uniform(rng) * (g.all / float(kGuideLobes)) >= score) {
    // Not accepted: at most it says that the state's own light is gone.
    t.slot = g.choice.state;
    t.check = t.state.check;
    vec3 to_light = predicted_target(t.state) - v.position;
    return t.near && dot(to_light, to_light) > 1e-6 && is_lost(t, view_state(t.state, to_light, v.scatter).scale);
  }
  bool adaptive = rng_uniform(group_rng) < guide.mc_adaptive;
  uint access = min(uint(rng_uniform(group_rng) * float(GUIDE_ACCESSES)), GUIDE_ACCESSES - 1u);
  GuideCell cell = guide_cell(v.position, v.scatter, adaptive, access, group_rng);
  t.slot = cell.first;
  t.check = cell.check;
  return true;
}
#endif
