// What a guided path carries. Lanes that run together (4x2 blocks) look into the same cells, train together, and go on
// together.
#ifndef FB_MCPG_GUIDED_PATH
#define FB_MCPG_GUIDED_PATH
#include "estimators/mcpg/steps/cache.glsl"
#include "lib/scatter.glsl"

struct GuidedPath {
  bool trains;     // learns all that it can
  bool goes_on;    // to frame.bounces reflections, known light or not
  uint group_rng;  // random numbers that lanes that run together (4x2 pixels) share
};

GuidedPath guided_path(uvec2 block, uint i) {
  GuidedPath p;
  uvec2 group =
      guide.mc_paper != 0 ? block : uvec2(block.x >> 2u, block.y >> 1u);  // the paper's pixels draw their own cells
  p.group_rng =
      rng_seed(group.y * frame.width + group.x, frame.frame, i, frame.seed ^ (IN_MEDIUM ? 0x2545f491u : 0x5bd1e995u));
  p.goes_on = kEndsInField && rng_next(p.group_rng) % guide.mc_tail_train == 0u;
  p.trains = rng_next(p.group_rng) % guide.mc_train == 0u || p.goes_on;
  return p;
}
#endif
