// Steps `proposal` and `control`: directions of the vertex's own scattering, and a control variate of what they bring
// (Section 4.2).
//
// Equations 24, 25, 26 and 28 are printed with the integral within what is divided by the density. Right is (g - beta
// h) / p + beta I, and I must be the integral of this very h at this vertex: h is of a Lambert surface under light that
// is linear in its direction, whose integral is known whatever the field holds. Every direction about the shading
// normal may be drawn, those below the surface, too, which bring nothing.
//
// Or any h, whose integral is not known (TWO_LEVEL; Dereviannykh 2024): its mean over directions of their own, without
// rays, takes the integral's place. Whatever estimates the one, of the path's own direction, estimates the other, so
// that their difference has the mean zero. Here h is of the vertex's whole BSDF, under that light where it is above
// zero.
#ifndef FB_PSTF_CONTROL
#define FB_PSTF_CONTROL
#include "estimators/pstf/steps/no_trees.glsl"
#include "estimators/pstf/steps/guidance.glsl"
#include "shared/color.h"

layout(constant_id = kSpecTwoLevel) const bool TWO_LEVEL = false;

void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) {
  prepare_cell(v, here, path, g);
  g.beta = beta_at(path, learnt_beta(g.moments));
}

// h / pdf of a direction that the vertex's own scattering drew.
vec3 cheap_estimate(Guidance g, Proposal p) {
  bool weighed = p.pdf > 0.0 && (p.flags & kScatterDelta) == 0u;
  return weighed ? p.weight * max(linear_at(g.light, p.direction), 0.0) * g.mean : vec3(0.0);
}
vec3 cheap_integral(Vertex v, Guidance g, inout uint rng) {
  vec3 sum = vec3(0.0);
  int i = 0;
  do sum += cheap_estimate(g, propose_scattered(v, rng));
  while (++i < pstf.pstf_two_level);
  return sum / float(pstf.pstf_two_level);
}

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {
  Proposal p = propose_scattered(v, rng);
  g.pdf = (p.flags & kScatterDelta) == 0u ? p.pdf : 0.0;
  g.over = g.pdf > 0.0 ? max(dot(p.direction, g.normal), 0.0) / (kPiShared * g.pdf) : 0.0;
  g.off = g.over * linear_at(g.light, p.direction) - linear_integral(g.light, g.normal);
  g.weight = p.weight;
  if (TWO_LEVEL) {
    g.integral = cheap_integral(v, g, rng);
    g.estimate = cheap_estimate(g, p);
    float scale = luminance(g.reflectance) * g.luminance;
    g.off = scale > 0.0 ? luminance(g.estimate - g.integral) / scale : 0.0;
  }
  if (kPredicts) p.weight *= g.prediction.scale;
  return p;
}
float proposal_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf) { return scatter_pdf; }

const bool kHasControl = true;

vec3 known_mean(Guidance g) {
  if (TWO_LEVEL) return g.beta * g.integral;
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
  if (TWO_LEVEL) return (scale * g.beta * g.pdf) * g.estimate;
  return (scale * g.beta * linear_at(g.light, direction) * max(dot(direction, g.normal), 0.0) / kPiShared) * g.albedo *
         g.mean;
}
#endif
