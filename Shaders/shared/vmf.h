// The von Mises-Fisher distribution on the unit sphere, in float32 from kappa = 0 (uniform) to kVmfMaxKappa and beyond:
//
//   p(w) = kappa / (2 pi (1 - exp(-2 kappa))) exp(-kappa t),   t = 1 - dot(mu, w),   per steradian
//
// (Jakob 2012). What would cancel is not formed: t comes from the vectors' difference, 1 - exp(-2 kappa) and the
// logarithm of the inverse CDF from series where their arguments are small, and a lobe's width travels as c = 1 - mean
// cosine, which keeps its digits in narrow lobes where the mean cosine has none left (cf. Tokuyoshi 2025). GLSL has no
// expm1 and no log1p, and Vulkan promises log() no relative precision near 1; so both are polynomials of ours there.
#ifndef FB_SHARED_VMF_H
#define FB_SHARED_VMF_H
#include "shared/common.h"
FB_NAMESPACE_BEGIN

FB_CONST float kVmfPi = 3.14159265358979323846f;
// The narrowest lobe that float32 directions resolve. Its standard deviation, 2^-16 rad (0.0009 degrees), is 256 times
// the spacing of components near 1: rounding a direction to float32 then changes its density by less than 1% within
// three deviations, and the lobe's variance by 1e-6. The functions stay finite to 1e30; beyond this limit it is the
// directions that are too coarse.
FB_CONST float kVmfMaxKappa = 4294967296.0f;  // 2^32

// (coth(k) - 1/k) / k for 0 <= k <= 1, from k^2; relative error under 1 ulp.
FB_FN float vmf_langevin_over_kappa(float kappa2) {
  return 0.333333343f +
         kappa2 * (-0.022222057f + kappa2 * (0.00211506058f + kappa2 * (-0.00020779531f + kappa2 * 1.67494363e-05f)));
}

// 2 kappa / (1 - e), where e = exp(-2 kappa): 1 at kappa = 0. It is 4 pi times the pdf along mu.
FB_FN float vmf_peak(float kappa, float e) {
  return kappa < 1.0f ? 1.0f + kappa + kappa * kappa * vmf_langevin_over_kappa(kappa * kappa)
                      : 2.0f * kappa / (1.0f - e);
}

// The pdf along mu, per steradian: 1/(4 pi) at kappa = 0.
FB_FN float vmf_normalization(float kappa) { return vmf_peak(kappa, exp(-2.0f * kappa)) * (0.25f / kVmfPi); }

// 1 - dot(mu, w) for unit vectors, exact to rounding however close they are.
FB_FN float vmf_one_minus_cosine(vec3 mu, vec3 w) {
  vec3 d = w - mu;
  return 0.5f * dot(d, d);
}

// One lobe, ready to be evaluated in many directions.
struct VmfLobe {
  vec3 mu;      // mean direction, unit
  float kappa;  // concentration, >= 0
  float scale;  // pdf along mu, 1/sr
};
FB_FN VmfLobe vmf_lobe(vec3 mu, float kappa) {
  VmfLobe lobe;
  lobe.mu = mu;
  lobe.kappa = kappa;
  lobe.scale = vmf_normalization(kappa);
  return lobe;
}
FB_FN float vmf_lobe_pdf(VmfLobe lobe, vec3 w) {
  return lobe.scale * exp(-lobe.kappa * vmf_one_minus_cosine(lobe.mu, w));
}

// Density of w per steradian.
FB_FN float vmf_pdf(vec3 mu, float kappa, vec3 w) { return vmf_lobe_pdf(vmf_lobe(mu, kappa), w); }

// 1 - cosine at which the CDF over t is u in [0, 1): t = -log(1 - u (1 - exp(-2 kappa))) / kappa (Jakob 2012), in
// [0, 2]. With s = v / (2 - v), where v = u (1 - exp(-2 kappa)), the logarithm is 2 atanh(s): a polynomial up to v =
// 1/2.
FB_FN float vmf_inverse_cdf(float kappa, float u) {
  float e = exp(-2.0f * kappa);
  float q = u / (vmf_peak(kappa, e) - kappa * u);
  float s = kappa * q, s2 = s * s;
  if (s > 1.0f / 3.0f) return min(-log((1.0f - u) + u * e) / kappa, 2.0f);
  float atanh_over_s = 1.0f + s2 * (0.333331615f + s2 * (0.200122982f + s2 * (0.139825791f + s2 * 0.140788898f)));
  return min(2.0f * q * atanh_over_s, 2.0f);
}

// The direction whose cosine with mu is 1 - t and sine is `sine`, at the azimuth that u in [0, 1) gives. Unit to
// rounding.
FB_FN vec3 vmf_direction_about(vec3 mu, float t, float sine, float u) {
  float phi = (2.0f * u - 1.0f) * kVmfPi;  // Vulkan states sin's and cos's precision for [-pi, pi]
  float x = sine * cos(phi), y = sine * sin(phi);
  // Added to mu in an orthonormal frame about it (Duff 2017): mu + x tangent + y bitangent - t mu.
  float s = mu.z >= 0.0f ? 1.0f : -1.0f;
  float a = -1.0f / (s + mu.z), b = mu.x * mu.y * a;
  vec3 tangent = vec3(1.0f + s * mu.x * mu.x * a, s * b, -s * mu.x);
  vec3 bitangent = vec3(b, s + mu.y * mu.y * a, -mu.y);
  return normalize(mu + (tangent * x + bitangent * y - mu * t));
}

// A direction of density vmf_pdf(mu, kappa, .); u in [0, 1)^2, u.x = 0 gives mu itself. Unit to rounding.
FB_FN vec3 vmf_sample(vec3 mu, float kappa, vec2 u) {
  float t = vmf_inverse_cdf(kappa, u.x);
  return vmf_direction_about(mu, t, sqrt(t * (2.0f - t)), u.y);
}

// 1 - (coth(kappa) - 1/kappa): 1 at kappa = 0, 1/kappa in narrow lobes.
FB_FN float vmf_mean_cosine_complement(float kappa) {
  if (kappa < 1.0f) return 1.0f - kappa * vmf_langevin_over_kappa(kappa * kappa);
  float e = exp(-2.0f * kappa);
  return 1.0f / kappa - 2.0f * e / (1.0f - e);
}

// kappa whose mean cosine is 1 - c, three ways for c in [0, 1]; all are at most kVmfMaxKappa, which c = 0 gives. Near
// c = 1 a step of c is 3e-8 of mean cosine, so 2e-7 of kappa (absolute): no formula can know more.

// (3 r - r^3) / (1 - r^2), where r = 1 - c (Banerjee 2005, Eq. 4.4): up to 5% too high; no exp.
FB_FN float vmf_kappa(float c) {
  float r = 1.0f - c;
  c = max(c, 1.0f / kVmfMaxKappa);
  return min(r * (3.0f - r * r) / (c * (2.0f - c)), kVmfMaxKappa);
}
// A minimax polynomial for r / (kappa c): within 0.09%; no exp, the cost of the above.
FB_FN float vmf_kappa_fit(float c) {
  float r = 1.0f - c;
  c = max(c, 1.0f / kVmfMaxKappa);
  float m =
      1.0f + c * (-0.956469166f + c * (-0.658085686f + c * (2.62751785f + c * (-2.46074558f + c * 0.780852755f))));
  return min(r / (c * m), kVmfMaxKappa);
}
// A Newton step on 1/kappa from the fit: within 1e-6; one exp, two divisions more.
FB_FN float vmf_kappa_newton(float c) {
  c = max(c, 1.0f / kVmfMaxKappa);
  float kappa = vmf_kappa_fit(c);
  float excess, slope;  // of 1 - mean cosine, that of kappa less the wanted; - kappa times its derivative. Both scaled.
  if (kappa < 1.0f) {
    float p = vmf_langevin_over_kappa(kappa * kappa), r = kappa * p;
    excess = (1.0f - c) - r;
    slope = kappa * (1.0f - 2.0f * p - r * r);
  } else {
    float e = exp(-2.0f * kappa), b = vmf_peak(kappa, e);
    excess = (1.0f - b * e) - c * kappa;
    slope = 1.0f - b * b * e;
  }
  return slope > 0.0f ? min(kappa * slope / (slope - excess), kVmfMaxKappa) : 0.0f;
}

FB_NAMESPACE_END
#endif
