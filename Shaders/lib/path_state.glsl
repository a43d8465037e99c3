// What the path loop hands to the steps of a technique (lib/path.glsl).
#ifndef FB_LIB_PATH_STATE
#define FB_LIB_PATH_STATE
#include "lib/segment.glsl"

struct Path {
  uint number;     // among this frame's paths of its kind
  uint vertex;     // among this frame's vertices: first_vertex_of(number) + reflections so far
  bool last;       // emission alone counts at what is met next
  bool trains;     // the technique learns all that it can from this path
  bool goes_on;    // to frame.bounces reflections, known light or not
  uint group_rng;  // random numbers that lanes that run together (4x2 pixels) share
};

// Whether that is one: without the second vertex's code a shader is compiled in half the time.
layout(constant_id = kSpecOneBounce) const bool ONE_BOUNCE = false;
// Whether less code counts more than speed: a path's last vertex has none of its own.
layout(constant_id = kSpecSmall) const bool SMALL = false;

// Most reflections of a path; scattering in a medium is the first of those that begin there.
uint path_bounces() { return ONE_BOUNCE ? 1u : IN_MEDIUM ? uint(frame.medium_bounces) : uint(frame.bounces); }

// Paths that begin in the medium come after all others.
uint first_vertex_of(uint number) {
  uint others = frame.light_width * ((frame.height + frame.light_block - 1u) / frame.light_block) * uint(frame.spp * frame.bounces);
  return number * path_bounces() + (IN_MEDIUM ? others : 0u);
}

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
