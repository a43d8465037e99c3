// Step `proposal` by the vertex's own scattering.
#include "lib/path_state.glsl"

struct Guidance {
  uint none;
};
void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) { g.none = 0u; }

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {
  vec3 u = vec3(rng_uniform(rng), rng_uniform(rng), FEATURE_SPECULAR ? rng_uniform(rng) : 1.0);
  ScatterSample s = scatter_sample(v.scatter, v.view, u);
  return Proposal(s.direction, s.weight, s.pdf, s.flags);
}

float proposal_pdf(Guidance g, vec3 direction, float bsdf_pdf) { return bsdf_pdf; }
