// Markov chain path guiding (Alber 2025) as steps of the path loop: at a vertex, states are taken from an ensemble of
// hash grids, their vMF lobes and the BSDF make a mixture, one direction is sampled from it, and what the ray met
// updates a state. The includer says whether paths may end in the irradiance cache (kEndsInField) and includes a step
// `direct`.
#ifndef FB_MCPG_ALL
#define FB_MCPG_ALL
#include "estimators/mcpg/steps/begin.glsl"
#include "estimators/mcpg/steps/field.glsl"
#include "estimators/mcpg/steps/propose.glsl"
#include "estimators/mcpg/steps/learn.glsl"

void learn_besides(Vertex v, Guidance g, Path path, inout uint rng) {}
#endif
