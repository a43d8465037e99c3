// shared/phase.h against its definition in long double, integrated numerically: nothing here uses the CDFs of the
// header.
#include "shared/phase.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/rng.h"
#include "base/test_chi_squared.h"
#include "shared/test_quadrature.h"
#include "shared/test_vmf_errors.h"

namespace fb::shared {
namespace {

using reference::Real;
constexpr std::array kPhaseG{-0.999f, -0.9f, -0.3f, 0.0f, 1e-6f, -1e-20f, 1e-3f, 0.3f, 0.6f, 0.9f, 0.999f};
constexpr std::array kPhaseAlpha{0.0f, 0.5f, 1.0f, 5.0f, 30.0f, 100.0f};

// 2 pi times the density, from t = 1 - side * cosine.
Real phase_density(PhaseFunction p, Real t) {
  const Real a = std::abs(p.g), c = 1 - t, d = (1 - a) * (1 - a) + 2 * a * t;
  return (1 - a * a) * (1 + p.alpha * c * c) / (2 * (1 + p.alpha * (1 + 2 * a * a) / 3) * d * std::sqrt(d));
}

// Integral of f(t) from low to high; where the lobe is narrow by r, one over the root of the denominator.
template <typename F>
Real integrate_phase(PhaseFunction p, F f, Real low, Real high, int panels) {
  const Real a = std::abs(p.g), b = (1 - a) * (1 - a);
  if (a < 0.1L) return integrate(f, low, high, panels);
  const auto by_r = [&](Real r) { return f((1 / (r * r) - b) / (2 * a)) / (a * r * r * r); };
  return integrate(by_r, 1 / std::sqrt(b + 2 * a * high), 1 / std::sqrt(b + 2 * a * low), panels);
}

template <typename F>
void for_each_phase(F f) {
  for (const float g : kPhaseG) {
    for (const float alpha : kPhaseAlpha) {
      SCOPED_TRACE(testing::Message() << "g " << g << " alpha " << alpha);
      f(phase_function(g, alpha));
    }
  }
}

TEST(Phase, IntegratesToOneWithItsMeanCosine) {
  for_each_phase([](PhaseFunction p) {
    const auto eval = [&](Real t) {
      return 2 * reference::kPi * static_cast<Real>(phase_eval_t(p, static_cast<float>(t)));
    };
    EXPECT_NEAR(static_cast<double>(integrate_phase(p, eval, 0, 2, 2000)), 1, 16 * kRoundoff);
    const Real mean = phase_side(p) * integrate_phase(
                                          p, [&](Real t) { return (1 - t) * eval(t); }, 0, 2, 2000);
    EXPECT_NEAR(static_cast<double>(mean), phase_mean_cosine(p), 16 * kRoundoff);
  });
}

// 3 roundings of the squared 1 - a, 2 more of the denominator, half as much again and 2 of its power; 5 of N, 5 of the
// numerator, 5 of products and the division.
TEST(Phase, IsWithinItsErrorBound) {
  for_each_phase([](PhaseFunction p) {
    for (int i = 0; i < 2000; ++i) {
      const float t = 2 * std::pow(10.0f, -10.0f * (static_cast<float>(i) / 2000));
      const Real exact = phase_density(p, t) / (2 * reference::kPi);
      ASSERT_NEAR(static_cast<double>(phase_eval_t(p, t) / exact), 1, 25 * kRoundoff) << t;
      ASSERT_EQ(phase_eval(p, phase_side(p) * (1 - t)), phase_eval_t(p, 1 - (1 - t)));
    }
  });
}

// The mass up to the point that u gives is u. A u near 1 is itself no closer than its rounding.
TEST(Phase, InverseCdfInvertsTheIntegral) {
  for_each_phase([](PhaseFunction p) {
    constexpr int kSteps = 4096;
    Real mass = 0, before = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const float u = i < kSteps ? static_cast<float>(i) / kSteps : 0x1.fffffep-1f;
      const PhasePoint at = phase_inverse_cdf(p, u);
      ASSERT_GE(static_cast<Real>(at.t), before) << "monotonic";
      mass += integrate_phase(
          p, [&](Real t) { return phase_density(p, t); }, before, at.t, 8);
      before = at.t;
      ASSERT_NEAR(static_cast<double>(mass), u, 16 * kRoundoff) << "alpha " << p.alpha;
      if (at.rest < 0.01f) {
        ASSERT_NEAR(at.rest, 2 - at.t, 16 * kRoundoff);
      }
    }
  });
}

// Small t to relative precision: narrow lobes keep their shape.
TEST(Phase, TheMiddleOfALobeIsNotQuantised) {
  for (const float alpha : kPhaseAlpha) {
    const PhaseFunction p = phase_function(0.999f, alpha);
    for (const float u : {1e-30f, 1e-12f, 1e-6f, 1e-4f}) {
      const Real t = phase_inverse_cdf(p, u).t;
      const Real mass = integrate([&](Real x) { return phase_density(p, x); }, 0, t, 8);
      EXPECT_NEAR(static_cast<double>(mass / u), 1, 64 * kRoundoff) << u;
    }
  }
}

// Directions in 64 cells of t, equally likely under Henyey and Greenstein's, times 8 of azimuth.
TEST(Phase, SamplerFollowsTheDensity) {
  constexpr int kCells = 64, kSectors = 8, kDraws = 100000;
  const vec3 forward = normalize(vec3(0.6f, -0.48f, 0.64f));
  Rng rng(21);
  for_each_phase([&](PhaseFunction p) {
    const PhaseFunction plain = phase_function(p.g, 0);
    std::vector<Real> edges;
    for (int i = 1; i < kCells; ++i) edges.push_back(phase_inverse_cdf(plain, static_cast<float>(i) / kCells).t);
    std::vector<double> seen(kCells * kSectors, 0.0);
    const vec3 axis = forward * phase_side(p), x = normalize(cross(axis, vec3(0, 0, 1))), y = cross(axis, x);
    for (int i = 0; i < kDraws; ++i) {
      const vec3 w = phase_sample(p, forward, {rng.uniform(), rng.uniform()});
      const Real t = reference::one_minus_cosine(axis, w);
      const auto cell = std::upper_bound(edges.begin(), edges.end(), t) - edges.begin();
      const double turn = std::atan2(dot(w, y), dot(w, x)) / (2 * kVmfPi) + 0.5;
      const int sector = std::clamp(static_cast<int>(turn * kSectors), 0, kSectors - 1);
      seen[static_cast<std::size_t>(cell) * kSectors + static_cast<std::size_t>(sector)] += 1;
    }
    ChiSquared test;
    for (int i = 0; i < kCells; ++i) {
      const Real low = i == 0 ? 0 : edges[static_cast<std::size_t>(i - 1)];
      const Real high = i == kCells - 1 ? 2 : edges[static_cast<std::size_t>(i)];
      const auto eval = [&](Real t) { return static_cast<Real>(phase_eval_t(p, static_cast<float>(t))); };
      const Real mass = 2 * reference::kPi * integrate_phase(p, eval, low, high, 16);
      for (int j = 0; j < kSectors; ++j) {
        test.add(static_cast<double>(mass) * kDraws / kSectors,
                 seen[static_cast<std::size_t>(i) * kSectors + static_cast<std::size_t>(j)]);
      }
    }
    EXPECT_GT(test.p(), 1e-5) << test.statistic() << " of " << test.degrees();
  });
}

// 9 roundings are of lengths and the product, 16 of t where it is near 2.
TEST(Phase, CosinesAndDirectionsAreTheSameSamples) {
  Rng rng(22);
  for_each_phase([&](PhaseFunction p) {
    for (int i = 0; i < 100; ++i) {
      const vec3 forward = vmf_sample(vec3(0, 0, 1), 0, {rng.uniform(), rng.uniform()});
      const vec2 u(rng.uniform(), rng.uniform());
      const vec3 w = phase_sample(p, forward, u);
      ASSERT_NEAR(dot(forward, w), phase_sample_cosine(p, u.x), 25 * kRoundoff);
      ASSERT_NEAR(phase_eval_about(p, forward, w) / phase_eval_about(p, w, forward), 1, 8 * kRoundoff) << "reciprocal";
    }
  });
}

TEST(Phase, KnownValues) {
  EXPECT_NEAR(phase_eval(phase_function(0, 0), 0.3f), 0.25 / reference::kPi, 1e-8);
  EXPECT_NEAR(phase_eval(phase_function(0, 1), 0.5f), 3 / (16 * reference::kPi) * 1.25L, 1e-8) << "Rayleigh";
  EXPECT_NEAR(phase_eval(phase_function(0.5f, 0), 1.0f), 0.75L / (4 * reference::kPi * 0.125L), 1e-7);
  EXPECT_GT(phase_sample_cosine(phase_function(0.9f, 1), 0.1f), 0.9f) << "forwards is along the direction of travel";
  EXPECT_LT(phase_sample_cosine(phase_function(-0.9f, 1), 0.1f), -0.9f);
}

TEST(Phase, IsFiniteEverywhere) {
  for (const float g : {-2.0f, -1.0f, -0.999f, -1e-38f, 0.0f, 0x1p-149f, 0.5f, 1.0f, 1e30f}) {
    for (const float alpha : {-1.0f, 0.0f, 1e-30f, 1.0f, 1e30f}) {
      const PhaseFunction p = phase_function(g, alpha);
      for (const float u : {0.0f, 0x1p-149f, 0x1p-24f, 0.5f, 0x1.fffffep-1f, 1.0f}) {
        for (const vec3 forward : vmf_test_means()) {
          const vec3 w = phase_sample(p, forward, {u, 1 - u});
          ASSERT_NEAR(static_cast<double>(reference::length(w)), 1, 9 * kRoundoff) << g << " " << alpha << " " << u;
          const float density = phase_eval_about(p, forward, w);
          ASSERT_TRUE(std::isfinite(density) && density > 0) << g << " " << alpha << " " << u;
        }
        ASSERT_LE(std::abs(phase_sample_cosine(p, u)), 1.0f);
      }
      for (const float cosine : {-1.0f, 0.0f, 1.0f, 0x1.000002p0f, -0x1.000002p0f}) {
        const float density = phase_eval(p, cosine);
        ASSERT_TRUE(std::isfinite(density) && density > 0) << g << " " << alpha << " " << cosine;
      }
    }
  }
}

}  // namespace
}  // namespace fb::shared
