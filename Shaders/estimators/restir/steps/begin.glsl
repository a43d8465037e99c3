// Step `begin`: the first path of a pixel asks for its reservoir's light.
#ifndef FB_RESTIR_BEGIN
#define FB_RESTIR_BEGIN
#include "estimators/restir/steps/reused_path.glsl"

const bool kScatters = true;  // the technique proposes directions by each vertex's own scattering
struct PathOwn {
  ReusedPath reused;
};
#include "lib/path_state.glsl"

void begin_path(inout Path path, uvec2 block, uint i) { path.own.reused = reused_path(block, i); }
#endif
