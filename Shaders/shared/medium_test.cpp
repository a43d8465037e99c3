// shared/medium.h against expm1, log1p and atan in long double, and its samplers against their densities.
#include "shared/medium.h"

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
constexpr std::array kSigmas{0.0f, 1e-30f, 1e-9f, 1e-4f, 0.01f, 1.0f, 10.0f};
constexpr std::array kReaches{1e-6f, 1.0f, 100.0f, 30000.0f, 1e6f};
constexpr std::array kMediumNumbers{0.0f,  0x1p-149f, 1e-30f, 0x1p-24f, 1e-4f,        0.1f,
                                    0.25f, 0.5f,      0.75f,  0.99f,    1 - 0x1p-12f, 0x1.fffffep-1f};

TEST(Medium, OpacityDoesNotCancel) {
  for (int i = -1260; i <= 66; ++i) {
    const float x = std::exp2(static_cast<float>(i) / 10);
    const Real exact = -std::expm1(-static_cast<Real>(x));
    ASSERT_NEAR(static_cast<double>(one_minus_exp(x) / exact), 1, 7 * kRoundoff) << x;
    const Real integral = exact / x;
    ASSERT_NEAR(static_cast<double>(transmittance_integral(x, 1) / integral), 1, 8 * kRoundoff) << x;
    if (x > 0x1p-120f) {
      ASSERT_NEAR(static_cast<double>(opacity(x / 64, 64) / exact), 1, 7 * kRoundoff) << x;
    }
  }
  EXPECT_EQ(one_minus_exp(0), 0);
  EXPECT_EQ(transmittance_integral(0, 30000), 30000);
  EXPECT_EQ(transmittance(0, 1e6f), 1);
  const vec3 colours = transmittance(vec3(0.5f, 0, 1e-3f), 2);
  EXPECT_EQ(colours, vec3(transmittance(0.5f, 2), 1, transmittance(1e-3f, 2)));
}

TEST(Medium, DistancesFollowTransmittance) {
  for (const float sigma : kSigmas) {
    for (const float reach : kReaches) {
      const Real x = static_cast<Real>(sigma) * reach;
      for (const float u : kMediumNumbers) {
        const float d = sample_transmittance(sigma, reach, u);
        ASSERT_TRUE(d >= 0 && d <= reach) << sigma << " " << reach << " " << u;
        const Real exact = x == 0 ? static_cast<Real>(u) * reach : -std::log1p(u * std::expm1(-x)) / sigma;
        ASSERT_NEAR(static_cast<double>(d), static_cast<double>(exact),
                    static_cast<double>(exact) * 13 * kRoundoff + 0x1p-126)
            << sigma << " " << reach << " " << u;
        const float t = transmittance(sigma, d), integral = transmittance_integral(sigma, reach);
        ASSERT_NEAR(t / pdf_transmittance(sigma, reach, d) / integral, 1, 4 * kRoundoff);
        const Real weight = x == 0 ? static_cast<Real>(reach) : -std::expm1(-x) / sigma;
        ASSERT_NEAR(static_cast<double>(integral / weight), 1, 8 * kRoundoff) << sigma << " " << reach;
      }
    }
  }
}

TEST(Medium, QuakesLawIsSampledByWhatItTakes) {
  for (const float square : {1e-16f, 1e-9f, 1e-4f, 1.0f, 100.0f}) {
    for (const float reach : kReaches) {
      const Real all = -std::expm1(-static_cast<Real>(square) * reach * reach);
      for (const float u : kMediumNumbers) {
        const float d = sample_square_law(square, reach, u);
        ASSERT_TRUE(d >= 0 && d <= reach) << square << " " << reach << " " << u;
        // The share of what is taken before it is u, but where float's 1 - v has no digits left.
        const Real before = -std::expm1(-static_cast<Real>(square) * d * d);
        ASSERT_NEAR(static_cast<double>(before / all), u, 4e-6 * u + 2e-7 + 1e-38) << square << " " << reach;
        if (!(d > 0)) continue;
        const Haze haze{0.0f, square};
        const Real weight = static_cast<Real>(haze_density(haze, d)) * haze_left(haze, d);
        if (weight > 1e-30L) {
          ASSERT_NEAR(static_cast<double>(weight / pdf_square_law(square, reach, d) / all), 1, 1e-5);
        }
      }
      const Haze haze{0.0f, square};
      ASSERT_NEAR(haze_opacity(haze, reach), static_cast<double>(all), 1e-6 * static_cast<double>(all) + 1e-30);
      const auto taken = [&](Real s) { return 2 * square * s * s * std::exp(-static_cast<Real>(square) * s * s); };
      const Real far = std::min<Real>(reach, 8 / std::sqrt(static_cast<Real>(square)));
      const Real mean = integrate(taken, 0, far, 2000) / all;
      ASSERT_NEAR(haze_mean(haze, reach) / static_cast<double>(mean), 1, 0.06) << square << " " << reach;
    }
  }
}

TEST(Medium, HazeOfNoSquareIsExtinction) {
  const Haze haze{0.01f, 0.0f};
  for (const float distance : kReaches) {
    EXPECT_EQ(haze_left(haze, distance), transmittance(0.01f, distance));
    EXPECT_EQ(haze_opacity(haze, distance), opacity(0.01f, distance));
    EXPECT_EQ(haze_covers(haze, distance), opacity(0.01f, distance));
    EXPECT_EQ(haze_mean(haze, distance), mean_interaction(0.01f, distance));
  }
}

TEST(Medium, AnglesAreExactToRounding) {
  for (int i = 0; i <= 4000; ++i) {
    const Real a = reference::kPi * i / 4000;
    const auto x = static_cast<float>(std::cos(a) * 7), y = static_cast<float>(std::sin(a) * 7);
    const Real exact = std::atan2(static_cast<Real>(std::max(y, 0.0f)), static_cast<Real>(x));
    ASSERT_NEAR(static_cast<double>(angle_above_axis(x, std::max(y, 0.0f))), static_cast<double>(exact),
                4 * kRoundoff * static_cast<double>(exact));
    const float quarter = static_cast<float>(a / 2);
    ASSERT_NEAR(static_cast<double>(sine_of_quarter(quarter)),
                static_cast<double>(std::sin(static_cast<Real>(quarter))),
                4 * kRoundoff * static_cast<double>(std::sin(static_cast<Real>(quarter))));
  }
  EXPECT_EQ(angle_above_axis(1, 1e-30f), 1e-30f);
}

// Lights before, behind, beyond, beside, at either end, on the ray, and far; from the start of a ray along x.
std::vector<vec3> test_lights(float reach) {
  return {{0, 0, 0},
          {reach, 0, 0},
          {0.5f * reach, 0, 0},
          {0.3f * reach, 1, 0},
          {-1, 0, 0},
          {-1e4f, 0, 0},
          {2 * reach, 0.01f, 0},
          {0.5f * reach, 0.1f * reach, 0},
          {10, 0, 1e-4f},
          {3, 4, 0},
          {-3, 0, 200},
          {-1e6f, 1e6f, 0},
          {3e4f, 1e-3f, 3e4f},
          {0.9f * reach, 0, 1e6f}};
}

// The share of the angle before a distance, of the segment as it is stored.
Real angle_share(const EquiAngular& e, Real distance) {
  const Real a = e.along, d = e.apart, far = std::atan2(d * e.reach, d * d - a * (e.reach - a));
  return std::atan2(d * distance, d * d - a * (distance - a)) / far;
}

TEST(Medium, DistancesAboutALightFollowTheirDensity) {
  const vec3 direction(1, 0, 0);
  for (const float reach : kReaches) {
    for (const vec3 light : test_lights(reach)) {
      SCOPED_TRACE(testing::Message() << "reach " << reach << " light " << light.x << " " << light.y << " " << light.z);
      const EquiAngular e = equi_angular(light, direction, reach);
      const Real a = e.along, d = e.apart, angle = std::atan2(d * reach, d * d - a * (reach - a));
      ASSERT_NEAR(static_cast<double>(e.angle), static_cast<double>(angle), 12 * kRoundoff * e.angle);
      for (int i = 0; i < 1000; ++i) {
        const float u = static_cast<float>(i) / 999 * 0x1.fffffep-1f;
        const float s = sample_equi_angular(e, u);
        ASSERT_TRUE(s >= 0 && s <= reach) << u;
        const Real density = d / (angle * (d * d + (s - a) * (s - a)));
        ASSERT_NEAR(static_cast<double>(pdf_equi_angular(e, s) / density), 1, 20 * kRoundoff) << u;
        // A distance is rounded, which moves the share by that many densities.
        const double rounding = 4 * kRoundoff * static_cast<double>(std::min(density * s, Real(1e9)));
        ASSERT_NEAR(static_cast<double>(angle_share(e, s)), u, 12 * kRoundoff + rounding) << u;
      }
      EXPECT_EQ(sample_equi_angular(e, 0), 0);
    }
  }
}

TEST(Medium, ALightOffTheRayIsTakenAsItIs) {
  const EquiAngular e = equi_angular(vec3(3, 4, 0), vec3(1, 0, 0), 10);
  EXPECT_EQ(e.along, 3);
  EXPECT_EQ(e.apart, 4);
  EXPECT_NEAR(e.angle, std::atan2(3, 4) + std::atan2(7, 4), 1e-6);
  EXPECT_GE(equi_angular(vec3(5, 0, 0), vec3(1, 0, 0), 10).apart, kLeastApart);
}

// Draws in 64 cells that the density hits about equally often, at a false-alarm rate of 1e-5 each.
void expect_distance_sampler(const DistanceMix& m, Rng& rng) {
  constexpr int kCells = 64, kDraws = 100000;
  std::vector<Real> edges;
  for (int i = 1; i < kCells; ++i) {
    Real low = 0, high = m.reach;  // a quantile by bisection; nothing depends on its precision
    for (int step = 0; step < 60; ++step) {
      const Real middle = (low + high) / 2, x = static_cast<Real>(m.sigma) * m.reach;
      const Real straight = x < 1e-9L ? middle / m.reach : std::expm1(-m.sigma * middle) / std::expm1(-x);
      (m.share * angle_share(m.light, middle) + (1 - m.share) * straight < Real(i) / kCells ? low : high) = middle;
    }
    edges.push_back(static_cast<float>(low));
  }
  std::vector<double> seen(kCells, 0.0);
  for (int i = 0; i < kDraws; ++i) {
    const Real d = sample_distance(m, rng.uniform());
    seen[static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), d) - edges.begin())] += 1;
  }
  ChiSquared test;
  Real total = 0;
  for (int i = 0; i < kCells; ++i) {
    const Real low = i == 0 ? 0 : edges[static_cast<std::size_t>(i - 1)];
    const Real high = i == kCells - 1 ? m.reach : edges[static_cast<std::size_t>(i)];
    // Panels by a square of the way from either end, as a peak may stand at the far side of a wide cell.
    const auto pdf = [&](Real s) { return static_cast<Real>(pdf_distance(m, static_cast<float>(s))); };
    const Real middle = (low + high) / 2, half = middle - low;
    const auto from_low = [&](Real s) { return pdf(low + half * s * s * s) * 3 * half * s * s; };
    const auto from_high = [&](Real s) { return pdf(high - half * s * s * s) * 3 * half * s * s; };
    const Real mass = integrate(from_low, 0, 1, 200) + integrate(from_high, 0, 1, 200);
    total += mass;
    test.add(static_cast<double>(mass) * kDraws, seen[static_cast<std::size_t>(i)]);
  }
  EXPECT_NEAR(static_cast<double>(total), 1, 1e-4);
  EXPECT_GT(test.p(), 1e-5) << test.statistic() << " of " << test.degrees();
}

TEST(Medium, SamplersFollowTheirDensities) {
  Rng rng(41);
  for (const float sigma : {0.0f, 1e-9f, 1e-3f, 10.0f}) {
    for (const float reach : {1.0f, 30000.0f, 1e6f}) {
      for (const float share : {0.0f, 0.5f, 1.0f}) {
        for (const vec3 light : {vec3(0.3f * reach, 0.2f * reach, 1), vec3(-3, 4, 0), vec3(5, 12, 0)}) {
          SCOPED_TRACE(testing::Message() << "sigma " << sigma << " reach " << reach << " share " << share << " light "
                                          << light.x << " " << light.y);
          const DistanceMix mix = distance_mix(sigma, reach, share, light, vec3(1, 0, 0));
          expect_distance_sampler(mix, rng);
          if (share != 0.5f) continue;
          for (const float mean : {-0.1f, 0.25f, 2.0f}) {
            SCOPED_TRACE(testing::Message() << "guided about " << mean);
            expect_distance_sampler(guided_distances(mix, mean * reach, 0.05f * reach, 0.6f), rng);
          }
        }
      }
    }
  }
}

// In-scattered light of a point light in fog without occluders: the integral of transmittance over squared distance.
TEST(Medium, TheMixIntegratesALight) {
  const vec3 light(20, 3, 0), direction(1, 0, 0);
  const float sigma = 0.02f, reach = 100;
  const auto in_scattered = [&](Real s) { return std::exp(-sigma * s) / (9 + (s - 20) * (s - 20)); };
  const auto exact = static_cast<double>(integrate(in_scattered, 0, reach, 1000));
  Rng rng(42);
  for (const float share : {0.0f, 0.3f, 1.0f}) {
    const DistanceMix m = guided_distances(distance_mix(sigma, reach, share, light, direction), 15, 4, 0.5f * share);
    double sum = 0, squares = 0;
    constexpr int kDraws = 200000;
    for (int i = 0; i < kDraws; ++i) {
      const float s = sample_distance(m, rng.uniform());
      const double x = static_cast<double>(in_scattered(s)) / pdf_distance(m, s);
      sum += x;
      squares += x * x;
    }
    const double mean = sum / kDraws, error = std::sqrt((squares / kDraws - mean * mean) / kDraws);
    EXPECT_NEAR(mean, exact, 4.5 * error) << share;
  }
}

TEST(Medium, IsFiniteEverywhere) {
  for (const float sigma : kSigmas) {
    for (const float reach : {0.0f, 1e-30f, 1e-6f, 1.0f, 30000.0f, 1e6f, 1e12f}) {
      for (const vec3 light : test_lights(reach)) {
        for (const float share : {0.0f, 0.5f, 1.0f}) {
          const DistanceMix plain = distance_mix(sigma, reach, share, light, vec3(1, 0, 0));
          for (const float known : {0.0f, 0.5f})
            for (const float spread : {0.0f, 1.0f, 1e12f})
              for (const float u : kMediumNumbers) {
                const DistanceMix m = guided_distances(plain, light.x, spread, known);
                const float d = sample_distance(m, u), density = pdf_distance(m, d);
                ASSERT_TRUE(d >= 0 && d <= reach) << sigma << " " << reach << " " << share << " " << known << " " << u;
                ASSERT_TRUE(std::isfinite(density) && density > 0)
                    << sigma << " " << reach << " " << share << " " << known << " " << u;
              }
        }
      }
    }
  }
}

}  // namespace
}  // namespace fb::shared
