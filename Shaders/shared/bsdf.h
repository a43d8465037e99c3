// The surface's BSDF: Lambert under a GGX coat (Walter 2007, Heitz 2014), opaque, one-sided about the shading normal.
// All directions are in the local frame (z = shading normal) and point away from the surface; pdfs are with respect to
// solid angle. Samplers stand next to their pdfs.
//
//   f = (1 - metalness) * albedo/pi * (1 - F(wo)) (1 - F(wi)) + D G2 F / (4 cos_o cos_i)
//
// F is Schlick's, F0 = mix(specular, albedo, metalness); F = 0 where specular and metalness are 0 (plain Lambert).
#ifndef FB_SHARED_BSDF_H
#define FB_SHARED_BSDF_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_CONST float kPiShared = 3.14159265358979323846f;
FB_CONST float kMinAlpha = 0.002f;  // GGX alpha below this is numerically a mirror

struct Bsdf {
  vec3 albedo;
  float alpha;     // GGX roughness^2, at least kMinAlpha
  float specular;  // F0 of the dielectric part
  float metalness;
};

// --- cosine-weighted hemisphere: p = cos/pi ---
FB_FN vec3 sample_cosine_hemisphere(vec2 u) {
  float r = sqrt(u.x), phi = 2.0f * kPiShared * u.y;
  return vec3(r * cos(phi), r * sin(phi), sqrt(max(0.0f, 1.0f - u.x)));
}
FB_FN float pdf_cosine_hemisphere(vec3 w) { return max(w.z, 0.0f) / kPiShared; }

// --- GGX ---
FB_FN float ggx_d(vec3 h, float alpha) {
  float a2 = alpha * alpha;
  // 1 + (a2 - 1) cos^2 = sin^2 + a2 cos^2, without the cancellation at small alpha
  float k = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
  return a2 / (kPiShared * k * k);
}
FB_FN float ggx_lambda(vec3 w, float alpha) {
  float t2 = alpha * alpha * (w.x * w.x + w.y * w.y) / max(w.z * w.z, 1e-12f);
  return 0.5f * (sqrt(1.0f + t2) - 1.0f);
}
FB_FN float ggx_g1(vec3 w, float alpha) { return 1.0f / (1.0f + ggx_lambda(w, alpha)); }
FB_FN float ggx_g2(vec3 wo, vec3 wi, float alpha) {
  return 1.0f / (1.0f + ggx_lambda(wo, alpha) + ggx_lambda(wi, alpha));
}
// Visible normals by spherical caps (Dupuy and Benyoub 2023): p(h) = G1(wo) max(0, dot(wo, h)) D(h) / wo.z
FB_FN vec3 sample_ggx_visible_normal(vec3 wo, float alpha, vec2 u) {
  vec3 w = normalize(vec3(wo.x * alpha, wo.y * alpha, wo.z));
  float phi = 2.0f * kPiShared * u.x;
  float z = (1.0f - u.y) * (1.0f + w.z) - w.z;
  float s = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
  vec3 c = vec3(s * cos(phi), s * sin(phi), z) + w;
  return normalize(vec3(c.x * alpha, c.y * alpha, max(c.z, 1e-7f)));
}
FB_FN float pdf_ggx_reflection(vec3 wo, vec3 h, float alpha) {
  return ggx_g1(wo, alpha) * ggx_d(h, alpha) / (4.0f * max(wo.z, 1e-7f));
}

FB_FN float schlick_weight(float cosine) {
  float m = clamp(1.0f - cosine, 0.0f, 1.0f), m2 = m * m;
  return m2 * m2 * m;
}
FB_FN bool bsdf_has_coat(Bsdf b) { return b.specular > 0.0f || b.metalness > 0.0f; }
FB_FN vec3 bsdf_f0(Bsdf b) { return mix(vec3(b.specular), b.albedo, b.metalness); }
FB_FN vec3 bsdf_fresnel(Bsdf b, float cosine) {
  vec3 f0 = bsdf_f0(b);
  return f0 + (vec3(1.0f) - f0) * schlick_weight(cosine);
}

// Probability of sampling the coat; depends on wo alone.
FB_FN float bsdf_coat_probability(Bsdf b, vec3 wo) {
  if (!bsdf_has_coat(b)) return 0.0f;
  vec3 f = bsdf_fresnel(b, wo.z);
  float coat = (f.x + f.y + f.z) / 3.0f;
  float base = (1.0f - b.metalness) * (b.albedo.x + b.albedo.y + b.albedo.z) / 3.0f * (1.0f - coat);
  return clamp(coat / max(coat + base, 1e-6f), 0.1f, 0.95f + 0.05f * b.metalness);
}

// f * cos(wi); zero below the horizon.
FB_FN vec3 bsdf_eval(Bsdf b, vec3 wo, vec3 wi) {
  if (wi.z <= 0.0f || wo.z <= 0.0f) return vec3(0.0f);
  vec3 diffuse = b.albedo * ((1.0f - b.metalness) / kPiShared);
  if (!bsdf_has_coat(b)) return diffuse * wi.z;
  float f0 = b.specular;
  float fo = f0 + (1.0f - f0) * schlick_weight(wo.z), fi = f0 + (1.0f - f0) * schlick_weight(wi.z);
  vec3 h = normalize(wo + wi);
  vec3 coat = bsdf_fresnel(b, dot(wo, h)) * (ggx_d(h, b.alpha) * ggx_g2(wo, wi, b.alpha) / (4.0f * wo.z * wi.z));
  return (diffuse * ((1.0f - fo) * (1.0f - fi)) + coat) * wi.z;
}

FB_FN float bsdf_pdf(Bsdf b, vec3 wo, vec3 wi) {
  if (wi.z <= 0.0f || wo.z <= 0.0f) return 0.0f;
  float p_coat = bsdf_coat_probability(b, wo);
  float p = (1.0f - p_coat) * pdf_cosine_hemisphere(wi);
  if (p_coat > 0.0f) p += p_coat * pdf_ggx_reflection(wo, normalize(wo + wi), b.alpha);
  return p;
}

// Samples wi; returns f cos / pdf (zero: no path), with both lobes' pdfs combined (one-sample MIS).
FB_FN vec3 bsdf_sample(Bsdf b, vec3 wo, vec3 u, FB_OUT(vec3, wi)) {
  float p_coat = bsdf_coat_probability(b, wo);
  if (u.z >= p_coat) {
    wi = sample_cosine_hemisphere(vec2(u.x, u.y));
    if (p_coat == 0.0f) return b.albedo;  // Lambert: exact, no rounding from the ratio
  } else {
    vec3 h = sample_ggx_visible_normal(wo, b.alpha, vec2(u.x, u.y));
    wi = h * (2.0f * dot(wo, h)) - wo;
  }
  float p = bsdf_pdf(b, wo, wi);
  if (!(p > 0.0f)) return vec3(0.0f);
  return bsdf_eval(b, wo, wi) / p;
}

FB_NAMESPACE_END
#endif
