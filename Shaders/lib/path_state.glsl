// What the path loop hands to the steps of a technique (lib/path.glsl). The technique's step `begin` defines PathOwn,
// what its paths carry of their own, before.
#ifndef FB_LIB_PATH_STATE
#define FB_LIB_PATH_STATE
#include "lib/segment.glsl"

struct Path {
  uvec2 pixel;  // whose light it estimates
  uint number;  // among this frame's paths of its kind
  uint depth;   // reflections so far: its vertices are numbered from 0 on
  uint most;    // reflections that it may have
  bool last;    // emission alone counts at what is met next
  bool second;  // it begins at the second surface that a pixel shows by way of water
  vec3 factor;  // on what it brings: of how its first vertex was chosen
  PathOwn own;
};

// Whether that is one: without the second vertex's code a shader is compiled in half the time.
layout(constant_id = kSpecOneBounce) const bool ONE_BOUNCE = false;
// Set in the smaller shader that stands in while the whole one is compiled: the last vertex has no code of its own.
layout(constant_id = kSpecSmall) const bool SMALL = false;

// Most reflections of the paths of pixels; scattering in a medium is the first of those that begin there.
uint most_reflections() { return ONE_BOUNCE ? 1u : IN_MEDIUM ? uint(frame.medium_bounces) : uint(frame.bounces); }

// The number of a path's vertex among all of this frame's paths of pixels: those that begin in the medium come after
// all others.
uint vertex_number(Path path) {
  uint others = frame.light_width * ((frame.height + frame.light_block - 1u) / frame.light_block) *
                uint(frame.spp * frame.bounces);
  return path.number * most_reflections() + (IN_MEDIUM ? others : 0u) + path.depth;
}

// A direction in which a path goes on. Made by proposed() or by propose_scattered(), so that nothing is left unset.
struct Proposal {
  vec3 direction;
  vec3 weight;  // f cos / pdf; zero ends the path
  float pdf;    // with which any direction there is proposed
  uint flags;   // of ScatterSample, where the vertex's own scattering was sampled
};

// `f`: of the direction, with its cosine; `pdf`: per solid angle, of all that may propose it together.
Proposal proposed(vec3 direction, vec3 f, float pdf, uint flags) {
  return Proposal(direction, pdf > 0.0 ? f / pdf : vec3(0.0), pdf, flags);
}

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
