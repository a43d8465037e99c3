// What a transition of the Markov chain decides: which state learns from a sample, of what score, and where it is stored.
#ifndef FB_MCPG_TRANSITION
#define FB_MCPG_TRANSITION
#include "lib/steps/mcpg/propose.glsl"

struct Transition {
  GuideState state;  // that learns
  float value;       // its score of the sample
  uint slot, check;  // where it is stored, for which cell
  bool matched;      // the state that is there explains the direction
  bool near;         // the direction is nearer to its lobe's mean than its mean cosine
};
#endif
