// Step `begin`. Lanes that run together (4x2 blocks) look into the same cells, train together, and go on together.
#ifndef FB_MCPG_BEGIN
#define FB_MCPG_BEGIN
struct PathOwn {
  bool trains;     // learns all that it can
  bool goes_on;    // to frame.bounces reflections, known light or not
  uint group_rng;  // random numbers that lanes that run together (4x2 pixels) share
};
#include "estimators/mcpg/steps/cache.glsl"
#include "lib/path_state.glsl"

void begin_path(inout Path path, uvec2 block, uint i) {
  uvec2 group = guide.mc_paper != 0 ? block : uvec2(block.x >> 2u, block.y >> 1u);  // the paper's pixels draw their own cells
  path.own.group_rng = rng_seed(group.y * frame.width + group.x, frame.frame, i, frame.seed ^ (IN_MEDIUM ? 0x2545f491u : 0x5bd1e995u));
  path.own.goes_on = kEndsInField && rng_next(path.own.group_rng) % guide.mc_tail_train == 0u;
  path.own.trains = rng_next(path.own.group_rng) % guide.mc_train == 0u || path.own.goes_on;
}
#endif
