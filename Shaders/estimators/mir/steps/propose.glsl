// Step `proposal` of `mir`: directions of the place's distribution, or of the vertex's own scattering, weighed by the
// density of both together. Where nothing is known it is the vertex's own scattering alone; a flame's own light is all
// about its points.
#ifndef FB_MIR_PROPOSE
#define FB_MIR_PROPOSE
#include "estimators/mir/steps/begin.glsl"
#define FB_GUIDING_PLACE(i) mir_tree.at[i]
#define FB_GUIDING_NODE(i) mir_nodes.at[i]
#include "estimators/mir/guiding_tree.h"

struct Guidance {
  uint first;         // node of the distribution, or kUntaught
  float scatter_pdf;  // of the direction that was drawn
};

void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) {
  g.first = kUntaught;
  g.scatter_pdf = 0.0;
  if (mir.taught == 0u || v.glows || IN_MEDIUM) return;
  g.first =
      mir_tree.at[mir.leaves + guiding_leaf(GuidingCube(mir.cube_low, mir.cube_inverse_width), mir.levels, v.position)];
}

float proposal_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf) {
  return g.first != kUntaught ? mix(guiding_pdf(g.first, mir.node_levels, direction), scatter_pdf, mir.mir_defence)
                              : scatter_pdf;
}

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {
  bool guided = rng_uniform(rng) >= mir.mir_defence && g.first != kUntaught;
  vec3 u = vec3(rng_uniform(rng), rng_uniform(rng), rng_uniform(rng));
  ScatterSample s = scatter_sample(v.scatter, v.view, u);
  vec3 direction = guided ? guiding_draw(g.first, mir.node_levels, u.xy) : s.direction;
  vec3 f = scatter_eval(v.scatter, v.view, direction, g.scatter_pdf);
  float pdf = proposal_pdf(v, g, direction, g.scatter_pdf);
  // A reflection below the surface is in no density: nothing that is weighed by one may be of it.
  if (!guided && g.scatter_pdf == 0.0) pdf = 0.0;
  return proposed(direction, f, pdf, guided ? 0u : s.flags);
}
#endif
