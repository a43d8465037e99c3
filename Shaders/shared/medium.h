// Distances in a homogeneous medium: what is left of light along a segment, and samplers of a distance on it, by
// transmittance and about a light (equi-angular, Kulla and Fajardo 2012), and by a mix of both. Samplers stand next to
// their densities, which are per unit of distance along the segment from 0 to `reach`.
//
// sigma is extinction, 1/unit, 0 or more; reach is finite, 0 or more, in units. Measured for sigma 0, 1e-9 to 10, reach
// to 1e6: nothing is NaN, no distance exceeds its reach. A distance's weight under transmittance alone, T / density, is
// transmittance_integral(sigma, reach) for every distance.
#ifndef FB_SHARED_MEDIUM_H
#define FB_SHARED_MEDIUM_H
#include "shared/vmf.h"
FB_NAMESPACE_BEGIN

// 1 - exp(-x) for x >= 0, to 6 roundings however small x is. Below 2 it is x over the polynomial of vmf_peak, since 2
// kappa / (1 - exp(-2 kappa)) is that with x = 2 kappa.
FB_FN float one_minus_exp(float x) {
  float k = 0.5f * x;
  return x < 2.0f ? x / (1.0f + k + k * k * vmf_langevin_over_kappa(k * k)) : 1.0f - exp(-x);
}

// Share of light that a distance leaves, for fog (grey) and for liquids (by colour).
FB_FN float transmittance(float sigma, float distance) { return exp(-sigma * distance); }
FB_FN vec3 transmittance(vec3 sigma, float distance) {
  return vec3(exp(-sigma.x * distance), exp(-sigma.y * distance), exp(-sigma.z * distance));
}
// 1 - transmittance: the share that interacts on the way.
FB_FN float opacity(float sigma, float distance) { return one_minus_exp(sigma * distance); }

// Integral of the transmittance from 0 to reach, units: (1 - exp(-sigma reach)) / sigma; reach where sigma = 0.
FB_FN float transmittance_integral(float sigma, float reach) {
  float x = sigma * reach;
  return reach / vmf_peak(0.5f * x, exp(-x));
}

// Mean distance at which light interacts, of what does so before reach: 1 / sigma - reach T / (1 - T), which cancels
// where the medium is thin. There it is half of the way.
FB_FN float mean_interaction(float sigma, float reach) {
  float x = sigma * reach;
  return x < 0.05f ? reach * (0.5f - x / 12.0f) : 1.0f / sigma - reach * exp(-x) / max(one_minus_exp(x), 1e-20f);
}

// A distance of density proportional to transmittance. It is a truncated exponential, hence 1 - cosine of a von Mises-
// Fisher lobe of kappa = sigma reach / 2, stretched from [0, 2] to [0, reach].
FB_FN float sample_transmittance(float sigma, float reach, float u) {
  return 0.5f * reach * vmf_inverse_cdf(0.5f * sigma * reach, u);
}
FB_FN float pdf_transmittance(float sigma, float reach, float distance) {
  return transmittance(sigma, distance) / max(transmittance_integral(sigma, reach), 1e-30f);
}

// Fog on the camera's straight way: what is left after a distance t is exp(-(linear + square t) t). `square` is Quake's
// law, by which what is near stays clear; then `linear` is 0.
struct Haze {
  float linear;  // 1/unit
  float square;  // 1/unit^2
};
FB_FN float haze_depth(Haze h, float distance) { return (h.linear + h.square * distance) * distance; }
FB_FN float haze_left(Haze h, float distance) { return exp(-haze_depth(h, distance)); }
FB_FN float haze_opacity(Haze h, float distance) { return one_minus_exp(haze_depth(h, distance)); }
// What interacts there, 1/unit, of what has come there.
FB_FN float haze_density(Haze h, float distance) { return h.linear + 2.0f * h.square * distance; }
// Mean distance at which light interacts, of what does so before reach; of the square's law to a few per cent, between
// two thirds of a thin way and half the root of pi over `square`.
FB_FN float haze_mean(Haze h, float reach) {
  if (!(h.square > 0.0f)) return mean_interaction(h.linear, reach);
  float thin = 2.0f / 3.0f * reach, thick = 0.8862269f / sqrt(h.square);
  float a = thin * thin, b = thick * thick;
  return thin * thick / sqrt(sqrt(a * a + b * b));
}

// How much of fog's own light is before what is seen at a distance. Quake mixes the bytes that displays decode, by
// exp(-(density z / 64)^2); as light, leaving T^p of what is behind and adding (1 - T)^p of the fog is nearest to that
// (p 1.4: 0.2 to 0.36 stops for all colours of fog and walls; p 1: 0.2 to 0.8).
FB_CONST float kDisplayedMix = 1.4f;
FB_FN float haze_covers(Haze h, float distance) {
  float depth = haze_depth(h, distance);
  return h.square > 0.0f ? pow(one_minus_exp(depth / kDisplayedMix), kDisplayedMix) : one_minus_exp(depth);
}

// A distance of density proportional to what interacts there by the square's law: 2 square t exp(-square t^2), cut off
// at reach. -log(1 - v) where v is small is its series.
FB_FN float sample_square_law(float square, float reach, float u) {
  float v = u * one_minus_exp(square * reach * reach);
  float depth = v < 0.02f ? v * (1.0f + v * (0.5f + v * (1.0f / 3.0f + 0.25f * v))) : -log(1.0f - v);
  return min(sqrt(depth / square), reach);
}
FB_FN float pdf_square_law(float square, float reach, float distance) {
  return 2.0f * square * distance * exp(-square * distance * distance) /
         max(one_minus_exp(square * reach * reach), 1e-30f);
}

// --- Angles. Vulkan allows atan 4096 units in the last place (Mesa takes 2e-5), and sin an absolute error only. ---
// Angle of (x, y) from the x axis for y >= 0, in [0, pi], not both 0. Minimax polynomial of ours, relative error 2e-8.
FB_FN float angle_above_axis(float x, float y) {
  float m = min(abs(x), y) / max(abs(x), y), z = m * m;
  float a = 1.0f +
            z * (-0.333331527f +
                 z * (0.199937728f +
                      z * (-0.142110552f +
                           z * (0.106660042f + z * (-0.0755221344f +
                                                    z * (0.0432118519f + z * (-0.016367923f + z * 0.00292069109f)))))));
  a *= m;
  a = y > abs(x) ? 0.5f * kVmfPi - a : a;
  return x < 0.0f ? kVmfPi - a : a;
}
// sin(x) for 0 <= x <= pi/2. Minimax polynomial of ours, relative error 6e-9.
FB_FN float sine_of_quarter(float x) {
  float z = x * x;
  return x * (1.0f + z * (-0.166666596f + z * (0.00833306625f + z * (-0.000198096029f + z * 2.60578064e-06f))));
}

// A segment as a point light sees it.
struct EquiAngular {
  float along;  // distance along the ray of the point closest to the light; may be negative or beyond reach
  float apart;  // the light's distance from the ray, at least kLeastApart
  float angle;  // that the segment takes up, seen from the light, radians; positive
  float reach;
};
// Where the light is on the ray the density would be infinite there. A light no nearer to the ray than this, and than
// 2^-14 of its distance, is sampled as it is; a nearer one as if it was this far: the density is as exact, and bounded.
// A distance is rounded to 2^-21 of itself, which is then 1% of what the density's peak is wide.
FB_CONST float kLeastApart = 0.001f;
FB_FN EquiAngular equi_angular_about(float along, float apart, float reach) {
  EquiAngular e;
  e.along = along;
  e.apart = apart;
  e.reach = max(reach, 1e-20f);
  // From cross and dot of the vectors to both ends, where the difference of two angles would cancel.
  e.angle = angle_above_axis(e.apart * e.apart - e.along * (e.reach - e.along), e.apart * e.reach);
  return e;
}
// light: from the segment's start. direction: unit.
FB_FN EquiAngular equi_angular(vec3 light, vec3 direction, float reach) {
  float along = dot(light, direction);
  float least = max(kLeastApart, length(light) * (1.0f / 16384.0f));
  return equi_angular_about(along, max(length(light - direction * along), least), reach);
}
// The distance at which u in [0, 1) of the angle is behind. The law of sines gives it from the start, so that a short
// way keeps its digits; the rest is as if u was off by a rounding.
FB_FN float sample_equi_angular(EquiAngular e, float u) {
  float turn = 0.5f * u * e.angle;  // half of what is behind
  float s = sine_of_quarter(turn), c = sine_of_quarter(0.5f * kVmfPi - turn);
  float sine = 2.0f * s * c, cosine = (c - s) * (c + s);
  float far = (e.apart * e.apart + e.along * e.along) * sine;
  return min(far / max(e.apart * cosine + e.along * sine, far / e.reach), e.reach);
}
FB_FN float pdf_equi_angular(EquiAngular e, float distance) {
  float d = distance - e.along;
  return e.apart / (e.angle * (e.apart * e.apart + d * d));
}

// All together: a share of the samples about where light was found to come from, of the others a share about the light,
// the rest by transmittance. Dividing by the density of the mix is the balance heuristic with one sample (Veach and
// Guibas 1995).
struct DistanceMix {
  EquiAngular light, known;
  float sigma;
  float square;  // positive: by this law (Haze) in place of transmittance
  float reach;
  float share;        // about the light, 0 to 1, of those that are not guided
  float known_share;  // guided, 0 to 1
};
FB_FN DistanceMix distance_mix(float sigma, float reach, float share, vec3 light, vec3 direction) {
  DistanceMix m;
  m.light = equi_angular(light, direction, reach);
  m.sigma = sigma;
  m.square = 0.0f;
  m.reach = reach;
  m.share = share;
  m.known = m.light;
  m.known_share = 0.0f;
  return m;
}
// Guided by a mean distance from the segment's start and a spread about it, positive. A light so far from the ray would
// give that density (Cauchy's, cut off at both ends), whose tails forgive a spread that is too small.
FB_FN DistanceMix guided_distances(DistanceMix m, float mean, float spread, float share) {
  m.known = equi_angular_about(mean, max(spread, kLeastApart), m.reach);
  m.known_share = share;
  return m;
}
FB_FN float sample_distance(DistanceMix m, float u0) {
  bool guided = u0 < m.known_share;
  float u = guided ? u0 / max(m.known_share, 1e-20f) : (u0 - m.known_share) / max(1.0f - m.known_share, 1e-20f);
  bool about = u < m.share;
  float v = about ? u / max(m.share, 1e-20f) : (u - m.share) / max(1.0f - m.share, 1e-20f);
  const float kBelowOne = 1.0f - 1.0f / 16777216.0f;
  v = min(v, kBelowOne);
  if (guided) return min(sample_equi_angular(m.known, min(u, kBelowOne)), m.reach);
  float d = about             ? sample_equi_angular(m.light, v)
            : m.square > 0.0f ? sample_square_law(m.square, m.reach, v)
                              : sample_transmittance(m.sigma, m.reach, v);
  return min(d, m.reach);
}
FB_FN float pdf_distance(DistanceMix m, float distance) {
  // Not mix(): a device may take it as a + share (b - a), which leaves nothing of the smaller one.
  float by_transmittance =
      m.square > 0.0f ? pdf_square_law(m.square, m.reach, distance) : pdf_transmittance(m.sigma, m.reach, distance);
  float p = (1.0f - m.share) * by_transmittance + m.share * pdf_equi_angular(m.light, distance);
  return m.known_share > 0.0f ? (1.0f - m.known_share) * p + m.known_share * pdf_equi_angular(m.known, distance) : p;
}

FB_NAMESPACE_END
#endif
