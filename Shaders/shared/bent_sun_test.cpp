// shared/bent_sun.h: its samples against its density, and both against suns that Snell's law sends through waves.
#include "shared/bent_sun.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/rng.h"
#include "base/test_chi_squared.h"
#include "shared/test_quadrature.h"

namespace fb::shared {
namespace {

vec3 sun_at(float elevation, float azimuth) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}
float disc_of(float radius) { return 2 * std::sin(radius / 2) * std::sin(radius / 2); }

TEST(BentSun, SamplesFollowTheDensity) {
  Rng rng(7);
  for (const float elevation : {0.05f, 0.8f, 1.5707963f})
    for (const BentSun& b : {refracted_sun(sun_at(elevation, 2.0f), disc_of(0.02f), kIndexOfWater, 0.0f),
                             refracted_sun(sun_at(elevation, 2.0f), disc_of(0.02f), kIndexOfWater, 0.4f),
                             mirrored_sun(sun_at(elevation, 2.0f), disc_of(0.02f), 0.04f)}) {
      // Rings of equal probability about the middle, in sectors. What would lie beyond the horizon is drawn as nothing.
      constexpr int kRings = 12, kSectors = 8, kDraws = 200000;
      std::vector<double> seen(kRings * kSectors + 1, 0), expected(seen.size(), 0);
      for (int i = 0; i < kDraws; ++i) {
        const vec3 t = bent_sun_sample(b, {rng.uniform(), rng.uniform()});
        if (t == vec3(0.0f)) {
          ++seen.back();
          continue;
        }
        ASSERT_NEAR(glm::length(t), 1.0f, 1e-6f);
        ASSERT_GT(bent_sun_pdf(b, t), 0.0f);
        const float x = (t.x - b.middle.x) / b.spread, y = (t.y - b.middle.y) / b.spread, q2 = x * x + y * y;
        const int ring = static_cast<int>(static_cast<float>(kRings) * q2 / (1 + q2));
        const int sector = static_cast<int>(kSectors * (0.5f + std::atan2(y, x) / (2 * kWavePi)));
        ++seen[static_cast<std::size_t>(std::min(ring, kRings - 1) * kSectors + std::min(sector, kSectors - 1))];
      }
      // The density over solid angles, integrated in the same rings: dw = dx dy / z.
      expected.back() = kDraws;
      for (int ring = 0; ring < kRings; ++ring)
        for (int sector = 0; sector < kSectors; ++sector) {
          const auto integral = integrate(
              [&](long double share) {
                const auto q = static_cast<float>(std::sqrt(share / (1 - share)));
                const auto by_share = static_cast<long double>(0.5L / ((1 - share) * (1 - share)));  // d(q^2 / 2)
                return integrate(
                    [&](long double turn) -> long double {
                      const auto phi = static_cast<float>(2 * 3.14159265358979323846L * (turn - 0.5L));
                      const float x = b.middle.x + q * b.spread * std::cos(phi),
                                  y = b.middle.y + q * b.spread * std::sin(phi);
                      const float z2 = 1 - x * x - y * y;
                      if (z2 <= 0) return 0;
                      const vec3 t(x, y, b.side * std::sqrt(z2));
                      return static_cast<long double>(bent_sun_pdf(b, t) / std::fabs(t.z) * b.spread * b.spread) *
                             by_share * 2 * 3.14159265358979323846L;
                    },
                    static_cast<long double>(sector) / kSectors, static_cast<long double>(sector + 1) / kSectors, 64);
              },
              static_cast<long double>(ring) / kRings,
              std::min(static_cast<long double>(ring + 1) / kRings, 0.9999999L), 64);
          const double draws = static_cast<double>(integral) * kDraws;
          expected[static_cast<std::size_t>(ring * kSectors + sector)] = draws;
          expected.back() -= draws;
        }
      ChiSquared test;
      for (std::size_t i = 0; i < seen.size(); ++i) test.add(std::max(expected[i], 0.0), seen[i]);
      EXPECT_GT(test.p(), 1e-4) << elevation << ' ' << b.spread << ' ' << b.side;
    }
}

// The directions that a surface of waves does send: the density's blot, half of which is within q = 1, has next to all
// of them, and is not much wider than they are.
TEST(BentSun, CoversTheSunThroughWaves) {
  Rng rng(8);
  for (const float elevation : {0.4f, 0.9f, 1.5f})
    for (const float height : {0.0f, 0.6f, 2.0f}) {
      const float size = 64.0f, radius = 0.01f;
      const vec3 sun = sun_at(elevation, 0.7f);
      const float slope = kWaveMeanSlope * height / size;
      const BentSun refracted = refracted_sun(sun, disc_of(radius), kIndexOfWater, slope);
      const BentSun mirrored = mirrored_sun(sun, disc_of(radius), slope);
      const vec3 side = glm::normalize(glm::cross(sun, vec3(0, 0, 1))), other = glm::cross(side, sun);
      constexpr int kPoints = 4000;
      int near[2] = {}, within[2] = {}, mirrored_up = 0;
      for (int i = 0; i < kPoints; ++i) {
        const WaveState wave = wave_state({height, size, 12345u}, {rng.uniform(-4000, 4000), rng.uniform(-4000, 4000)});
        const float r = radius * std::sqrt(rng.uniform()), phi = rng.uniform(0, 2 * kWavePi);
        const vec3 from = glm::normalize(sun + r * (std::cos(phi) * side + std::sin(phi) * other));
        const vec3 normal = wave_normal(wave);
        const vec3 to[2] = {-dielectric_refract(from, normal, kIndexOfWater), -dielectric_reflect(from, normal)};
        mirrored_up += to[1].z >= 0 ? 1 : 0;
        for (int kind = 0; kind < 2; ++kind) {
          const BentSun& b = kind == 0 ? refracted : mirrored;
          const float x = (to[kind].x - b.middle.x) / b.spread, y = (to[kind].y - b.middle.y) / b.spread;
          near[kind] += x * x + y * y < 0.25f ? 1 : 0;
          within[kind] += x * x + y * y < 4.0f ? 1 : 0;
        }
      }
      EXPECT_LT(mirrored_up, kPoints / 100);
      for (int kind = 0; kind < 2; ++kind) {
        EXPECT_GT(within[kind], 0.95 * kPoints) << kind << ' ' << elevation << ' ' << height;
        EXPECT_LT(near[kind], 0.6 * kPoints) << "wider than it need be: " << kind << ' ' << elevation << ' ' << height;
      }
    }
}

TEST(BentSun, LevelWaterShowsItWhereSnellSays) {
  for (const float elevation : {0.02f, 0.3f, 1.0f, 1.5707963f}) {
    const vec3 sun = sun_at(elevation, -1.0f);
    const BentSun b = refracted_sun(sun, disc_of(0.005f), kIndexOfWater, 0.0f);
    const vec3 t = -dielectric_refract(sun, vec3(0, 0, 1), kIndexOfWater);
    EXPECT_NEAR(b.middle.x, t.x, 1e-6f);
    EXPECT_NEAR(b.middle.y, t.y, 1e-6f);
    EXPECT_NEAR(b.spread, kBentSunDisc * 0.005f / kIndexOfWater, 1e-7f);
  }
  const BentSun below = refracted_sun(sun_at(-0.1f, 0.0f), disc_of(0.005f), kIndexOfWater, 0.1f);
  EXPECT_EQ(bent_sun_sample(below, {0.5f, 0.5f}), vec3(0.0f));
  EXPECT_EQ(bent_sun_pdf(below, {0, 0, 1}), 0.0f);
}

// A wide blot under a sun at the horizon, and the ends of the random numbers.
TEST(BentSun, StaysFinite) {
  for (const float elevation : {1e-6f, 0.5f, 1.5707963f})
    for (const float slope : {0.0f, 1e-9f, 1.0f, 20.0f})
      for (const float disc : {1e-9f, 0.3f})
        for (const float index : {1.0f, 1.33f, 3.0f})
          for (const float u : {0.0f, 1e-30f, 0.5f, 0x1.fffffep-1f}) {
            const BentSun b = refracted_sun(sun_at(elevation, 1.0f), disc, index, slope);
            const vec3 t = bent_sun_sample(b, {u, u});
            ASSERT_TRUE(std::isfinite(t.x + t.y + t.z)) << elevation << ' ' << slope << ' ' << disc << ' ' << index;
            ASSERT_TRUE(std::isfinite(bent_sun_pdf(b, t))) << elevation << ' ' << slope << ' ' << disc << ' ' << index;
            const BentSun m = mirrored_sun(sun_at(elevation, 1.0f), disc, slope);
            const vec3 d = bent_sun_sample(m, {u, u});
            ASSERT_TRUE(std::isfinite(d.x + d.y + d.z + bent_sun_pdf(m, d)))
                << elevation << ' ' << slope << ' ' << disc;
          }
}

}  // namespace
}  // namespace fb::shared
