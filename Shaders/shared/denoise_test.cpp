// The denoiser's packing and demodulation, on the host.
#include "shared/denoise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <algorithm>

#include "base/rng.h"

namespace fb::shared {
namespace {

TEST(Denoise, DemodulationAndItsInverseGiveTheRadianceBack) {
  Rng rng(1);
  for (int i = 0; i < 20000; ++i) {
    const bool metal = i % 3 == 0, coat = i % 3 == 1;
    const vec3 albedo(rng.uniform(0, 1), i % 7 == 0 ? 0.0f : rng.uniform(0, 1), std::pow(10.0f, rng.uniform(-4, 0)));
    const vec3 factor = demodulation_factor(albedo, rng.uniform(0, 1), coat ? rng.uniform(0, 0.2f) : 0.0f,
                                            metal ? rng.uniform(0, 1) : 0.0f, rng.uniform(0, 1));
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(factor[k], 0.0f);
      EXPECT_LE(factor[k], 1.0f + 1e-6f);
    }
    // What reflects nothing sends nothing.
    vec3 radiance(rng.uniform(0, 100), rng.uniform(0, 100), rng.uniform(0, 100));
    for (int k = 0; k < 3; ++k)
      if (factor[k] == 0) radiance[k] = 0;
    const vec3 back = demodulate(radiance, factor) * factor;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[k], radiance[k], 1e-6f * radiance[k] + 1e-30f) << k;
  }
}

TEST(Denoise, ALambertSurfaceIsDividedByItsAlbedo) {
  const vec3 albedo(0.25f, 0.5f, 0.0f);
  EXPECT_EQ(demodulation_factor(albedo, 1, 0, 0, 0.3f), albedo);
  const vec3 irradiance = demodulate(albedo * 3.0f, albedo);
  EXPECT_EQ(irradiance.x, 3.0f);
  EXPECT_EQ(irradiance.y, 3.0f);
  EXPECT_EQ(irradiance.z, 3.0f) << "a channel that reflects nothing takes the others' mean";
  EXPECT_EQ(demodulate(vec3(0.0f), vec3(0.0f)), vec3(0.0f));
}

TEST(Denoise, MetalsAndCoatsAreDividedByAboutWhatTheyReflect) {
  // Directional albedo by sampling; the factor need only be near, so that little of the texture stays in the
  // irradiance.
  Rng rng(2);
  for (const float metalness : {0.0f, 0.5f, 1.0f}) {
    for (const float roughness : {0.1f, 0.5f, 0.9f}) {
      for (const float cosine : {0.3f, 0.9f}) {
        const Bsdf b{vec3(0.8f, 0.4f, 0.1f), std::max(roughness * roughness, kMinAlpha), 0.04f, metalness};
        const vec3 wo(std::sqrt(1 - cosine * cosine), 0, cosine);
        vec3 sum(0.0f);
        const int samples = 4000;
        for (int i = 0; i < samples; ++i) {
          vec3 wi;
          sum += bsdf_sample(b, wo, vec3(rng.uniform(), rng.uniform(), rng.uniform()), wi);
        }
        const vec3 factor = demodulation_factor(b.albedo, roughness, b.specular, metalness, cosine);
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(factor[k], sum[k] / static_cast<float>(samples), 0.2f)
              << metalness << ' ' << roughness << ' ' << cosine;
      }
    }
  }
}

vec3 random_direction(Rng& rng) {
  const float z = rng.uniform(-1, 1), phi = rng.uniform(0, 6.2831853f), r = std::sqrt(std::max(0.0f, 1 - z * z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

TEST(Denoise, PackedNumbersComeBackWithinTheirPrecision) {
  Rng rng(3);
  for (int i = 0; i < 20000; ++i) {
    const vec3 n = random_direction(rng);
    const float inverse_depth = std::pow(10.0f, rng.uniform(-4.6f, 1.5f));
    const std::uint32_t surface = pack_surface(inverse_depth, n);
    EXPECT_NEAR(unpack_surface_inverse_depth(surface), inverse_depth, inverse_depth / 4000);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(unpack_surface_normal(surface)[k], n[k], 1.0f / 29);
  }
  for (const vec3& axis : {vec3(1, 0, 0), vec3(0, -1, 0), vec3(0, 0, 1)}) {
    EXPECT_EQ(unpack_surface_normal(pack_surface(1, axis)), axis);
  }
}

TEST(Denoise, SharedExponentsKeepColoursOfEverySize) {
  Rng rng(4);
  EXPECT_EQ(unpack_rgb9e5(pack_rgb9e5(vec3(0.0f), 0.5f)), vec3(0.0f));
  for (int i = 0; i < 20000; ++i) {
    const float size = std::pow(10.0f, rng.uniform(-4, 4.7f));
    const vec3 c(size * rng.uniform(), size * rng.uniform(), size);
    const vec3 back = unpack_rgb9e5(pack_rgb9e5(c, 0.5f));
    // Half a step of 9 bits; and up to 0.2% where rounding up has no room.
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[k], c[k], size * 0.0022f) << size;
  }
}

TEST(Denoise, RandomRoundingHasNoBias) {
  Rng rng(5);
  for (const float value : {0.3001f, 0.7f, 1.0f, 1.9991f}) {
    double sum = 0;
    const int samples = 100000;
    for (int i = 0; i < samples; ++i) sum += unpack_rgb9e5(pack_rgb9e5(vec3(value, 0.5f * value, 0), rng.uniform())).x;
    // A step is at most value / 256, its standard deviation at most half of one: 5 sigma.
    EXPECT_NEAR(sum / samples, value, 5 * value / 512 / std::sqrt(static_cast<double>(samples))) << value;
  }
}

}  // namespace
}  // namespace fb::shared
