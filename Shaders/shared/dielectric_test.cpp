// shared/dielectric.h against Fresnel's and Snell's equations as the textbooks have them, in long double.
#include "shared/dielectric.h"

#include <algorithm>
#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"
#include "shared/test_vmf_errors.h"

namespace fb::shared {
namespace {

using reference::Real;
constexpr float kWaterIndex = 1.333f;

Real textbook_reflectance(Real c, Real eta) {
  const Real excess = 1 - (1 - c * c) / (eta * eta);
  if (excess <= 0) return 1;
  const Real t = std::sqrt(excess), s = (c - eta * t) / (c + eta * t), p = (eta * c - t) / (eta * c + t);
  return (s * s + p * p) / 2;
}

TEST(Dielectric, IsFresnels) {
  for (const float eta : {kWaterIndex, 1 / kWaterIndex, 1.5f, 0.4f, 2.4f, 1.001f, 1 / 1.001f}) {
    for (int i = 1; i <= 4000; ++i) {
      const float c = static_cast<float>(i) / 4000;
      // Near the critical angle the root of the excess magnifies the rounding of the excess.
      const Real excess = static_cast<Real>(eta) * eta - 1 + static_cast<Real>(c) * c;
      if (std::abs(excess) < 1e-6L) continue;
      const auto exact = static_cast<double>(textbook_reflectance(c, eta));
      const double root = static_cast<double>(std::sqrt(std::max(excess, 1e-6L)));
      ASSERT_NEAR(dielectric_reflectance(c, eta), exact, 24 * kRoundoff * exact + 8 * kRoundoff * c / root * exact)
          << c << " " << eta;
    }
  }
}

TEST(Dielectric, KnownValues) {
  const auto normal = [](double n) { return (n - 1) * (n - 1) / ((n + 1) * (n + 1)); };
  for (const float n : {1.333f, 1.5f, 2.4f, 1.000001f}) {
    EXPECT_NEAR(dielectric_reflectance(1, n) / normal(n), 1, 16 * kRoundoff) << n;
    EXPECT_NEAR(dielectric_reflectance(1, 1 / n), normal(n), 2e-6 * std::sqrt(normal(n))) << n;
  }
  // At Brewster's angle, tan = n, only the s polarisation is reflected: ((n^2 - 1) / (n^2 + 1))^2 of it.
  for (const double n : {1.333, 1.5, 1 / 1.5}) {
    const double c = 1 / std::sqrt(1 + n * n), s = (n * n - 1) / (n * n + 1);
    EXPECT_NEAR(dielectric_reflectance(static_cast<float>(c), static_cast<float>(n)), s * s / 2, 1e-7) << n;
  }
  for (const float c : {0.0f, 1e-9f, 0.5f, 1.0f}) EXPECT_EQ(dielectric_reflectance(c, 1), 0) << "no interface";
}

TEST(Dielectric, AllIsReflectedAtAndBeyondTheCriticalAngle) {
  for (const float eta : {1 / 1.333f, 1 / 1.5f, 0.4f, 0.999f}) {
    const float critical = std::sqrt((1 - eta) * (1 + eta));
    for (int i = 0; i < 1000; ++i) {
      const float c = critical * (1 - 2e-7f) * static_cast<float>(i) / 1000;
      ASSERT_EQ(dielectric_reflectance(c, eta), 1) << c << " " << eta;
      ASSERT_EQ(dielectric_cosine_beyond(c, eta), 0) << c << " " << eta;
    }
    EXPECT_GT(dielectric_reflectance(critical, eta), 0.99f);
    EXPECT_LT(dielectric_reflectance(std::min(critical * 1.01f, 1.0f), eta), eta < 0.99f ? 0.75f : 1.0f);
  }
}

TEST(Dielectric, GrazingIsFinite) {
  for (const float eta : {0.1f, 0.75f, 0x1.fffffep-1f, 1.0f, 0x1.000002p0f, 1.333f, 10.0f}) {
    for (const float c : {0.0f, 0x1p-149f, 1e-30f, 1e-12f, 1e-6f, 1e-3f, 0x1.fffffep-1f, 1.0f}) {
      const float r = dielectric_reflectance(c, eta);
      ASSERT_TRUE(r >= 0 && r <= 1) << c << " " << eta;
      const vec3 t = dielectric_refract(vec3(std::sqrt(1 - c * c), 0, c), vec3(0, 0, 1), eta);
      ASSERT_NEAR(static_cast<double>(reference::length(t)), 1, 9 * kRoundoff) << c << " " << eta;
      ASSERT_LE(t.z, 0) << c << " " << eta;
    }
    if (eta != 1) {
      EXPECT_GT(dielectric_reflectance(1e-12f, eta), std::abs(eta - 1) > 0.1f ? 0.9999f : 0.99f) << eta;
    }
  }
}

// Seen from beyond, along the refracted direction, the interface reflects the same share; and the way back is the way
// in.
TEST(Dielectric, IsReciprocal) {
  Rng rng(31);
  for (int i = 0; i < 20000; ++i) {
    const float eta = std::exp(rng.uniform(-1, 1)), c = rng.uniform();
    if (dielectric_excess(c, eta) < 1e-3f) continue;
    const float t = dielectric_cosine_beyond(c, eta);
    const float there = dielectric_reflectance(c, eta), back = dielectric_reflectance(t, 1 / eta);
    // A cosine near 0 that is computed from one near 1 has lost as many digits.
    const float magnified = std::max(eta, 1 / eta) * std::max(eta, 1 / eta) / std::min(c, t);
    ASSERT_NEAR(there, back, 1e-6f * magnified) << c << " " << eta;
    const vec3 n = vmf_sample(vec3(0, 0, 1), 0, {rng.uniform(), rng.uniform()});
    const vec3 w = vmf_direction_about(n, 1 - c, std::sqrt(1 - c * c), rng.uniform());
    const vec3 beyond = dielectric_refract(w, n, eta);
    ASSERT_NEAR(dot(beyond, n), -t, 1e-6f * magnified) << c << " " << eta;
    ASSERT_LT(length(dielectric_refract(beyond, -n, 1 / eta) - w), 2e-6f / std::min(c, t)) << c << " " << eta;
    ASSERT_NEAR(length(cross(w, n)), eta * length(cross(beyond, n)), 1e-6) << "Snell";
    ASSERT_LT(std::abs(dot(beyond, cross(w, n))), 1e-6f) << "in the plane of incidence";
    ASSERT_LT(length(dielectric_reflect(dielectric_reflect(w, n), n) - w), 2e-6f);
    ASSERT_NEAR(dot(dielectric_reflect(w, n), n), dot(w, n), 1e-6);
  }
  EXPECT_EQ(dielectric_eta(kWaterIndex, 0.5f), kWaterIndex);
  EXPECT_EQ(dielectric_eta(kWaterIndex, -0.5f), 1 / kWaterIndex);
}

// Etendue is kept: eta^2 cos_t dw_t = cos_i dw_i, for solid angles of small squares by finite differences; so radiance
// has the factor of dielectric_radiance_factor.
TEST(Dielectric, RadianceOverSquaredIndexIsKept) {
  const vec3 n(0, 0, 1);
  for (const float eta : {kWaterIndex, 1 / kWaterIndex, 2.0f}) {
    for (const float degrees : {5.0f, 20.0f, 40.0f, 45.0f, 60.0f, 75.0f}) {
      const float angle = degrees * kVmfPi / 180, step = 2e-3f;
      if (dielectric_excess(std::cos(angle), eta) < 0.05f) continue;
      const auto beyond = [&](float along, float across) {
        const float a = angle + along, s = std::sin(a);
        return dielectric_refract(vec3(s * std::cos(across), s * std::sin(across), std::cos(a)), n, eta);
      };
      const vec3 along = (beyond(step, 0) - beyond(-step, 0)) / (2 * step);
      const vec3 across = (beyond(0, step) - beyond(0, -step)) / (2 * step);
      const float beyond_area = length(cross(along, across)), area = std::sin(angle);
      const float cosine_beyond = dielectric_cosine_beyond(std::cos(angle), eta);
      const float ratio = std::cos(angle) * area / (cosine_beyond * beyond_area);
      EXPECT_NEAR(ratio * dielectric_radiance_factor(eta), 1, 1e-3) << eta << " " << degrees;
    }
  }
}

}  // namespace
}  // namespace fb::shared
