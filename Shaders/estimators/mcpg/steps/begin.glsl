// Step `begin` of paths that are guided.
#ifndef FB_MCPG_BEGIN
#define FB_MCPG_BEGIN
#include "estimators/mcpg/steps/guided_path.glsl"

struct PathOwn {
  GuidedPath guided;
};
#include "lib/path_state.glsl"

void begin_path(inout Path path, uvec2 block, uint i) { path.own.guided = guided_path(block, i); }
#endif
