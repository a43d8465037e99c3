// Step `begin` of a technique whose paths carry nothing of their own.
#ifndef FB_LIB_STEPS_ONE_PATH
#define FB_LIB_STEPS_ONE_PATH
struct PathOwn {
  uint none;
};
#include "lib/path_state.glsl"

void begin_path(inout Path path, uvec2 block, uint i) { path.own.none = 0u; }
#endif
