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

// What packed words were before there were signs, kept here as the bits that pictures without negative samples have.
uint pack_without_signs(vec3 c, float round) {
  const float largest = std::max(c.x, std::max(c.y, c.z)) * 1.002f;
  const uint biased = std::clamp(floatBitsToUint(largest) >> 23u, 111u, 142u);
  const float scale = uintBitsToFloat((262u - biased) << 23u);
  const auto channel = [&](float x) { return static_cast<uint>(std::min(x * scale + round, 511.0f)); };
  return channel(c.x) | (channel(c.y) << 9u) | (channel(c.z) << 18u) | ((biased - 111u) << 27u);
}
vec3 unpack_without_signs(uint u) {
  const float scale = uintBitsToFloat(((u >> 27u) + 103u) << 23u);
  return vec3(static_cast<float>(u & 511u), static_cast<float>((u >> 9u) & 511u),
              static_cast<float>((u >> 18u) & 511u)) *
         scale;
}

// No bit of them differs, above all not where the largest channel is barely of its exponent: just below powers of two.
TEST(Denoise, SignsCostNoBitWhereNothingIsBelowZero) {
  Rng rng(6);
  const auto expect_same = [](vec3 c, float round) {
    const uint packed = pack_rgb9e5(c, round);
    ASSERT_EQ(packed, pack_without_signs(c, round)) << c.x << ' ' << c.y << ' ' << c.z;
    ASSERT_EQ(unpack_rgb9e5(packed), unpack_without_signs(packed)) << c.x << ' ' << c.y << ' ' << c.z;
  };
  for (int i = 0; i < 200000; ++i) {
    const float size = i % 2 == 0 ? std::pow(10.0f, rng.uniform(-9, 4.7f))
                                  : std::ldexp(rng.uniform(0.997f, 1.001f), static_cast<int>(rng.below(40)) - 24);
    vec3 c(size * rng.uniform(), size * rng.uniform(), size * rng.uniform());
    c[static_cast<int>(rng.below(3))] = size;
    expect_same(c, i % 4 < 2 ? rng.uniform() : i % 3 == 0 ? 0.0f : 0.5f);
  }
  expect_same(vec3(0.0f), 0.5f);
  expect_same(vec3(1e9f), 0.5f);
  // Zero with a sign is no number below zero, nor its exponent the greatest.
  EXPECT_EQ(pack_rgb9e5(vec3(-0.0f), 0.0f), 0u);
  EXPECT_EQ(unpack_rgb9e5(pack_rgb9e5(vec3(-0.0f), 0.5f)), vec3(0.0f));
}

// Half a step, of which the largest has 63 to 127; none is shorter than 2^-21.
TEST(Denoise, ColoursBelowZeroKeepTheirSign) {
  Rng rng(7);
  for (int i = 0; i < 200000; ++i) {
    const float size = i % 2 == 0 ? std::pow(10.0f, rng.uniform(-8, 4.7f))
                                  : std::ldexp(rng.uniform(0.98f, 1.01f), static_cast<int>(rng.below(37)) - 22);
    vec3 c(size * rng.uniform(-1, 1), size * rng.uniform(-1, 1), size * rng.uniform(-1, 1));
    c[static_cast<int>(rng.below(3))] = -size;
    if (i % 3 == 0) c[static_cast<int>(rng.below(3))] = size;
    if (std::min({c.x, c.y, c.z}) >= 0) continue;
    const float largest = std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)});
    const vec3 back = unpack_rgb9e5(pack_rgb9e5(c, 0.5f));
    const float step = std::exp2(std::max(std::floor(std::log2(1.0081f * largest)) - 6, -21.0f));
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(back[k], c[k], 0.5001f * step) << c.x << ' ' << c.y << ' ' << c.z;
  }
  EXPECT_EQ(unpack_rgb9e5(pack_rgb9e5(vec3(-1, 0, 0.5f), 0.5f)), vec3(-1, 0, 0.5f));
  EXPECT_NEAR(unpack_rgb9e5(pack_rgb9e5(vec3(-1e9f, 0, 0), 0.5f)).x, -65024, 1);
}

// Of c and -c nothing is left in the mean, nor of any other: for all random numbers in a row, which leave a step's
// share of 1/4096.
TEST(Denoise, RandomRoundingHasNoBiasBelowZero) {
  for (const vec3& c : {vec3(-0.3001f, 0.7f, 0.01f), vec3(-3e-4f, -2e-4f, 1e-6f), vec3(1000.7f, -0.3f, 999.9f),
                        vec3(-0.9985f, 0.2f, 0.999f)}) {
    constexpr int kRounds = 4096;
    double sum[3] = {};
    for (int i = 0; i < kRounds; ++i) {
      const float round = (static_cast<float>(i) + 0.5f) / kRounds;
      const vec3 back = unpack_rgb9e5(pack_rgb9e5(c, round));
      const vec3 other = unpack_rgb9e5(pack_rgb9e5(-c, 1 - round));
      for (int k = 0; k < 3; ++k) {
        sum[k] += static_cast<double>(back[k]);
        EXPECT_EQ(back[k], -other[k]) << "signs are alike";
      }
    }
    // A step is at most 1/63 of the largest; the sum over evenly spaced numbers is off by half a spacing, and float's
    // rounding beside 127 by 2^-18 of a step.
    const double step = static_cast<double>(std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)})) / 63;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k] / kRounds, static_cast<double>(c[k]), step / kRounds) << k;
  }
}

TEST(Denoise, FirefliesAreCutOnBothSidesOfTheMean) {
  const float mean = 2, mean_square = 5;  // a deviation of 1
  EXPECT_EQ(firefly_cut(3, mean, mean_square, 3), 1.0f);
  EXPECT_FLOAT_EQ(10 * firefly_cut(10, mean, mean_square, 3), 5.2f);
  EXPECT_FLOAT_EQ(-10 * firefly_cut(-10, mean, mean_square, 3), -1.2f);
  EXPECT_EQ(firefly_cut(-1, mean, mean_square, 3), 1.0f);
  EXPECT_EQ(firefly_cut(0, mean, mean_square, 3), 1.0f);
  EXPECT_EQ(firefly_cut(-1, 100, 10001, 3), 0.0f) << "nearest to the mean with its sign";
  // A history below zero is the mirror of one above.
  for (const float y : {-20.0f, -4.0f, -1.0f, 0.5f, 1.0f, 3.0f, 30.0f})
    EXPECT_EQ(firefly_cut(y, -mean, mean_square, 3), firefly_cut(-y, mean, mean_square, 3)) << y;
  for (const float y : {-1e30f, -1.0f, 0.0f, 1.0f, 1e30f})
    for (const float m : {-5.0f, 0.0f, 5.0f}) {
      const float cut = firefly_cut(y, m, m * m, 3);
      EXPECT_TRUE(cut >= 0 && cut <= 1) << y << ' ' << m;
    }
}

TEST(Denoise, TrustIsTheSameOfLightBelowZero) {
  for (const float luminance : {0.0f, 0.1f, 40.0f})
    for (const float ahead : {-9.0f, 0.0f, 0.5f, 9.0f}) {
      EXPECT_EQ(history_trust(-luminance, 0.1f, ahead), history_trust(luminance, 0.1f, ahead));
      EXPECT_EQ(history_trust(luminance, 0.1f, -ahead), history_trust(luminance, 0.1f, ahead));
    }
  EXPECT_EQ(history_trust(1, 0.1f, 0), 1.0f);
  EXPECT_EQ(history_trust(-1, 0.1f, 9), 0.0f);
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
