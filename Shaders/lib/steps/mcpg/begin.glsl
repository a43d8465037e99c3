// Step `begin`. Lanes that run together (4x2 blocks) look into the same cells, train together, and go on together.
#ifndef FB_MCPG_BEGIN
#define FB_MCPG_BEGIN
#include "lib/path_state.glsl"
#include "lib/steps/mcpg/cache.glsl"

Path begin_path(uvec2 block, uint number, uint i) {
  Path path = Path(number, 0u, false, false, false, 0u);
  uvec2 group = guide.mc_paper != 0 ? block : uvec2(block.x >> 2u, block.y >> 1u);  // the paper's pixels draw their own cells
  path.group_rng = rng_seed(group.y * frame.width + group.x, frame.frame, i, frame.seed ^ (IN_MEDIUM ? 0x2545f491u : 0x5bd1e995u));
  path.goes_on = kEndsInField && rng_next(path.group_rng) % guide.mc_tail_train == 0u;
  path.trains = rng_next(path.group_rng) % guide.mc_train == 0u || path.goes_on;
  return path;
}
#endif
