// Markov chain path guiding (Alber 2025) as steps of the path loop: at a vertex, states are taken from an ensemble of hash grids,
// their vMF lobes and the BSDF make a mixture, one direction is sampled from it, and what the ray met updates a state. The
// includer says whether paths may end in the irradiance cache (kEndsInField) and includes a step `direct`.
#ifndef FB_MCPG_ALL
#define FB_MCPG_ALL
#include "lib/steps/mcpg/begin.glsl"
#include "lib/steps/mcpg/field.glsl"
#include "lib/steps/mcpg/propose.glsl"
#include "lib/steps/mcpg/learn.glsl"
#endif
