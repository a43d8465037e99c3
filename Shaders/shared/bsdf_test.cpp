// The samplers of shared/bsdf.h against their pdfs (chi-squared over cells of the sphere), and the BSDF's energy.
#include "shared/bsdf.h"

#include <algorithm>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/rng.h"
#include "base/test_chi_squared.h"

namespace fb::shared {
namespace {

constexpr int kZ = 16, kPhi = 32;

int cell_of(const vec3& w) {
  const int z = std::min(kZ - 1, std::max(0, static_cast<int>((w.z * 0.5f + 0.5f) * kZ)));
  double phi = std::atan2(w.y, w.x) / (2 * kPiShared);
  if (phi < 0) phi += 1;
  return z * kPhi + std::min(kPhi - 1, static_cast<int>(phi * kPhi));
}

// Integral of a pdf over every cell, by midpoints of a fine grid in (z, phi), where solid angle is uniform.
template <typename Pdf>
std::vector<double> integrate_cells(Pdf pdf) {
  constexpr int kFine = 48;
  std::vector<double> mass(kZ * kPhi, 0.0);
  const double area = 4 * kPiShared / (static_cast<double>(kZ) * kPhi * kFine * kFine);
  for (int iz = 0; iz < kZ * kFine; ++iz) {
    const double z = (iz + 0.5) / (kZ * kFine) * 2 - 1, s = std::sqrt(1 - z * z);
    for (int ip = 0; ip < kPhi * kFine; ++ip) {
      const double phi = (ip + 0.5) / (kPhi * kFine) * 2 * kPiShared;
      const vec3 w(static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)), static_cast<float>(z));
      mass[static_cast<std::size_t>((iz / kFine) * kPhi + ip / kFine)] += pdf(w) * area;
    }
  }
  return mass;
}

// At a false-alarm rate of 1e-5.
template <typename Sample>
void expect_chi_squared(const std::vector<double>& mass, Sample sample, int draws) {
  std::vector<double> seen(mass.size(), 0.0);
  for (int i = 0; i < draws; ++i) {
    vec3 w;
    if (sample(w)) seen[static_cast<std::size_t>(cell_of(w))] += 1;
  }
  ChiSquared test;
  for (std::size_t i = 0; i < mass.size(); ++i) test.add(mass[i] * draws, seen[i]);
  EXPECT_GT(test.p(), 1e-5) << test.statistic() << " of " << test.degrees();
}

vec3 direction_at(float degrees) {
  const float a = degrees * kPiShared / 180;
  return {std::sin(a), 0, std::cos(a)};
}

TEST(Bsdf, CosineHemisphereMatchesItsPdf) {
  Rng rng(1);
  expect_chi_squared(
      integrate_cells([](const vec3& w) { return pdf_cosine_hemisphere(w); }),
      [&](vec3& w) {
        w = sample_cosine_hemisphere({rng.uniform(), rng.uniform()});
        return true;
      },
      400000);
}

struct BsdfCase {
  float roughness, specular, metalness, view_degrees;
};
class BsdfSampling : public testing::TestWithParam<BsdfCase> {};

TEST_P(BsdfSampling, MatchesItsPdf) {
  const BsdfCase p = GetParam();
  const Bsdf b{vec3(0.6f, 0.4f, 0.2f), std::max(p.roughness * p.roughness, kMinAlpha), p.specular, p.metalness};
  const vec3 wo = direction_at(p.view_degrees);
  Rng rng(2);
  // Directions below the horizon have no pdf: what is sampled there is lost by both sides.
  expect_chi_squared(
      integrate_cells([&](const vec3& w) { return bsdf_pdf(b, wo, w); }),
      [&](vec3& w) {
        (void)bsdf_sample(b, wo, {rng.uniform(), rng.uniform(), rng.uniform()}, w);
        return w.z > 0;
      },
      400000);
}

TEST_P(BsdfSampling, WeightIsTheIntegralAndLosesNoEnergyBeyondOne) {
  const BsdfCase p = GetParam();
  const Bsdf b{vec3(1.0f), std::max(p.roughness * p.roughness, kMinAlpha), p.specular, p.metalness};
  const vec3 wo = direction_at(p.view_degrees);
  Rng rng(3);
  double sum = 0, sum2 = 0;
  constexpr int kDraws = 200000;
  for (int i = 0; i < kDraws; ++i) {
    vec3 wi;
    const double x = bsdf_sample(b, wo, {rng.uniform(), rng.uniform(), rng.uniform()}, wi).x;
    ASSERT_TRUE(std::isfinite(x));
    ASSERT_GE(x, 0);
    sum += x;
    sum2 += x * x;
  }
  const double mean = sum / kDraws, error = std::sqrt((sum2 / kDraws - mean * mean) / kDraws);
  EXPECT_LE(mean, 1.0 + 4 * error + 1e-3) << "no more is reflected than comes in";
  double integral = 0;
  for (double cell : integrate_cells([&](const vec3& w) { return bsdf_eval(b, wo, w).x; })) integral += cell;
  EXPECT_NEAR(mean, integral, 4.5 * error + 2e-3 * integral);
}

INSTANTIATE_TEST_SUITE_P(Cases, BsdfSampling,
                         testing::Values(BsdfCase{1, 0, 0, 30}, BsdfCase{0.5f, 0.04f, 0, 20},
                                         BsdfCase{0.4f, 0.04f, 0, 75}, BsdfCase{0.6f, 0, 1, 45},
                                         BsdfCase{0.9f, 0.5f, 0.5f, 60}));

TEST(Bsdf, IsReciprocal) {
  Rng rng(4);
  const Bsdf b{vec3(0.6f, 0.4f, 0.2f), 0.2f, 0.04f, 0.3f};
  for (int i = 0; i < 1000; ++i) {
    const vec3 wo = sample_cosine_hemisphere({rng.uniform(0, 0.95f), rng.uniform()});
    const vec3 wi = sample_cosine_hemisphere({rng.uniform(0, 0.95f), rng.uniform()});
    const vec3 there = bsdf_eval(b, wo, wi) / wi.z, back = bsdf_eval(b, wi, wo) / wo.z;
    EXPECT_NEAR(there.x, back.x, 2e-4f * there.x + 1e-6f);
  }
}

TEST(Bsdf, MirrorLikeAndGrazingStaysFinite) {
  Rng rng(5);
  const Bsdf b{vec3(0.9f), kMinAlpha, 0.04f, 1.0f};
  for (float angle : {0.0f, 45.0f, 89.0f, 89.99f}) {
    for (int i = 0; i < 1000; ++i) {
      vec3 wi;
      const vec3 weight = bsdf_sample(b, direction_at(angle), {rng.uniform(), rng.uniform(), rng.uniform()}, wi);
      ASSERT_TRUE(std::isfinite(weight.x)) << angle;
      ASSERT_LE(weight.x, 1.5f) << angle;
    }
  }
}

}  // namespace
}  // namespace fb::shared
