// A vertex of a path: where, how it is oriented, what it reflects, and whence it is seen.
#ifndef FB_LIB_PATH_VERTEX
#define FB_LIB_PATH_VERTEX
#include "lib/surface.glsl"

const uint kMaskCamera = 1u;
const uint kMaskIndirect = 2u;
const float kRayEnd = 1e6;  // beyond any map: coordinates end at 32768

struct PathVertex {
  vec3 position;
  vec3 previous;        // where the point was in the former frame; only known of what the camera sees
  vec3 normal;          // geometric, on the side of `view`
  vec3 shading_normal;
  vec3 view;            // towards the previous vertex
  Bsdf bsdf;
};

PathVertex make_path_vertex(Surface s, vec3 view) {
  return PathVertex(s.position, s.position, s.normal, s.shading_normal, view, s.bsdf);
}

// An orthonormal frame about n (Duff 2017); to_world(v) = frame * v.
mat3 frame_about(vec3 n) {
  float s = n.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (s + n.z), b = n.x * n.y * a;
  return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// Samples the BSDF at a vertex: f cos / pdf, zero if the direction goes below the geometric surface.
vec3 sample_vertex_bsdf(PathVertex v, inout uint rng, out vec3 direction) {
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
#endif
