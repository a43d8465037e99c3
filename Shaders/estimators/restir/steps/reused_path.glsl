// What a path of a pixel that reuses carries. The includer says whether light of two reflections is reused, too
// (kReusesIndirect): then a path hands over what it finds of it.
#ifndef FB_RESTIR_REUSED_PATH
#define FB_RESTIR_REUSED_PATH
#include "lib/interaction.glsl"

struct ReusedPath {
  bool asks;     // it is the pixel's first
  bool reuses;   // its first vertex' light is looked for by the pixel's reservoir
  bool open;     // what is looked for at its second vertex is the indirect reservoir's
  Hit second;    // that vertex,
  float seen;    // one over the density of it, in the measure of samples,
  vec3 through;  // and the factor of the way there
};

void empty_fresh(uint element);

ReusedPath reused_path(uvec2 block, uint i) {
  ReusedPath p;
  p.asks = i == 0u;
  p.reuses = p.open = false;
  p.second = Hit(0.0, vec2(0.0), kNoIndex, 0u);
  p.seen = 0.0;
  p.through = vec3(0.0);
  if (kReusesIndirect && !IN_MEDIUM && i == 0u) empty_fresh(block.y * frame.light_width + block.x);
  return p;
}
#endif
