// Steps `proposal` and `control` of guided paths: directions of the cell's tree (Section 4.1) or of the vertex's own
// scattering, weighed by the density of both together, and a control variate of the difference of the two (Eq. 27),
// where kMixtureControl.
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

void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) {
  prepare_cell(v, here, path, g);
  g.beta = beta_at(path, learnt_mixture_beta(g.moments));
  if (g.taught >= kTreeTaught) g.tree = load_tree(here.place.slot);
}

// A flame's own light is all about its points.
bool is_guided(Vertex v, Guidance g) { return g.taught >= kTreeTaught && !v.glows; }

float mixture_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf, out float guided_pdf) {
  guided_pdf = is_guided(v, g) ? tree_pdf(direction_tree(g.tree), direction) : 0.0;
  return is_guided(v, g) ? mix(guided_pdf, scatter_pdf, pstf.pstf_defence) : scatter_pdf;
}

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {
  bool guided = rng_uniform(rng) >= pstf.pstf_defence && is_guided(v, g);
  vec3 u = vec3(rng_uniform(rng), rng_uniform(rng), rng_uniform(rng));
  ScatterSample s = scatter_sample(v.scatter, v.view, u);
  vec3 direction = guided ? tree_sample(direction_tree(g.tree), u.xy) : s.direction;
  uint flags = guided ? 0u : s.flags;
  float scatter_pdf, guided_pdf;
  vec3 f = scatter_eval(v.scatter, v.view, direction, scatter_pdf);
  float pdf = mixture_pdf(v, g, direction, scatter_pdf, guided_pdf);
  // A reflection below the surface is in no density: nothing that is weighed by one may be of it.
  if (!guided && scatter_pdf == 0.0) pdf = 0.0;
  g.pdf = (flags & kScatterDelta) == 0u ? pdf : 0.0;
  float cosine = max(dot(direction, g.normal), 0.0) / kPiShared;
  g.over = g.pdf > 0.0 ? cosine / g.pdf : 0.0;
  g.off = g.pdf > 0.0 ? (guided_pdf - cosine) / g.pdf : 0.0;
  if (!is_guided(v, g)) g.off = g.beta = 0.0;
  Proposal p = proposed(direction, f, pdf, flags);
  g.weight = p.weight;
  return p;
}
float proposal_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf) {
  float guided_pdf;
  return mixture_pdf(v, g, direction, scatter_pdf, guided_pdf);
}

const bool kHasControl = kMixtureControl;

vec3 control_mean(Vertex v, Guidance g, Field here) { return vec3(0.0); }
vec3 control_at(Vertex v, Guidance g, Field here, vec3 direction) {
  float cosine = max(dot(direction, g.normal), 0.0) / kPiShared;
  return (g.beta * (tree_pdf(direction_tree(g.tree), direction) - cosine)) * g.albedo * g.mean;
}
#endif
