// Mixtures of Gaussians over all directions (Pantaleoni 2020, Section 2.6.1): density, sampling, and how stepwise
// expectation maximisation (Vorba 2014) learns them from weighted samples. C++ and GLSL.
//
// Gaussians are over the square of the equal-area map of the sphere (shared/equal_area.h). What lies beyond the square
// is no direction, which the paper does not speak of: x is of a Gaussian that is cut off at -1 and 1, then y, given x,
// of another one. So a mixture's density adds up to one over all directions, as a control variate of it wants (Eq. 27).
// Learning is of whole Gaussians.
#ifndef FB_PSTF_GAUSSIANS_H
#define FB_PSTF_GAUSSIANS_H
#include "shared/equal_area.h"
FB_NAMESPACE_BEGIN

FB_CONST uint kMostGaussians = 8u;

// One of a mixture, as paths read it: 32 bytes, of which six numbers are its own.
struct Gaussian {
  float scale;      // weight over all that does not hang on the place: times the exponential over y's part it is the
                    // density per steradian
  float x, over_x;  // mean; 1 / (sqrt(2) standard deviation), as in the other one
  float y, over_y;  // at the mean of x
  float slope;      // of y's mean over x
  float weight;
  float seen;  // of a mixture's first: samples that taught it
};

// What samples of one Gaussian add up to: the eight columns of Eq. 17. Shares are of responsibility, weight and step.
struct GaussianSums {
  vec4 a;  // share; share times x, y, x x
  vec4 b;  // share times y y, x y; weight of all Gaussians' samples; their number
};

FB_FN GaussianSums no_sums() {
  GaussianSums s;
  s.a = vec4(0.0f);
  s.b = vec4(0.0f);
  return s;
}

// Within 1.5e-7 (Abramowitz and Stegun, 7.1.26).
FB_FN float error_function(float x) {
  float size = abs(x), t = 1.0f / (1.0f + 0.3275911f * size);
  float sum = t * (0.254829592f + t * (-0.284496736f + t * (1.421413741f + t * (-1.453152027f + t * 1.061405429f))));
  float e = 1.0f - sum * exp(-size * size);
  return x < 0.0f ? -e : e;
}
FB_CONST float kTwoOverRootPi = 1.1283791670955126f;
// Its inverse: a closed form within 4e-3 (Winitzki 2008), then one step of Halley's.
FB_FN float inverse_error_function(float e) {
  const float a = 0.147f;
  float inside = clamp(e, -0.9999999f, 0.9999999f), l = log((1.0f - inside) * (1.0f + inside));
  float t = 2.0f / (kSpherePi * a) + 0.5f * l;
  float z = sqrt(max(sqrt(t * t - l / a) - t, 0.0f));
  z = inside < 0.0f ? -z : z;
  float step = clamp((error_function(z) - inside) / (kTwoOverRootPi * exp(-z * z)), -0.05f, 0.05f);
  return z - step / (1.0f + z * step);
}

// --- Density and sampling ---
// The mean of y at x is held to the square, so that never but a tail is cut off.
FB_FN float middle_at(Gaussian g, float x) { return clamp(g.y + g.slope * (x - g.x), -1.0f, 1.0f); }
// Of what lies within [-1, 1], times two.
FB_FN float whole_of(float mean, float over) {
  return error_function((1.0f - mean) * over) + error_function((1.0f + mean) * over);
}
// Per steradian, times its weight; p in [-1, 1]^2.
FB_FN float gaussian_density(Gaussian g, vec2 p) {
  float middle = middle_at(g, p.x), u = (p.x - g.x) * g.over_x, v = (p.y - middle) * g.over_y;
  return g.scale * exp(-(u * u + v * v)) / max(whole_of(middle, g.over_y), 0.5f);  // a number where none is held, too
}
FB_FN float cut_off_draw(float mean, float over, float u) {
  float least = error_function((-1.0f - mean) * over), most = error_function((1.0f - mean) * over);
  return clamp(mean + inverse_error_function(mix(least, most, u)) / over, -1.0f, 1.0f);
}
// A place of the square; u in [0, 1)^2.
FB_FN vec2 gaussian_draw(Gaussian g, vec2 u) {
  float x = cut_off_draw(g.x, g.over_x, u.x);
  return vec2(x, cut_off_draw(middle_at(g, x), g.over_y, u.y));
}

// --- Learning ---
// A mixture begins as a grid: two rows of half as many.
FB_FN vec2 first_mean(uint i, uint count) {
  uint wide = count / 2u;
  return vec2((2.0f * float(i % wide) + 1.0f) / float(wide) - 1.0f, float(i / wide) - 0.5f);
}
FB_CONST float kFirstDeviation = 0.4f;   // of each,
FB_CONST float kPriorSamples = 2.0f;     // which is worth so many samples' means,
FB_CONST float kPriorVariance = 0.02f;   // so much variance in so many,
FB_CONST float kPriorWeight = 0.5f;      // and so many beside all samples' weights
FB_CONST float kLeastDeviation = 0.02f;  // samples' places are known to 1/128
FB_CONST float kMostDeviation = 1.0f;

FB_FN Gaussian gaussian_from(float weight, vec2 mean, float xx, float yy, float xy) {
  const float least = kLeastDeviation * kLeastDeviation, most = kMostDeviation * kMostDeviation;
  Gaussian g;
  xx = clamp(xx, least, most);
  g.weight = weight;
  g.x = clamp(mean.x, -1.0f, 1.0f);
  g.y = clamp(mean.y, -1.0f, 1.0f);
  g.slope = xy / xx;
  g.over_x = 1.0f / sqrt(2.0f * xx);
  g.over_y = 1.0f / sqrt(2.0f * clamp(yy - g.slope * xy, least, most));
  // Densities of x and of y have 2 / sqrt(pi) each; 1 of the square is pi of the sphere.
  g.scale = weight * kTwoOverRootPi * kTwoOverRootPi / kSpherePi * g.over_x * g.over_y / whole_of(g.x, g.over_x);
  g.seen = 0.0f;
  return g;
}
FB_FN Gaussian first_gaussian(uint i, uint count) {
  const float variance = kFirstDeviation * kFirstDeviation;
  return gaussian_from(1.0f / float(count), first_mean(i, count), variance, variance, 0.0f);
}

// The weight of sample i (from 1) against all before it: i^-alpha. Of the first it would be 1, and what is left of
// those before it zero, whose logarithm Eq. 21 would add: numbers begin at 2.
FB_CONST float kStepPower = 0.7f;
FB_FN float gaussian_step(float i) { return exp2(-kStepPower * log2(i + 1.0f)); }

// What a sample adds (v of Eq. 16): `responsibility` of this Gaussian for it, `step` as above.
FB_FN GaussianSums sample_sums(vec2 p, float weight, float responsibility, float step) {
  float b = step * weight, share = b * responsibility;
  GaussianSums s;
  s.a = share * vec4(1.0f, p.x, p.y, p.x * p.x);
  s.b = vec4(share * p.y * p.y, share * p.x * p.y, b, 1.0f);
  return s;
}
// Eq. 16: what is left of those before, and the new one.
FB_FN GaussianSums joined_sums(GaussianSums before, float left, GaussianSums now) {
  GaussianSums s;
  s.a = before.a * left + now.a;
  s.b = before.b * left + now.b;
  return s;
}
// Eq. 18, of densities; even where all of them are far away.
FB_CONST float kFarDensity = 1e-20f;
FB_FN float responsibility_of(float density, float all, uint count) {
  return (density + kFarDensity) / (all + float(count) * kFarDensity);
}

// The M-step: the most likely Gaussian, with a prior that counts as a few samples.
FB_FN Gaussian learnt_gaussian(GaussianSums s, uint i, uint count) {
  float samples = s.b.w, share = s.b.z > 0.0f ? s.a.x / s.b.z : 0.0f, own = samples * share;
  vec2 first = first_mean(i, count), mean = first;
  float xx = 0.0f, yy = 0.0f, xy = 0.0f;
  if (s.a.x > 0.0f) {
    mean = vec2(s.a.y, s.a.z) / s.a.x;
    xx = max(s.a.w / s.a.x - mean.x * mean.x, 0.0f);
    yy = max(s.b.x / s.a.x - mean.y * mean.y, 0.0f);
    xy = s.b.y / s.a.x - mean.x * mean.y;
  }
  float prior = kPriorSamples * kPriorVariance, all = 1.0f / (own + kPriorSamples);
  return gaussian_from((own + kPriorWeight) / (samples + kPriorWeight * float(count)),
                       (mean * own + first * kPriorSamples) * all, (own * xx + prior) * all, (own * yy + prior) * all,
                       own * xy * all);
}

// --- Samples of a frame ---
// A cell has places for so many, of which each keeps one of those that want it: by a lot, as one maximum of words, so
// that it is the same in whatever order they come. Who asks for places cell by cell has sorted them.
FB_CONST uint kGaussianPlaces = 32u;
// Lot (6 bits), weight's logarithm (10), y and x (8 each). Zero: none.
FB_CONST float kLeastWeightLog = -20.0f, kWeightLogSteps = 1022.0f / 28.0f;  // up to 2^8: kPstfLargest
FB_FN uint sample_word(vec2 p, float weight, float round_up, uint lot) {
  if (!(weight > 0.0f)) return 0u;
  float steps = (log2(weight) - kLeastWeightLog) * kWeightLogSteps;
  if (!(steps >= 0.0f)) return 0u;
  uint x = uint(clamp((p.x + 1.0f) * 128.0f, 0.0f, 255.0f)), y = uint(clamp((p.y + 1.0f) * 128.0f, 0.0f, 255.0f));
  return (lot & 63u) << 26u | (1u + uint(min(steps + round_up, 1022.0f))) << 16u | y << 8u | x;
}
FB_FN float word_weight(uint word) {
  uint steps = (word >> 16u) & 1023u;
  return steps == 0u ? 0.0f : exp2(float(steps - 1u) / kWeightLogSteps + kLeastWeightLog);
}
FB_FN vec2 word_place(uint word) {
  return (vec2(float(word & 255u), float((word >> 8u) & 255u)) + vec2(0.5f)) / 128.0f - vec2(1.0f);
}

FB_NAMESPACE_END
#endif
