// Step `begin`: the first path of a pixel asks for its reservoir's light. The includer says whether light of two reflections is
// reused, too (kReusesIndirect); then a path hands over what it finds of it.
#ifndef FB_RESTIR_BEGIN
#define FB_RESTIR_BEGIN
#include "lib/trace.glsl"

struct PathOwn {
  bool asks;    // it is the pixel's first
  bool reuses;  // its first vertex' light is looked for by the pixel's reservoir
  bool open;    // what is looked for at its second vertex is the indirect reservoir's
  Hit second;   // that vertex,
  float seen;   // one over the density of it, in the measure of samples,
  vec3 through; // and the factor of the way there
};
#include "lib/path_state.glsl"

void empty_fresh(uint element);

void begin_path(inout Path path, uvec2 block, uint i) {
  path.own.asks = i == 0u;
  path.own.reuses = path.own.open = false;
  if (kReusesIndirect && !IN_MEDIUM && i == 0u) empty_fresh(block.y * frame.light_width + block.x);
}
#endif
