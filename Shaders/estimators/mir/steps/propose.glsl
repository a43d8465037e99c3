// Step `proposal` of `mir`: directions of the place's distribution, or of the vertex's own scattering, weighed by the
// density of both together. Where nothing is known it is the vertex's own scattering alone; a flame's own light is all
// about its points.
#ifndef FB_MIR_PROPOSE
#define FB_MIR_PROPOSE
#include "estimators/mir/steps/begin.glsl"
#define FB_GUIDING_PLACE(i) mir_tree.at[i]
#define FB_GUIDING_NODE(i) mir_nodes.at[i]
#include "estimators/mir/guiding_tree.h"

struct FrozenDirections {
  uint first;  // node of the distribution, or kUntaught
};
float frozen_pdf(FrozenDirections d, vec3 direction) { return guiding_pdf(d.first, mir.node_levels, direction); }
vec3 frozen_draw(FrozenDirections d, vec2 u) { return guiding_draw(d.first, mir.node_levels, u); }
#include "lib/frozen.glsl"

struct Guidance {
  FrozenDirections directions;
  float scatter_pdf;  // of the direction that was drawn
};
bool is_taught(Guidance g) { return g.directions.first != kUntaught; }

void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) {
  g.directions.first = kUntaught;
  g.scatter_pdf = 0.0;
  if (mir.taught == 0u || v.glows || IN_MEDIUM) return;
  g.directions.first =
      mir_tree.at[mir.leaves + guiding_leaf(GuidingCube(mir.cube_low, mir.cube_inverse_width), mir.levels, v.position)];
}

float proposal_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf) {
  return proposed_pdf(g.directions, is_taught(g), mir.mir_defence, direction, scatter_pdf);
}

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {
  FrozenProposal p = propose_frozen(v, g.directions, is_taught(g), mir.mir_defence, rng);
  g.scatter_pdf = p.scatter_pdf;
  return proposed(p.direction, p.f, p.pdf, p.flags);
}
#endif
