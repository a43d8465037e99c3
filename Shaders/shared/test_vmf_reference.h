// The von Mises-Fisher distribution in long double, written from its textbook definition with expm1, log1p and sums of
// positive terms: what shared/vmf.h is measured against. Directions are taken as the float32 vectors that they are, of
// exact length 1 once divided by it.
#pragma once

#include <cmath>
#include <algorithm>

#include "shared/vmf.h"

namespace fb::shared::reference {

using Real = long double;
constexpr Real kPi = 3.141592653589793238462643383279502884L;

struct Vector {
  Real x, y, z;
};
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Real dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector exact(vec3 v) { return {v.x, v.y, v.z}; }
inline Real length(vec3 v) { return std::sqrt(dot(exact(v), exact(v))); }
inline Vector unit(vec3 v) { return {v.x / length(v), v.y / length(v), v.z / length(v)}; }
inline vec3 rounded(Vector v) {
  return normalize(vec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)));
}

inline Real one_minus_cosine(vec3 mu, vec3 w) {
  const Vector d = unit(w) - unit(mu);
  return dot(d, d) / 2;
}
// 4 pi times the pdf along mu.
inline Real peak(Real kappa) { return kappa == 0 ? 1 : 2 * kappa / -std::expm1(-2 * kappa); }
inline Real pdf_of_t(Real kappa, Real t) { return peak(kappa) / (4 * kPi) * std::exp(-kappa * t); }
inline Real pdf(vec3 mu, Real kappa, vec3 w) { return pdf_of_t(kappa, one_minus_cosine(mu, w)); }
inline Real cdf(Real kappa, Real t) { return kappa == 0 ? t / 2 : std::expm1(-kappa * t) / std::expm1(-2 * kappa); }
inline Real inverse_cdf(Real kappa, Real u) {
  return kappa == 0 ? 2 * u : -std::log1p(u * std::expm1(-2 * kappa)) / kappa;
}

// coth(kappa) - 1/kappa; below 1 as (kappa cosh kappa - sinh kappa) / (kappa sinh kappa), the numerator by its series.
inline Real mean_cosine(Real kappa) {
  if (kappa == 0) return 0;
  if (kappa >= 1) return 1 / std::tanh(kappa) - 1 / kappa;
  Real sum = 0, term = kappa * kappa / 6;  // kappa^(2 j) / (2 j + 1)!
  for (int j = 1; j < 16; ++j, term *= kappa * kappa / ((2 * j) * (2 * j + 1))) sum += 2 * j * term;
  return sum / std::sinh(kappa);
}
inline Real mean_cosine_complement(Real kappa) {
  return kappa < 1 ? 1 - mean_cosine(kappa) : 1 / kappa + 2 / -std::expm1(2 * kappa);
}
// Expectation of sin^2.
inline Real second_moment(Real kappa) { return kappa == 0 ? 2.0L / 3 : 2 * mean_cosine(kappa) / kappa; }

// kappa times the derivative of the mean cosine.
inline Real mean_cosine_slope(Real kappa) {
  if (kappa < 1e-3L) return kappa / 3;
  const Real s = std::sinh(std::min(kappa, 5000.0L));
  return 1 / kappa - kappa / (s * s);
}
inline Real kappa_of_complement(Real c) {
  Real low = 0, high = 2 / c;
  for (int i = 0; i < 200; ++i) {
    const Real middle = low > 0 && high / low > 4 ? std::sqrt(low * high) : (low + high) / 2;
    (mean_cosine_complement(middle) > c ? low : high) = middle;
  }
  return low;
}

// The direction at 1 - cosine t and azimuth phi in the frame about mu that vmf_sample uses (Duff 2017).
inline Vector direction_about(vec3 mu_rounded, Real t, Real phi) {
  const Vector mu = unit(mu_rounded);
  const Real s = mu.z >= 0 ? 1 : -1, a = -1 / (s + mu.z), b = mu.x * mu.y * a, sine = std::sqrt(t * (2 - t));
  const Real x = sine * std::cos(phi), y = sine * std::sin(phi), z = 1 - t;
  return {x * (1 + s * mu.x * mu.x * a) + y * b + z * mu.x, x * s * b + y * (s + mu.y * mu.y * a) + z * mu.y,
          -x * s * mu.x - y * mu.y + z * mu.z};
}
inline Real azimuth(vec2 u) { return (2 * static_cast<Real>(u.y) - 1) * kPi; }

}  // namespace fb::shared::reference
