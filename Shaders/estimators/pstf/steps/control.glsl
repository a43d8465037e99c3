// Steps `proposal` and `control`: directions of the vertex's own scattering, and a control variate of what they bring
// (Section 4.2).
//
// Equations 24, 25, 26 and 28 are printed with the integral within what is divided by the density. Right is (g - beta
// h) / p + beta I, and I must be the integral of this very h at this vertex: h is of a Lambert surface under light that
// is linear in its direction, whose integral is known whatever the field holds. Every direction about the shading
// normal may be drawn, those below the surface, too, which bring nothing.
#ifndef FB_PSTF_CONTROL
#define FB_PSTF_CONTROL
#include "estimators/pstf/steps/no_trees.glsl"
#include "estimators/pstf/steps/guidance.glsl"

void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) {
  prepare_cell(v, here, path, g);
  g.beta = beta_at(path, learnt_beta(g.moments));
}

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {
  Proposal p = propose_scattered(v, rng);
  g.pdf = (p.flags & kScatterDelta) == 0u ? p.pdf : 0.0;
  g.over = g.pdf > 0.0 ? max(dot(p.direction, g.normal), 0.0) / (kPiShared * g.pdf) : 0.0;
  g.off = g.over * linear_at(g.light, p.direction) - linear_integral(g.light, g.normal);
  g.weight = p.weight;
  if (kPredicts) p.weight *= g.prediction.scale;
  return p;
}
float proposal_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf) { return scatter_pdf; }

const bool kHasControl = true;

vec3 known_mean(Guidance g) {
  vec3 mean = (g.beta * linear_integral(g.light, g.normal)) * g.albedo * g.mean;
  if (pstf.pstf_form == 1) return g.pdf > 0.0 ? mean / g.pdf : vec3(0.0);
  if (pstf.pstf_form == 2) return g.beta * g.albedo * g.outgoing;
  return mean;
}
vec3 control_mean(Vertex v, Guidance g, Field here) {
  return kPredicts ? g.prediction.light + g.prediction.scale * known_mean(g) : known_mean(g);
}
vec3 control_at(Vertex v, Guidance g, Field here, vec3 direction) {
  float scale = kPredicts ? g.prediction.scale : 1.0;
  return (scale * g.beta * linear_at(g.light, direction) * max(dot(direction, g.normal), 0.0) / kPiShared) * g.albedo *
         g.mean;
}
#endif
