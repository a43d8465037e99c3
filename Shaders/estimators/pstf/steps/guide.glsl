// Steps `proposal` and `control` of guided paths: directions of the cell's tree or mixture (Section 4.1) or of the
// vertex's own scattering, weighed by the density of both together, and a control variate of the difference of the two
// (Eq. 27), where kMixtureControl.
//
// Eq. 27 has no integral to add, since two densities differ by none: h is (p_tree - cos / pi) times a factor. The
// cosine takes the BSDF's density's place: of a coat's reflections some go below the surface, so that its density is
// not whole. Trees reach below the surface, too: what is drawn there brings nothing, and counts. The factor is the
// light that the cell knows times beta, learnt as covariance over variance in each cell, of either sign: as printed one
// number is to serve all integrals, which Hua 2023 shows to be what kept such control variates from being of use.
#ifndef FB_PSTF_GUIDE
#define FB_PSTF_GUIDE
#include "estimators/pstf/pstf_mixture.h"
#include "estimators/pstf/steps/trees.glsl"
#include "estimators/pstf/steps/guidance.glsl"

#define FrozenDirections CellTree
float frozen_pdf(CellTree tree, vec3 direction) { return directions_pdf(tree, direction); }
vec3 frozen_draw(CellTree tree, vec2 u) { return directions_draw(tree, u); }
#include "lib/frozen.glsl"

void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) {
  prepare_cell(v, here, path, g);
  g.beta = beta_at(path, learnt_mixture_beta(g.moments));
  g.tree.slot = 0u;  // lanes that have none look there all the same
  if (g.taught >= kTreeTaught) g.tree = load_tree(here.place.slot);
}

// A flame's own light is all about its points.
bool is_guided(Vertex v, Guidance g) { return g.taught >= kTreeTaught && !v.glows; }

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {
  FrozenProposal drawn = propose_frozen(v, g.tree, is_guided(v, g), pstf.pstf_defence, rng);
  g.pdf = (drawn.flags & kScatterDelta) == 0u ? drawn.pdf : 0.0;
  float cosine = max(dot(drawn.direction, g.normal), 0.0) / kPiShared;
  g.over = g.pdf > 0.0 ? cosine / g.pdf : 0.0;
  g.off = g.pdf > 0.0 ? (drawn.frozen_pdf - cosine) / g.pdf : 0.0;
  if (!is_guided(v, g)) g.off = g.beta = 0.0;
  Proposal p = proposed(drawn.direction, drawn.f, drawn.pdf, drawn.flags);
  g.weight = p.weight;
  return p;
}
float proposal_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf) {
  return proposed_pdf(g.tree, is_guided(v, g), pstf.pstf_defence, direction, scatter_pdf);
}

const bool kHasControl = kMixtureControl, TWO_LEVEL = false;

vec3 control_mean(Vertex v, Guidance g, Field here) { return vec3(0.0); }
vec3 control_at(Vertex v, Guidance g, Field here, vec3 direction) {
  float cosine = max(dot(direction, g.normal), 0.0) / kPiShared;
  return (g.beta * (frozen_pdf(g.tree, direction) - cosine)) * g.albedo * g.mean;
}
#endif
