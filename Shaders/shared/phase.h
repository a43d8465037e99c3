// Draine's phase function (Draine 2003), of which Henyey and Greenstein's (1941) is the case alpha = 0 and
// Cornette and Shanks's (1992) alpha = 1, in float32 for g from -0.999 to 0.999, 0 included:
//
//   p(c) = (1 - g^2) (1 + alpha c^2) / (4 pi N (1 + g^2 - 2 g c)^(3/2)) per steradian,
//   N = 1 + alpha (1 + 2 g^2) / 3
//
// c is the cosine between the directions of travel before and after: 1 goes straight on. Mixed with Henyey and
// Greenstein's it is near Mie's for fog and clouds (Jendersie and d'Eon 2023; alpha up to 32 there).
//
// Two things depart from the papers' formulas, which cancel in narrow lobes and divide by g. First, all is computed
// from t = 1 - |c| on the side where the lobe is, so with a = |g| only. Second, with x the number that Henyey and
// Greenstein's inverse CDF is given, everything is a sum or product of terms without cancellation (`PhasePoint`), also
// at g = 0; and Draine's own CDF is a polynomial of x / q that Halley's steps invert, in place of a quartic's closed
// form.
#ifndef FB_SHARED_PHASE_H
#define FB_SHARED_PHASE_H
#include "shared/vmf.h"
FB_NAMESPACE_BEGIN

FB_CONST float kPhaseMaxG = 0.999f;      // a lobe of 0.001 rad: the density along it is 1.6e5 / sr
FB_CONST float kPhaseMaxAlpha = 100.0f;  // 4 of Halley's steps suffice up to here

struct PhaseFunction {
  float g;      // of Henyey and Greenstein's part; its mean cosine, but not Draine's: phase_mean_cosine
  float alpha;  // weight of the part with the squared cosine, 0 to kPhaseMaxAlpha
};
// Clamped to what is computed accurately.
FB_FN PhaseFunction phase_function(float g, float alpha) {
  PhaseFunction p;
  p.g = clamp(g, -kPhaseMaxG, kPhaseMaxG);
  p.alpha = clamp(alpha, 0.0f, kPhaseMaxAlpha);
  return p;
}

// N above.
FB_FN float phase_norm(PhaseFunction p) { return 1.0f + p.alpha * (1.0f + 2.0f * p.g * p.g) * (1.0f / 3.0f); }

// Mean of the cosine (from the Legendre moments g, g^2, g^3 of Henyey and Greenstein's).
FB_FN float phase_mean_cosine(PhaseFunction p) {
  return p.g * (1.0f + p.alpha * (3.0f + 2.0f * p.g * p.g) * 0.2f) / phase_norm(p);
}

// Where the lobe is: 1 ahead, -1 behind.
FB_FN float phase_side(PhaseFunction p) { return p.g < 0.0f ? -1.0f : 1.0f; }

// The density, per steradian, from t = 1 - side * cosine in [0, 2].
FB_FN float phase_eval_t(PhaseFunction p, float t) {
  float a = abs(p.g), c = 1.0f - t, d = (1.0f - a) * (1.0f - a) + 2.0f * a * t;
  return (1.0f - a) * (1.0f + a) * (1.0f + p.alpha * c * c) / (4.0f * kVmfPi * phase_norm(p) * d * sqrt(d));
}
// From the cosine. A float32 cosine near 1 is 3e-8 off, which alone is 9% of the density in the middle of g = 0.999's
// lobe: where both directions are at hand, use phase_eval_about.
FB_FN float phase_eval(PhaseFunction p, float cosine) { return phase_eval_t(p, 1.0f - phase_side(p) * cosine); }
// From unit directions of travel, before and after.
FB_FN float phase_eval_about(PhaseFunction p, vec3 forward, vec3 w) {
  return phase_eval_t(p, vmf_one_minus_cosine(forward * phase_side(p), w));
}

// The point at which Henyey and Greenstein's CDF over t is x in [0, 1].
struct PhasePoint {
  float t;            // 1 - side * cosine, in [0, 2]
  float rest;         // 2 - t, exact to rounding where t is near 2
  float cosine_x;     // derivative of the cosine (on the lobe's side) by x, at most 0
  float square_mean;  // mean of the squared cosine over [0, x]; 1 at x = 0
};
// With v = 1 - x and q = 1 - a + 2 a v, which is (1 - a^2) over the root of the denominator:
//   t = 2 x (1-a)^2 (1 + a v) / q^2,   2 - t = 2 v (1+a)^2 (1 - a + a v) / q^2,
//   mean of c^2 = 1 - 2 p + 4/3 p^2 + 2/3 a y p^2,   y = x / q, p = (1-a)^2 y.
FB_FN PhasePoint phase_point(float a, float x) {
  float v = 1.0f - x, l = 1.0f - a, m = 1.0f + a;
  float q = l + 2.0f * a * v, r = 1.0f / q, y = x * r, p = l * l * y;
  PhasePoint at;
  at.t = min(2.0f * p * (1.0f + a * v) * r, 2.0f);
  at.rest = min(2.0f * v * m * m * (l + a * v) * r * r, 2.0f);
  at.cosine_x = -2.0f * l * l * m * m * r * r * r;
  at.square_mean = 1.0f + p * (-2.0f + p * (2.0f + a * y) * (2.0f / 3.0f));
  return at;
}

// One of Halley's steps for x where Draine's CDF, x (1 + alpha square_mean) / N, is u = un / N.
FB_FN float phase_halley(PhaseFunction p, float un, float x) {
  PhasePoint at = phase_point(abs(p.g), x);
  float c = 1.0f - at.t;
  float excess = x * (1.0f + p.alpha * at.square_mean) - un;
  float slope = 1.0f + p.alpha * c * c, bend = p.alpha * c * at.cosine_x;  // half the second derivative
  return clamp(x - excess * slope / (slope * slope - excess * bend), 0.0f, 1.0f);
}

// The point at which Draine's CDF over t is u in [0, 1): u = 0 is the middle of the lobe. The start is linear on either
// side of where the cosine is 0 and the slope least.
FB_FN PhasePoint phase_inverse_cdf(PhaseFunction p, float u) {
  float a = abs(p.g), n = phase_norm(p), root = sqrt(1.0f + a * a);
  float x0 = (1.0f + a) / (root * (root + 1.0f - a));
  float u0 = x0 * (1.0f + p.alpha * phase_point(a, x0).square_mean) / n;
  float x = u < u0 ? u * x0 / u0 : 1.0f - (1.0f - u) * (1.0f - x0) / (1.0f - u0);
  x = phase_halley(p, u * n, x);
  x = phase_halley(p, u * n, x);
  x = phase_halley(p, u * n, x);
  x = phase_halley(p, u * n, x);
  return phase_point(a, x);
}

// A cosine of density 2 pi phase_eval; u in [0, 1).
FB_FN float phase_sample_cosine(PhaseFunction p, float u) { return phase_side(p) * (1.0f - phase_inverse_cdf(p, u).t); }
// A direction of travel after scattering, of density phase_eval_about(p, forward, .); u in [0, 1)^2. Unit to rounding.
FB_FN vec3 phase_sample(PhaseFunction p, vec3 forward, vec2 u) {
  PhasePoint at = phase_inverse_cdf(p, u.x);
  return vmf_direction_about(forward * phase_side(p), at.t, sqrt(at.t * at.rest), u.y);
}

FB_NAMESPACE_END
#endif
