// Proposals from a frozen distribution of directions, one that nothing teaches while it is drawn from: the defensive
// mixture of it and of the vertex's own scattering. The includer has, before,
//   FrozenDirections                                    what it knows of the vertex's distribution,
//   float frozen_pdf(FrozenDirections, vec3 direction)  its density of any direction, per steradian,
//   vec3 frozen_draw(FrozenDirections, vec2 u)          a direction of that density; u in [0, 1)^2.
#ifndef FB_FROZEN
#define FB_FROZEN
#include "lib/path_state.glsl"

// A direction, with the densities of it. `defence`: the share of the vertex's own scattering.
struct FrozenProposal {
  vec3 direction;
  vec3 f;  // with the cosine
  float frozen_pdf, scatter_pdf;
  float pdf;  // of both together
  uint flags;
};

// `known`: there is a distribution.
FrozenProposal propose_frozen(Vertex v, FrozenDirections d, bool known, float defence, inout uint rng) {
  FrozenProposal p;
  bool guided = rng_uniform(rng) >= defence && known;
  vec3 u = vec3(rng_uniform(rng), rng_uniform(rng), rng_uniform(rng));
  ScatterSample s = scatter_sample(v.scatter, v.view, u);
  p.direction = guided ? frozen_draw(d, u.xy) : s.direction;
  p.flags = guided ? 0u : s.flags;
  p.f = scatter_eval(v.scatter, v.view, p.direction, p.scatter_pdf);
  p.frozen_pdf = known ? frozen_pdf(d, p.direction) : 0.0;
  p.pdf = known ? mix(p.frozen_pdf, p.scatter_pdf, defence) : p.scatter_pdf;
  // A reflection below the surface is in no density: nothing that is weighed by one may be of it.
  if (!guided && p.scatter_pdf == 0.0) p.pdf = 0.0;
  return p;
}

float proposed_pdf(FrozenDirections d, bool known, float defence, vec3 direction, float scatter_pdf) {
  return known ? mix(frozen_pdf(d, direction), scatter_pdf, defence) : scatter_pdf;
}
#endif
