// A smooth interface of two dielectrics: how much light it reflects (Fresnel's equations, unpolarised; Born and Wolf
// 1999, 1.5.2) and where the rest goes (Snell). Indices are real; eta is the index beyond the interface over the index
// on the side of the direction given, so one function serves both sides. Directions are unit and point away from the
// surface.
//
// With c the cosine here and h = eta times the cosine beyond, h^2 = (eta^2 - 1) + c^2, the amplitudes are written as
//   r_s = (eta^2 - 1) / (c + h)^2,   r_p = (eta^2 - 1) ((eta^2 + 1) c^2 - 1) / (eta^2 c + h)^2   (but for signs):
// the usual differences, multiplied out. Nothing cancels as eta goes to 1, Brewster's angle is a factor, and where h^2
// is negative h = 0 makes both exceed 1, so that a minimum is total internal reflection without a branch.
#ifndef FB_SHARED_DIELECTRIC_H
#define FB_SHARED_DIELECTRIC_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

// eta for a direction of this cosine with a normal behind which the index is `index` times that before it.
FB_FN float dielectric_eta(float index, float cosine) { return cosine < 0.0f ? 1.0f / index : index; }

// (eta^2 - 1) + cosine^2, negative if all is reflected.
FB_FN float dielectric_excess(float cosine, float eta) { return (eta - 1.0f) * (eta + 1.0f) + cosine * cosine; }

// The cosine beyond, for a cosine here in [0, 1]; 0 if all is reflected.
FB_FN float dielectric_cosine_beyond(float cosine, float eta) {
  return sqrt(max(dielectric_excess(cosine, eta), 0.0f)) / eta;
}

// Share of the flux that is reflected, 0 to 1, for a cosine here in [0, 1]; 1 - it goes through. 0 for eta = 1.
FB_FN float dielectric_reflectance(float cosine, float eta) {
  float c = max(cosine, 1e-9f), e2 = eta * eta, k = (eta - 1.0f) * (eta + 1.0f);
  float h = sqrt(max(k + c * c, 0.0f)), s = c + h, p = e2 * c + h;
  float r_s = min(abs(k) / (s * s), 1.0f);
  float r_p = min(abs(k * ((e2 + 1.0f) * c * c - 1.0f)) / (p * p), 1.0f);
  return 0.5f * (r_s * r_s + r_p * r_p);
}

// The directions in which light from w goes on; dot(w, normal) >= 0. Where all is reflected, refraction gives a
// direction within the surface: ask the reflectance first.
FB_FN vec3 dielectric_reflect(vec3 w, vec3 normal) { return normal * (2.0f * dot(w, normal)) - w; }
FB_FN vec3 dielectric_refract(vec3 w, vec3 normal, float eta) {
  float c = dot(w, normal);
  return normalize((normal * c - w) / eta - normal * dielectric_cosine_beyond(c, eta));
}

// Radiance per index^2 is what an interface leaves alone: solid angles shrink on the way into the denser side, eta^2
// cos_t dw_t = cos_i dw_i. So radiance that arrives from beyond counts (1 - reflectance) times this here. Flux,
// importance and what is traced from a light do not have the factor; over a way in and out it cancels.
FB_FN float dielectric_radiance_factor(float eta) { return 1.0f / (eta * eta); }

FB_NAMESPACE_END
#endif
