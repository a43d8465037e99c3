// What a transition of the Markov chain decides: which state learns from a sample, of what score, and where it is
// stored.
#ifndef FB_MCPG_TRANSITION
#define FB_MCPG_TRANSITION
#include "estimators/mcpg/steps/propose.glsl"

// Of what a state expects: less is nothing. The paper says "significantly smaller"; its is that of merian-quake's
// sources.
const float kLeastOfWeight = 0.02, kLeastOfWeightPaper = 0.001;

struct Transition {
  GuideState state;  // that learns
  float value;       // its score of the sample
  uint slot, check;  // where it is stored, for which cell
  bool matched;      // the state that is there explains the direction
  bool near;         // the direction is nearer to its lobe's mean than its mean cosine
};

// The light is gone: nothing where it should be, and nobody saw it in the former frame either (the paper's method: in
// this one; Alber 2025, Section 5). `scale`: of the state as it is seen from the vertex.
bool is_lost(Transition t, float scale) {
  uint lately = guide.mc_paper != 0 ? 0u : 1u;
  float least = guide.mc_paper != 0 ? kLeastOfWeightPaper : kLeastOfWeight;
  return guide.mc_loss != 0 && t.matched && t.near && t.value < least * t.state.weight * scale &&
         guide_age(t.state) > lately;
}
#endif
