// How light scatters at a vertex of a path: by a surface's BSDF, or by the phase function of the medium between
// surfaces.
//
// Scatter has three questions, which agree with each other: sample (a direction, f cos / pdf of it, its pdf, flags),
// eval (f cos of any direction) with the pdf that sample has there, and geometry (where light may go at all, the
// projected cosine, the origin of a ray, the axis that grids of cells tell orientations by). Steps of a technique ask
// these and do not look inside, so that another kind of interaction is a case here and nowhere else. Densities are per
// solid angle. Directions are in the world and point away from the vertex; `view` points to the viewer.
#ifndef FB_LIB_SCATTER
#define FB_LIB_SCATTER
#include "lib/haze.glsl"
#include "lib/surface.glsl"
#include "shared/medium.h"
#include "shared/phase.h"

layout(constant_id = kSpecMedium) const bool FEATURE_MEDIUM = false;  // there is a medium between surfaces
// A path's first vertex is in it. A shader of its own (fb_shader), not a constant of one: what it leaves out is a third
// of the code that a driver would have to read first.
#ifdef PATHS_BEGIN_IN_MEDIUM
const bool IN_MEDIUM = true;
#else
const bool IN_MEDIUM = false;
#endif

struct Scatter {
  vec3 normal;  // geometric, on the viewer's side; in a medium: towards the viewer
  vec3 shading_normal;
  Bsdf bsdf;
  bool medium;          // only where IN_MEDIUM
  PhaseFunction phase;  // of a medium
};

bool in_medium(Scatter s) { return IN_MEDIUM && s.medium; }
const PhaseFunction kNoPhase = PhaseFunction(0.0, 0.0);  // of a surface

// Of a sampled direction.
const uint kScatterDelta = 1u;      // eval is zero almost everywhere else: no other way of sampling finds it
const uint kScatterTransmits = 2u;  // the direction goes through the surface

struct ScatterSample {
  vec3 direction;
  vec3 weight;  // f cos / pdf; zero: it goes where nothing scatters to
  float pdf;
  uint flags;
};

// An orthonormal frame about n (Duff 2017); to_world(v) = frame * v.
mat3 frame_about(vec3 n) {
  float s = n.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (s + n.z), b = n.x * n.y * a;
  return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// Whether light may be scattered in a direction: not into the geometric surface.
bool scatters_to(Scatter s, vec3 direction) { return dot(direction, s.normal) > 0.0 || in_medium(s); }

// The cosine that irradiance is weighted by, times the direction's length. A medium has light from all sides: its mean
// radiance times pi.
float scatter_cosine(Scatter s, vec3 direction) {
  return in_medium(s) ? 0.25 * length(direction) : dot(direction, s.normal);
}

// What cells of a grid tell orientations by.
vec3 scatter_axis(Scatter s) { return s.normal; }

// What is reflected of even light, about.
vec3 scatter_albedo(Scatter s) { return in_medium(s) ? vec3(1.0) : s.bsdf.albedo; }

// Start of a ray that leaves the vertex.
vec3 scatter_origin(Scatter s, vec3 position) { return in_medium(s) ? position : offset_origin(position, s.normal); }

// In a medium: what is scattered at all is the path's factor, not the vertex'.
ScatterSample phase_scatter(PhaseFunction phase, vec3 view, vec2 u) {
  ScatterSample result;
  result.direction = phase_sample(phase, -view, u);
  result.weight = vec3(1.0);
  result.pdf = phase_eval_about(phase, -view, result.direction);
  result.flags = 0u;
  return result;
}

// `u`: uniform in [0, 1); the third is used where FEATURE_SPECULAR.
ScatterSample scatter_sample(Scatter s, vec3 view, vec3 u) {
  if (in_medium(s)) return phase_scatter(s.phase, view, u.xy);
  ScatterSample result;
  result.flags = 0u;  // the smoothest coat is rough (kMinAlpha), and all are opaque
  mat3 to_world = frame_about(s.shading_normal);
  vec3 local;
  if (FEATURE_SPECULAR) {
    vec3 wo = view * to_world;
    result.weight = bsdf_sample(s.bsdf, wo, u, local);
    result.pdf = bsdf_pdf(s.bsdf, wo, local);
  } else {
    local = sample_cosine_hemisphere(u.xy);
    result.weight = s.bsdf.albedo;
    result.pdf = pdf_cosine_hemisphere(local);
  }
  result.direction = to_world * local;
  if (!scatters_to(s, result.direction)) result.weight = vec3(0.0);
  return result;
}

// f cos of a direction, and the density that scatter_sample has there.
vec3 scatter_eval(Scatter s, vec3 view, vec3 direction, out float pdf) {
  vec3 f;
  if (in_medium(s)) {
    pdf = phase_eval_about(s.phase, -view, direction);
    return vec3(pdf);
  }
  if (FEATURE_SPECULAR) {
    mat3 to_world = frame_about(s.shading_normal);
    vec3 wo = view * to_world, wi = direction * to_world;
    pdf = bsdf_pdf(s.bsdf, wo, wi);
    f = bsdf_eval(s.bsdf, wo, wi);
  } else {
    pdf = max(dot(direction, s.shading_normal), 0.0) / kPiShared;
    f = s.bsdf.albedo * pdf;
  }
  return scatters_to(s, direction) ? f : vec3(0.0);
}
#endif
