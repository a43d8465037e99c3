// Step `begin` of paths that are guided and reuse.
#ifndef FB_RESTIR_GUIDED_BEGIN
#define FB_RESTIR_GUIDED_BEGIN
#include "estimators/mcpg/steps/guided_path.glsl"
#include "estimators/restir/steps/reused_path.glsl"

const bool kScatters = false;
struct PathOwn {
  GuidedPath guided;
  ReusedPath reused;
};
#include "lib/path_state.glsl"

void begin_path(inout Path path, uvec2 block, uint i) {
  path.own.guided = guided_path(block, i);
  path.own.reused = reused_path(block, i);
}
#endif
