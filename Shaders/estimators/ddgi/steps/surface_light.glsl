// What probes know of the light that a surface sends to its viewer (Eq. 6).
#ifndef FB_DDGI_SURFACE_LIGHT
#define FB_DDGI_SURFACE_LIGHT
#include "estimators/ddgi/steps/probes.glsl"
#include "lib/interaction.glsl"

struct SurfaceLight {
  bool known;
  vec3 diffuse;  // that its Lambert part sends
  vec3 glossy;   // and its coat, by one sample of its directions
  uint drawn;    // one of the probes, by its weight; kDdgiNoProbe: none
};

bool has_coat(Vertex v) { return FEATURE_SPECULAR && bsdf_has_coat(v.scatter.bsdf); }

// `length_of_ray`: of that which met the vertex. Not `glossy`: its coat is not asked for. `pick`, in [0, 1), draws one
// of the probes.
SurfaceLight light_of_surface(Vertex v, float length_of_ray, bool along_view, bool glossy, bool asks, bool notes,
                              float pick, inout uint rng) {
  vec3 n = v.scatter.shading_normal, other = vec3(0.0), weight = vec3(0.0);
  if (FEATURE_SPECULAR && glossy && has_coat(v)) {
    Scatter coat = v.scatter;
    coat.bsdf = coat_of(coat.bsdf);
    ScatterSample s = scatter_sample(coat, v.view, vec3(rng_uniform(rng), rng_uniform(rng), 0.0));
    other = s.direction;
    weight = s.weight;
  }
  vec3 asked = asked_place(v.position, v.view, v.scatter.normal, length_of_ray, along_view);
  vec3 in_air = along_view ? asked : asked_place(v.position, v.view, v.scatter.normal, length_of_ray, true);
  ProbeLight p = light_of_probes(v.position, asked, in_air, n, other, asks && !in_medium(v.scatter), notes, pick);
  vec3 reflected = diffuse_reflectance(v.scatter.bsdf, max(dot(v.view, n), 0.0));
  return SurfaceLight(p.known, reflected * p.about_normal, weight * p.about_other, p.known ? p.drawn : kDdgiNoProbe);
}
#endif
