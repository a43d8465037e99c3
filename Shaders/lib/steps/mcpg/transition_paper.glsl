// Which state learns from a sample, and of what score: the paper's transition (Alber 2025, Alg. 3 lines 1 to 3, eq. 8), for
// cells of one state.
#ifndef FB_MCPG_TRANSITION_PAPER
#define FB_MCPG_TRANSITION_PAPER
#include "lib/steps/mcpg/transition.glsl"

bool paper_transition(Vertex v, Guidance g, float score, inout uint group_rng, inout uint rng, out Transition t) {
  t.matched = t.near = false;
  if (rng_uniform(rng) * (g.all / float(kGuideLobes)) >= score) return false;
  if (g.choice.state != kNoIndex) t.state = load_guide_state(g.choice.state);
  else t.state = empty_guide_state();
  t.value = score;
  bool adaptive = rng_uniform(group_rng) < guide.mc_adaptive;
  uint access = min(uint(rng_uniform(group_rng) * float(GUIDE_ACCESSES)), GUIDE_ACCESSES - 1u);
  GuideCell cell = guide_cell(v.position, scatter_axis(v.scatter), adaptive, access, group_rng);
  t.slot = cell.first;
  t.check = cell.check;
  return true;
}
#endif
