// Step `proposal` by the vertex's own scattering.
#include "lib/path_state.glsl"

struct Guidance {
  uint none;
};
void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) { g.none = 0u; }

Proposal propose(Vertex v, inout Guidance g, inout uint rng) {
  Proposal p;
  p.weight = scatter_sample(v, rng, p.direction);
  return p;
}

float proposal_pdf(Vertex v, Guidance g, vec3 direction) {
  float pdf;
  scatter_eval(v, direction, pdf);
  return pdf;
}
