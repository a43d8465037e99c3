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

// A direction to look for light in.
struct Aim {
  vec3 direction;
  vec3 f;        // f cos
  float weight;  // f cos times this is the factor on the emission that is met; zero: nothing to look for
  float reach;
  float density, bsdf_pdf;  // with which the direction is looked for, and of the BSDF
  uint instance, triangle;  // what must be met; kNoIndex: a sun
  uint cell;                // of the grid of what such rays reach
};
const Aim kNoAim = Aim(vec3(0.0, 0.0, 1.0), vec3(0.0), 0.0, 0.0, 0.0, 0.0, kNoIndex, kNoIndex, 0u);

// Light from what was looked for, by reflection to the vertex' viewer, and as it falls on the vertex.
struct Direct {
  vec3 radiance;
  vec3 irradiance;  // over pi
};
#endif
