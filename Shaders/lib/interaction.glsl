// A vertex of a path: an interaction with a surface. Where it is, whence it is seen, and how light scatters there.
//
// Scatter has three questions, which agree with each other: sample (a direction, and f cos / pdf of it), eval (f cos of any
// direction, with the density that sample has there). Densities are per solid angle. Zero below the geometric surface.
#ifndef FB_LIB_INTERACTION
#define FB_LIB_INTERACTION
#include "lib/surface.glsl"

const float kRayEnd = 1e6;  // beyond any map: coordinates end at 32768

struct Vertex {
  vec3 position;
  vec3 previous;        // where the point was in the former frame; only known of what the camera sees
  vec3 normal;          // geometric, on the side of `view`
  vec3 shading_normal;
  vec3 view;            // towards the previous vertex
  Bsdf bsdf;
};

Vertex make_vertex(Surface s, vec3 view) {
  return Vertex(s.position, s.position, s.normal, s.shading_normal, view, s.bsdf);
}

// An orthonormal frame about n (Duff 2017); to_world(v) = frame * v.
mat3 frame_about(vec3 n) {
  float s = n.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (s + n.z), b = n.x * n.y * a;
  return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// A direction, and f cos / pdf of it; zero if it goes below the geometric surface.
vec3 scatter_sample(Vertex v, inout uint rng, out vec3 direction) {
  mat3 to_world = frame_about(v.shading_normal);
  vec3 u = vec3(rng_uniform(rng), rng_uniform(rng), FEATURE_SPECULAR ? rng_uniform(rng) : 1.0);
  vec3 local;
  vec3 weight;
  if (FEATURE_SPECULAR) {
    weight = bsdf_sample(v.bsdf, v.view * to_world, u, local);
  } else {
    local = sample_cosine_hemisphere(u.xy);
    weight = v.bsdf.albedo;
  }
  direction = to_world * local;
  return dot(direction, v.normal) > 0.0 ? weight : vec3(0.0);
}

// f cos of a direction, and the density that scatter_sample has there.
vec3 scatter_eval(Vertex v, vec3 direction, out float pdf) {
  mat3 to_world = frame_about(v.shading_normal);
  vec3 wo = v.view * to_world, wi = direction * to_world;
  pdf = bsdf_pdf(v.bsdf, wo, wi);
  return dot(direction, v.normal) > 0.0 ? bsdf_eval(v.bsdf, wo, wi) : vec3(0.0);
}
#endif
