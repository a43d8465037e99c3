// Step `begin`: the first path of a pixel asks for its reservoir's light.
#ifndef FB_RESTIR_BEGIN
#define FB_RESTIR_BEGIN
struct PathOwn {
  bool asks;    // it is the pixel's first
  bool reuses;  // its first vertex' light is looked for by the pixel's reservoir
};
#include "lib/path_state.glsl"

void begin_path(inout Path path, uvec2 block, uint i) {
  path.own.asks = i == 0u;
  path.own.reuses = false;
}
#endif
