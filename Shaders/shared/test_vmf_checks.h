// What the von Mises-Fisher distribution is held to, on the host and through the shader alike.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/rng.h"
#include "base/test_chi_squared.h"
#include "shared/test_vmf_errors.h"

namespace fb::shared {

inline void expect_within(const WorstError& worst, const char* what, const char* kappa) {
  EXPECT_LE(worst.of_bound, 1) << what << " at kappa " << kappa << " is off by " << worst.error;
}

// Every error against the bound that rounding error analysis gives it.
inline void check_vmf_errors(const VmfEvaluate& evaluate, const VmfPrecision& precision) {
  for (const auto& [kappa, name] : kVmfTestKappas) {
    expect_within(vmf_pdf_error(evaluate, precision, kappa, 1), "pdf", name);
    expect_within(vmf_pdf_error(evaluate, precision, kappa, 80), "pdf's tail", name);
    expect_within(vmf_integral_error(evaluate, precision, kappa), "integral", name);
    expect_within(vmf_inverse_cdf_error(evaluate, precision, kappa), "inverse CDF", name);
    const VmfSampleErrors sample = vmf_sample_errors(evaluate, precision, kappa);
    expect_within(sample.t, "sampled cosine", name);
    expect_within(sample.azimuth, "sampled azimuth", name);
    expect_within(sample.length, "length of a sample", name);
    expect_within(sample.mean, "mean cosine of samples", name);
    expect_within(sample.second, "second moment of samples", name);
    if (kappa <= kVmfMaxKappa) {
      EXPECT_LT(sample.density, 0.01) << "float32 directions resolve kappa " << name;
    }
  }
}

inline void check_vmf_inversion(const VmfEvaluate& evaluate, const VmfPrecision& precision) {
  for (std::size_t i = 0; i + 1 < kVmfTestRanges.size(); ++i) {
    const auto& [low, name] = kVmfTestRanges[i];
    const VmfInversionErrors errors = vmf_inversion_errors(evaluate, precision, low, kVmfTestRanges[i + 1].first);
    expect_within(errors.complement, "1 - mean cosine", name);
    expect_within(errors.kappa[0], "vmf_kappa", name);
    expect_within(errors.kappa[1], "vmf_kappa_fit", name);
    expect_within(errors.kappa[2], "vmf_kappa_newton", name);
  }
  // The ends: c = 0, below the narrowest lobe's, and 1.
  const vec3 z(0, 0, 1);
  const auto ends = evaluate({vmf_query(z, 1, z, vec2(0), 0.0f), vmf_query(z, 1, z, vec2(0), 1e-30f),
                              vmf_query(z, 1, z, vec2(0), 1.0f), vmf_query(z, 1, z, vec2(0), 0x1.fffffep-1f)});
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 2; ++j) EXPECT_NEAR(ends[static_cast<std::size_t>(j)].kappa[i] / kVmfMaxKappa, 1, 1e-6);
    EXPECT_EQ(ends[2].kappa[i], 0.0f);
    EXPECT_NEAR(ends[3].kappa[i] / (3 * kRoundoff), 1, 1e-3);
  }
}

// Finite, unit and in range whatever the exponent of kappa and whatever u, also at mu's own antipode.
inline void check_vmf_is_finite(const VmfEvaluate& evaluate) {
  std::vector<VmfQuery> queries;
  for (int exponent = -126; exponent <= 99; ++exponent) {
    for (const float u : {0.0f, 0x1p-126f, 0x1p-24f, 0.25f, 0.5f, 0.75f, 0x1.fffffep-1f}) {
      for (const vec3 mu : vmf_test_means()) {
        queries.push_back(vmf_query(mu, std::ldexp(1.0f, exponent), mu, vec2(u, 1 - u == 1 ? 0 : u)));
        queries.push_back(vmf_query(mu, std::ldexp(1.0f, exponent), -mu, vec2(u, 0x1.fffffep-1f)));
      }
    }
  }
  // Here the last u's 1 - cosine rounds to more than 2.
  for (const float kappa : {0x1.73971cp-3f, 0x1.547e64p-2f, 0x1.a0afb6p-3f}) {
    queries.push_back(vmf_query(vec3(0, 0, 1), kappa, vec3(0, 0, 1), vec2(0x1.fffffep-1f, 0.25f)));
  }
  const auto answers = evaluate(queries);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const VmfAnswer& a = answers[i];
    const float kappa = queries[i].mu_kappa.w;
    const vec3 w(a.sample_t.x, a.sample_t.y, a.sample_t.z);
    ASSERT_NEAR(static_cast<double>(reference::length(w)), 1, 9 * kRoundoff) << kappa << " " << queries[i].u.x;
    ASSERT_TRUE(a.sample_t.w >= 0 && a.sample_t.w <= 2) << kappa << " " << queries[i].u.x;
    for (int j = 0; j < 4; ++j) ASSERT_TRUE(std::isfinite(a.pdf[j]) && a.pdf[j] >= 0) << kappa << " " << j;
    ASSERT_LE(a.pdf.z, 1.0f);
    if (queries[i].u.x == 0) {
      ASSERT_NEAR(length(w - vmf_mu(queries[i])), 0, 4 * kRoundoff) << "u = 0 is mu";
    }
  }
}

// Pearson's statistic of the sampler over 16 x 32 cells of t and azimuth that the exact lobe hits equally often,
// against the integral of vmf_pdf over them; at a false-alarm rate of 1e-5.
constexpr int kVmfCellsT = 16, kVmfCellsPhi = 32, kVmfCells = kVmfCellsT * kVmfCellsPhi;

inline std::vector<double> vmf_cell_masses(const VmfEvaluate& evaluate, vec3 mu, float kappa) {
  constexpr int kFineT = 16, kFinePhi = 4, kAllT = kVmfCellsT * kFineT, kAllPhi = kVmfCellsPhi * kFinePhi;
  std::vector<VmfQuery> queries;
  std::vector<reference::Real> solid_angle;
  for (int i = 0; i < kAllT * kAllPhi; ++i) {
    const reference::Real t = reference::inverse_cdf(kappa, (i / kAllPhi + 0.5L) / kAllT);
    const reference::Real phi = ((i % kAllPhi + 0.5L) / kAllPhi * 2 - 1) * reference::kPi;
    queries.push_back(vmf_query(mu, kappa, reference::rounded(reference::direction_about(mu, t, phi))));
    solid_angle.push_back(1 / reference::pdf_of_t(kappa, t) / (kAllT * kAllPhi));
  }
  const auto answers = evaluate(queries);
  std::vector<double> masses(kVmfCells, 0.0);
  for (int i = 0; i < kAllT * kAllPhi; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const int cell = i / kAllPhi / kFineT * kVmfCellsPhi + i % kAllPhi / kFinePhi;
    masses[static_cast<std::size_t>(cell)] += static_cast<double>(answers[at].pdf.x * solid_angle[at]);
  }
  return masses;
}

inline int vmf_cell_of(vec3 mu, float kappa, vec3 w) {
  const reference::Vector direction = reference::unit(w);
  const reference::Real x = reference::dot(direction, reference::direction_about(mu, 1, 0));
  const reference::Real y = reference::dot(direction, reference::direction_about(mu, 1, reference::kPi / 2));
  const reference::Real u = reference::cdf(kappa, reference::one_minus_cosine(mu, w));
  const reference::Real v = std::atan2(y, x) / (2 * reference::kPi) + 0.5L;
  return std::clamp(static_cast<int>(u * kVmfCellsT), 0, kVmfCellsT - 1) * kVmfCellsPhi +
         std::clamp(static_cast<int>(v * kVmfCellsPhi), 0, kVmfCellsPhi - 1);
}

inline void check_vmf_chi_squared(const VmfEvaluate& evaluate, vec3 mu, float kappa, const char* name) {
  constexpr int kDraws = 200000;
  Rng rng(11);
  std::vector<VmfQuery> queries;
  for (int i = 0; i < kDraws; ++i) queries.push_back(vmf_query(mu, kappa, mu, vec2(rng.uniform(), rng.uniform())));
  std::vector<double> seen(kVmfCells, 0.0);
  for (const VmfAnswer& answer : evaluate(queries)) {
    const vec3 w(answer.sample_t.x, answer.sample_t.y, answer.sample_t.z);
    seen[static_cast<std::size_t>(vmf_cell_of(mu, kappa, w))] += 1;
  }
  const std::vector<double> masses = vmf_cell_masses(evaluate, mu, kappa);
  ChiSquared test;
  for (std::size_t i = 0; i < seen.size(); ++i) test.add(masses[i] * kDraws, seen[i]);
  EXPECT_GT(test.p(), 1e-5) << "kappa " << name;
}

inline void check_vmf_sampler_follows_pdf(const VmfEvaluate& evaluate) {
  const auto means = vmf_test_means();
  std::size_t mean = 0;
  for (const auto& [kappa, name] : kVmfTestKappas) {
    if (kappa <= kVmfMaxKappa) check_vmf_chi_squared(evaluate, means[mean++ % means.size()], kappa, name);
  }
}

}  // namespace fb::shared
