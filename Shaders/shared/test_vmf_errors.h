// Measures shared/vmf.h, as some machine computes it, against the long double reference. The errors are relative unless
// said otherwise; each comes with the bound that rounding error analysis gives it (Misc/docs/numerics.md derives them).
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "shared/test_vmf_probe.h"
#include "shared/test_vmf_reference.h"

namespace fb::shared {

using VmfEvaluate = std::function<std::vector<VmfAnswer>(const std::vector<VmfQuery>&)>;
inline std::vector<VmfAnswer> vmf_evaluate_on_host(const std::vector<VmfQuery>& queries) {
  std::vector<VmfAnswer> answers;
  answers.reserve(queries.size());
  for (const VmfQuery& query : queries) answers.push_back(vmf_probe(query));
  return answers;
}

constexpr double kRoundoff = 0x1p-24;  // of one float32 operation

// How precisely a machine computes, in units of kRoundoff.
struct VmfPrecision {
  double scale;          // vmf_normalization and the two operations after it
  double scale_tail;     // the pdf's further error for each unit of kappa t
  double t;              // vmf_inverse_cdf
  double complement;     // vmf_mean_cosine_complement
  double sine_absolute;  // cos(phi), sin(phi)
};
// exp, log, sin and cos within one unit in the last place.
constexpr VmfPrecision kVmfHostPrecision{9, 6, 10, 8, 2};
// What Vulkan promises: exp 3 + 2 |x| units, log 3, division 2.5; and, of sin and cos, 2^-11.
constexpr VmfPrecision kVmfVulkanPrecision{19, 10, 25, 32, 0x1p13};

// What is tested and tabulated, as numbers and as people write them.
constexpr std::array<std::pair<float, const char*>, 13> kVmfTestKappas{{{0.0f, "0"},
                                                                        {1e-6f, "1e-6"},
                                                                        {1e-3f, "1e-3"},
                                                                        {0.5f, "0.5"},
                                                                        {0x1.fffffep-1f, "just under 1"},
                                                                        {1.0f, "1"},
                                                                        {10.0f, "10"},
                                                                        {100.0f, "100"},
                                                                        {1e4f, "1e4"},
                                                                        {1e6f, "1e6"},
                                                                        {1e8f, "1e8"},
                                                                        {kVmfMaxKappa, "2^32"},
                                                                        {1e12f, "1e12"}}};
constexpr std::array<std::pair<float, const char*>, 7> kVmfTestRanges{{{1e-3f, "1e-3"},
                                                                       {0.1f, "0.1"},
                                                                       {1.0f, "1"},
                                                                       {10.0f, "10"},
                                                                       {100.0f, "100"},
                                                                       {1e4f, "1e4"},
                                                                       {kVmfMaxKappa, "2^32"}}};

inline std::array<vec3, 6> vmf_test_means() {
  return {vec3(0, 0, 1),
          vec3(0, 0, -1),
          vec3(1, 0, 0),
          normalize(vec3(0.6f, -0.48f, 0.64f)),
          normalize(vec3(-1, 2, -3)),
          normalize(vec3(1e-4f, 3e-5f, -1))};
}
inline VmfQuery vmf_query(vec3 mu, float kappa, vec3 w, vec2 u = vec2(0), float c = 0.5f) {
  return {vec4(mu, kappa), vec4(w, c), vec4(u.x, u.y, 0, 0)};
}
inline vec3 vmf_w(const VmfQuery& query) { return {query.w_c.x, query.w_c.y, query.w_c.z}; }
inline vec3 vmf_mu(const VmfQuery& query) { return {query.mu_kappa.x, query.mu_kappa.y, query.mu_kappa.z}; }

struct WorstError {
  double error = 0;     // the largest
  double of_bound = 0;  // the largest in units of its bound
  void add(double e, double bound) {
    raise(error, e);
    raise(of_bound, e / bound);
  }
  // NaN is the worst of all, and stays.
  static void raise(double& worst, double e) {
    if (!(e <= worst) && !std::isnan(worst)) worst = e;
  }
};

// The machine's own functions where shared/vmf.h uses them: exp(-x) to x = 80 and log(x) from 2^-24 to 1/2, relative;
// sin and cos on [-pi, pi], absolute, of the float32 angle. Not held to anything but what follows from them.
struct VmfFunctionErrors {
  double exp = 0, log = 0, sin = 0, cos = 0;
};
inline VmfFunctionErrors vmf_function_errors(const VmfEvaluate& evaluate) {
  constexpr int kSteps = 20000;
  std::vector<VmfQuery> queries;
  for (int i = 0; i < kSteps; ++i) {
    const float part = (static_cast<float>(i) + 0.5f) / kSteps;
    queries.push_back(vmf_query(vec3(0, 0, 1), 1, vec3(0, 0, 1), vec2(0, part)));
    queries.back().u.z = 80 * part;
    queries.back().u.w = std::exp2(-1 - 23 * part);
  }
  const std::vector<VmfAnswer> answers = evaluate(queries);
  VmfFunctionErrors errors;
  const auto raise = [](double& worst, reference::Real e) {
    worst = std::max(worst, static_cast<double>(std::abs(e)));
  };
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const reference::Real x = queries[i].u.z, y = queries[i].u.w, phi = (2.0f * queries[i].u.y - 1.0f) * kVmfPi;
    raise(errors.exp, answers[i].functions.x / std::exp(-x) - 1);
    raise(errors.log, answers[i].functions.y / std::log(y) - 1);
    raise(errors.sin, answers[i].functions.z - std::sin(phi));
    raise(errors.cos, answers[i].functions.w - std::cos(phi));
  }
  return errors;
}

// The pdf where kappa t is at most x_max, over the means, azimuths and angles from 1e-8 to pi. Lengths of mu and w that
// differ from 1 by rounding count as error: they are what a renderer has.
inline WorstError vmf_pdf_error(const VmfEvaluate& evaluate, const VmfPrecision& precision, float kappa, double x_max) {
  std::vector<VmfQuery> queries;
  for (const vec3 mu : vmf_test_means()) {
    for (int i = 0; i < 200; ++i) {
      // Half of them over all angles, half over the lobe.
      const reference::Real t = i % 2 != 0 || kappa == 0 ? 2 * std::pow(10.0L, -16.0L * (i / 2) / 100)
                                                         : std::min(2.0L, x_max * (i / 2 + 0.5L) / 100 / kappa);
      queries.push_back(vmf_query(mu, kappa, reference::rounded(reference::direction_about(mu, t, 0.7L * i))));
    }
  }
  const std::vector<VmfAnswer> answers = evaluate(queries);
  WorstError worst;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const vec3 mu = vmf_mu(queries[i]), w = vmf_w(queries[i]);
    const reference::Real x = kappa * reference::one_minus_cosine(mu, w), exact = reference::pdf(mu, kappa, w);
    if (x > x_max || exact < 0x1p-125L) continue;
    const reference::Real lengths = reference::length(mu) * reference::length(w);
    const reference::Real apart = reference::length(mu) - reference::length(w);
    const double bound = static_cast<double>((precision.scale + precision.scale_tail * x) * kRoundoff +
                                             x * std::abs(lengths - 1) + kappa * apart * apart / 2);
    for (const float pdf : {answers[i].pdf.x, answers[i].pdf.y}) {
      worst.add(static_cast<double>(std::abs(pdf / exact - 1)), bound);
    }
  }
  return worst;
}

// |integral of the pdf over the sphere - 1| by Gauss-Legendre panels in t. A node's direction is rounded to float32;
// the pdf there is brought back to the node by the exact exp(kappa dt), so that what is left is the pdf's own error.
inline WorstError vmf_integral_error(const VmfEvaluate& evaluate, const VmfPrecision& precision, float kappa) {
  constexpr int kPanels = 64, kAzimuths = 4;
  constexpr std::array<reference::Real, 4> kNodes{-0.861136311594052575L, -0.339981043584856265L, 0.339981043584856265L,
                                                  0.861136311594052575L};
  constexpr std::array<reference::Real, 4> kWeights{0.347854845137453857L, 0.652145154862546143L, 0.652145154862546143L,
                                                    0.347854845137453857L};
  const vec3 mu = vmf_test_means()[3];
  const reference::Real top = kappa > 32 ? 64 / static_cast<reference::Real>(kappa) : 2;  // beyond: exp(-64)
  std::vector<VmfQuery> queries;
  std::vector<reference::Real> t, weight;
  for (int i = 0; i < kPanels * 4 * kAzimuths; ++i) {
    const auto node = static_cast<std::size_t>(i / kAzimuths % 4);
    t.push_back((i / kAzimuths / 4 + (kNodes[node] + 1) / 2) * top / kPanels);
    weight.push_back(kWeights[node] / 2 * top / kPanels * 2 * reference::kPi / kAzimuths);
    queries.push_back(
        vmf_query(mu, kappa, reference::rounded(reference::direction_about(mu, t.back(), 1.1L + i * 1.7L))));
  }
  const std::vector<VmfAnswer> answers = evaluate(queries);
  reference::Real integral = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const reference::Real dt = reference::one_minus_cosine(mu, vmf_w(queries[i])) - t[i];
    integral += weight[i] * answers[i].pdf.x * std::exp(kappa * dt);
  }
  // kappa t is 1 in the mean; lengths are within 3 roundings of 1.
  WorstError worst;
  worst.add(static_cast<double>(std::abs(integral - 1)),
            (precision.scale + precision.scale_tail + 6) * kRoundoff + kappa * 18 * kRoundoff * kRoundoff);
  return worst;
}

// The inverse CDF for u from 0 to the last number under 1.
inline std::vector<float> vmf_test_numbers() {
  std::vector<float> u{0, 0x1p-126f, 1e-30f};
  for (int i = 1; i < 64; ++i) {
    u.push_back(static_cast<float>(i) * 0x1p-24f);
    u.push_back(1 - static_cast<float>(i) * 0x1p-24f);
  }
  for (int i = 0; i < 4096; ++i) u.push_back((static_cast<float>(i) + 0.5f) / 4096);
  return u;
}
inline WorstError vmf_inverse_cdf_error(const VmfEvaluate& evaluate, const VmfPrecision& precision, float kappa) {
  std::vector<VmfQuery> queries;
  for (const float u : vmf_test_numbers())
    queries.push_back(vmf_query(vec3(0, 0, 1), kappa, vec3(0, 0, 1), vec2(u, 0)));
  const std::vector<VmfAnswer> answers = evaluate(queries);
  WorstError worst;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const reference::Real exact = reference::inverse_cdf(kappa, queries[i].u.x);
    const reference::Real error = std::abs(answers[i].sample_t.w - exact);
    if (exact < 0x1p-124L)  // half of it, which comes on the way, may be flushed to zero
      worst.add(error <= 0x1p-124L ? 0 : 1, 1e-9);
    else
      worst.add(static_cast<double>(error / exact), precision.t * kRoundoff);
  }
  return worst;
}

// Sampled directions against the exact ones for the same u: 1 - cosine, azimuth, length; and their moments.
struct VmfSampleErrors {
  WorstError t;        // absolute
  WorstError azimuth;  // displacement at the t that was got, absolute
  WorstError length;   // |length - 1|
  double density = 0;  // by how much kappa t, so the logarithm of the density, is off within three deviations
  WorstError mean;     // E[1 - cosine] over a grid of u, against the same in exact arithmetic
  WorstError second;   // E[sin^2], likewise
};
inline VmfSampleErrors vmf_sample_errors(const VmfEvaluate& evaluate, const VmfPrecision& precision, float kappa) {
  std::vector<VmfQuery> queries;
  for (const vec3 mu : vmf_test_means()) {
    int i = 0;
    for (const float u : vmf_test_numbers()) {
      queries.push_back(vmf_query(mu, kappa, mu, vec2(u, static_cast<float>(i++ * 5 % 64) / 64)));
    }
  }
  const std::vector<VmfAnswer> answers = evaluate(queries);
  VmfSampleErrors errors;
  std::array<reference::Real, 4> sums{};
  const double rounding = 6 * kRoundoff;  // of a vector whose parts are each a few operations: 2 a component
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const vec3 mu = vmf_mu(queries[i]), w = {answers[i].sample_t.x, answers[i].sample_t.y, answers[i].sample_t.z};
    const vec2 u(queries[i].u.x, queries[i].u.y);
    const reference::Real t = reference::one_minus_cosine(mu, w), exact = reference::inverse_cdf(kappa, u.x);
    const auto sine = static_cast<double>(std::sqrt(exact * (2 - exact)));
    // The tangential part is too long by the sine's and cosine's error, and t by twice that.
    const double stretch = (precision.t + 2 * precision.sine_absolute + 4) * kRoundoff;
    errors.t.add(static_cast<double>(std::abs(t - exact)),
                 stretch * static_cast<double>(exact) + rounding * sine + rounding * rounding);
    if (kappa * exact <= 4.5L)
      errors.density = std::max(errors.density, static_cast<double>(kappa * std::abs(t - exact)));
    const reference::Vector off = reference::unit(w) - reference::direction_about(mu, t, reference::azimuth(u));
    errors.azimuth.add(static_cast<double>(std::sqrt(reference::dot(off, off))),
                       rounding + (precision.sine_absolute + 4) * kRoundoff * sine);
    errors.length.add(static_cast<double>(std::abs(reference::length(w) - 1)), 9 * kRoundoff);
    sums[0] += t;
    sums[1] += exact;
    sums[2] += t * (2 - t);
    sums[3] += exact * (2 - exact);
  }
  // Rounding moves a direction by about kRoundoff an axis, at random: 4.5 deviations of the sums, and its variance.
  const auto n = static_cast<double>(queries.size());
  const auto noise = [n](reference::Real sum, double factor) {
    const auto of = static_cast<double>(sum);
    return factor * 4.5 * kRoundoff / std::sqrt(of) + factor * kRoundoff * kRoundoff * n / of;
  };
  const double stretch = (precision.t + 2 * precision.sine_absolute + 4) * kRoundoff;
  errors.mean.add(static_cast<double>(std::abs(sums[0] / sums[1] - 1)), stretch + noise(sums[1], std::sqrt(2.0)));
  errors.second.add(static_cast<double>(std::abs(sums[2] / sums[3] - 1)), 2 * stretch + noise(sums[3], 2));
  return errors;
}

// kappa -> complement -> kappa over [low, high], by each of the three inversions; and the complement itself.
struct VmfInversionErrors {
  WorstError complement;
  std::array<WorstError, 3> kappa;  // vmf_kappa, vmf_kappa_fit, vmf_kappa_newton
  double condition = 0;             // relative error of kappa for each of c, at worst
};
constexpr std::array<double, 3> kVmfInversionModelError{0.0494, 0.0009, 1e-6};
inline VmfInversionErrors vmf_inversion_errors(const VmfEvaluate& evaluate, const VmfPrecision& precision, float low,
                                               float high) {
  constexpr int kSteps = 2000;
  std::vector<VmfQuery> queries;
  for (int i = 0; i <= kSteps; ++i) {
    const float kappa = low * std::pow(high / low, static_cast<float>(i) / kSteps);
    queries.push_back(vmf_query(vec3(0, 0, 1), std::min(kappa, high), vec3(0, 0, 1)));
  }
  const std::vector<VmfAnswer> there = evaluate(queries);
  for (std::size_t i = 0; i < queries.size(); ++i) queries[i].w_c.w = there[i].pdf.z;
  const std::vector<VmfAnswer> back = evaluate(queries);
  VmfInversionErrors errors;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const reference::Real kappa = queries[i].mu_kappa.w, exact = reference::mean_cosine_complement(kappa);
    errors.complement.add(static_cast<double>(std::abs(there[i].pdf.z / exact - 1)), precision.complement * kRoundoff);
    const auto condition = static_cast<double>(exact / reference::mean_cosine_slope(kappa));
    errors.condition = std::max(errors.condition, condition);
    const std::array<float, 3> got{back[i].kappa.x, back[i].kappa.y, back[i].kappa.z};
    for (std::size_t j = 0; j < 3; ++j) {
      errors.kappa[j].add(static_cast<double>(std::abs(got[j] / kappa - 1)),
                          kVmfInversionModelError[j] + 2 * precision.complement * kRoundoff * condition);
    }
  }
  return errors;
}

}  // namespace fb::shared
