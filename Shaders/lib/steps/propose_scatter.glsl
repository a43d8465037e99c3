// Step `proposal` by the vertex's own scattering.
#include "lib/path_state.glsl"

struct Guidance {
  uint none;
};
void prepare(Vertex v, Field here, inout Path path, inout uint rng, out Guidance g) { g.none = 0u; }

Proposal propose(Vertex v, inout Guidance g, inout uint rng) { return propose_scattered(v, rng); }
float proposal_pdf(Vertex v, Guidance g, vec3 direction, float scatter_pdf) { return scatter_pdf; }
