// Step `begin` of guided paths that have a control variate.
#ifndef FB_MCPG_CV_BEGIN
#define FB_MCPG_CV_BEGIN
#include "estimators/mcpg/steps/guided_path.glsl"
#include "estimators/pstf/steps/cells.glsl"

struct PathOwn {
  GuidedPath guided;
  uint control_rng;  // random numbers that lanes that run together (4x2 pixels) share, for the control variate's cells
  bool teaches_control;  // cells of it that have been taught much, too; alike in such lanes
};
#include "lib/path_state.glsl"

// Of numbers of their own, so that directions are those of `mcpg`.
void begin_path(inout Path path, uvec2 block, uint i) {
  path.own.guided = guided_path(block, i);
  uint group = (block.y >> 1u) * frame.width + (block.x >> 2u);
  path.own.control_rng = rng_seed(group, frame.frame, i, frame.seed ^ (IN_MEDIUM ? 0x3c6ef372u : 0x1f83d9abu));
  path.own.teaches_control = rng_next(path.own.control_rng) % uint(pstf.pstf_train) == 0u;
}
#endif
