// What the path loop hands to the steps of a technique (lib/path.glsl).
#ifndef FB_LIB_PATH_STATE
#define FB_LIB_PATH_STATE
#include "lib/interaction.glsl"

struct Path {
  uint number;     // among this frame's paths
  uint vertex;     // among this frame's vertices: number * frame.bounces + reflections so far
  bool last;       // emission alone counts at what is met next
  bool trains;     // the technique learns all that it can from this path
  bool goes_on;    // to frame.bounces reflections, known light or not
  uint group_rng;  // random numbers that lanes that run together (4x2 pixels) share
};

struct Proposal {
  vec3 direction;
  vec3 weight;  // f cos / pdf; zero ends the path
  float pdf;    // with which any direction there is proposed
  uint flags;   // of ScatterSample, where the vertex's own scattering was sampled
};

Proposal propose_scattered(Vertex v, inout uint rng) {
  vec3 u = vec3(rng_uniform(rng), rng_uniform(rng), FEATURE_SPECULAR ? rng_uniform(rng) : 1.0);
  ScatterSample s = scatter_sample(v.scatter, v.view, u);
  return Proposal(s.direction, s.weight, s.pdf, s.flags);
}

// Light from what was looked for, by reflection to the vertex' viewer, and as it falls on the vertex.
struct Direct {
  vec3 radiance;
  vec3 irradiance;  // over pi
};
#endif
