// Mixtures of Gaussians over directions: density and samples agree and add up to one, samples in words, learning, and
// the sum over a frame's samples in place of one after the other (Eq. 19 to 21). The pass that does so on a device is
// tested in Quake/render/techniques/pstf_passes_test.cpp.
#include "estimators/pstf/pstf_gaussians.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/rng.h"
#include "base/test_chi_squared.h"

namespace fb::shared {
namespace {

constexpr double kAlarm = 1e-4, kGaussPi = 3.14159265358979323846;

using Mixture = std::vector<Gaussian>;

double mixture_density(const Mixture& m, const vec2& p) {
  double sum = 0;
  for (const Gaussian& g : m) sum += static_cast<double>(gaussian_density(g, p));
  return sum;
}
vec2 mixture_place(const Mixture& m, Rng& rng) {
  float u = rng.uniform();
  std::size_t i = 0;
  while (i + 1 < m.size() && u >= m[i].weight) u -= m[i++].weight;
  const float x = rng.uniform();
  return gaussian_draw(m[i], vec2(x, rng.uniform()));
}
Mixture first_mixture(uint count) {
  Mixture m;
  for (uint i = 0; i < count; ++i) m.push_back(first_gaussian(i, count));
  return m;
}

TEST(PstfGaussians, TheErrorFunctionAndItsInverse) {
  for (double x = -4; x <= 4; x += 0.01)
    EXPECT_NEAR(static_cast<double>(error_function(static_cast<float>(x))), std::erf(x), 4e-7) << x;
  for (double e = -0.9999; e < 1; e += 0.0001)
    EXPECT_NEAR(std::erf(static_cast<double>(inverse_error_function(static_cast<float>(e)))), e, 8e-7) << e;
  for (const float e : {-1.0f, 1.0f}) {
    EXPECT_TRUE(std::isfinite(inverse_error_function(e)));
    EXPECT_GT(std::abs(inverse_error_function(e)), 3.5f);
  }
}

// Narrow and wide ones, in the corners, stretched along a diagonal, whose middle leaves the square.
const Mixture kShapes[] = {
    first_mixture(4),
    first_mixture(8),
    {gaussian_from(1, vec2(1, -1), 0.04f, 0.01f, 0.015f)},
    {gaussian_from(1, vec2(0.7f, 0.8f), 1, 1, 0.99f)},
    {gaussian_from(0.3f, vec2(0.1f, 0.2f), 0, 0, 0), gaussian_from(0.7f, vec2(-0.5f), 0.5f, 0.5f, -0.49f)}};

TEST(PstfGaussians, DensitiesAddUpToOneOverAllDirections) {
  for (const Mixture& m : kShapes) {
    constexpr int kPoints = 500;
    double sum = 0;
    for (int i = 0; i < kPoints; ++i)
      for (int k = 0; k < kPoints; ++k)
        sum += mixture_density(m, (vec2(i, k) + vec2(0.5f)) * (2.0f / kPoints) - vec2(1));
    EXPECT_NEAR(sum * 4 / (kPoints * kPoints) * kGaussPi, 1, 2e-5);
  }
}

// Chi squared of what is drawn against the density, over even parts of the square.
TEST(PstfGaussians, DrawsHaveTheirDensity) {
  Rng rng(3);
  for (const Mixture& m : kShapes) {
    constexpr int kSide = 16, kPoints = 24, kDraws = 100000;
    std::array<double, kSide * kSide> drawn{};
    for (int i = 0; i < kDraws; ++i) {
      const vec2 p = mixture_place(m, rng);
      ASSERT_LE(std::max(std::abs(p.x), std::abs(p.y)), 1);
      const int x = std::min(static_cast<int>((p.x + 1) * 0.5f * kSide), kSide - 1);
      drawn[x + kSide * std::min(static_cast<int>((p.y + 1) * 0.5f * kSide), kSide - 1)] += 1;
    }
    ChiSquared test;
    for (int bin = 0; bin < kSide * kSide; ++bin) {
      double sum = 0;
      for (int i = 0; i < kPoints; ++i)
        for (int k = 0; k < kPoints; ++k)
          sum += mixture_density(
              m, (vec2(bin % kSide, bin / kSide) + (vec2(i, k) + vec2(0.5f)) * (1.0f / kPoints)) * (2.0f / kSide) -
                     vec2(1));
      test.add(sum * kGaussPi * 4 / (kSide * kSide * kPoints * kPoints) * kDraws, drawn[bin]);
    }
    EXPECT_GT(test.p(), kAlarm) << test.statistic() << " of " << test.degrees();
  }
}

TEST(PstfGaussians, SamplesKeepTheirPlaceAndWeight) {
  Rng rng(5);
  double sum = 0, kept = 0;
  for (int i = 0; i < 20000; ++i) {
    const vec2 p(rng.uniform(-1, 1), rng.uniform(-1, 1));
    const float weight = std::exp2(rng.uniform(-19, 7.9f));
    const uint word = sample_word(p, weight, rng.uniform(), static_cast<uint>(i));
    EXPECT_LE(std::abs(word_place(word).x - p.x), 1.001f / 256);
    EXPECT_LE(std::abs(word_place(word).y - p.y), 1.001f / 256);
    EXPECT_NEAR(word_weight(word), weight, 0.02f * weight);
    sum += static_cast<double>(weight);
    kept += static_cast<double>(word_weight(word));
  }
  EXPECT_NEAR(kept / sum, 1, 1e-3);
  EXPECT_EQ(word_weight(sample_word(vec2(1), 1e9f, 0.5f, 63)), word_weight(sample_word(vec2(1), 256, 0, 0)));
  for (const float none : {0.0f, -1.0f, 1e-9f, std::nanf("")}) EXPECT_EQ(sample_word(vec2(0), none, 0.5f, 63), 0u);
  EXPECT_EQ(word_weight(0), 0);
}

struct Sample {
  vec2 place;
  float weight;
};
// One after the other (Eq. 16).
std::vector<GaussianSums> learnt_in_turns(const Mixture& m, std::vector<GaussianSums> sums,
                                          const std::vector<Sample>& samples, float seen) {
  for (const Sample& s : samples) {
    const float step = gaussian_step(seen += 1), all = static_cast<float>(mixture_density(m, s.place));
    for (std::size_t i = 0; i < m.size(); ++i) {
      const float own = responsibility_of(gaussian_density(m[i], s.place), all, static_cast<uint>(m.size()));
      sums[i] = joined_sums(sums[i], 1 - step, sample_sums(s.place, s.weight, own, step));
    }
  }
  return sums;
}
// By what is left of each at the end: the exponential of the sum of logarithms, or as Eq. 21 is printed, without them.
std::vector<GaussianSums> learnt_at_once(const Mixture& m, const std::vector<GaussianSums>& before,
                                         const std::vector<Sample>& samples, float seen, bool as_printed) {
  double after = 0;
  std::vector<double> left(samples.size());
  for (std::size_t k = samples.size(); k-- > 0;) {
    left[k] = std::exp(after);
    const double kept = 1 - static_cast<double>(gaussian_step(seen + static_cast<float>(k) + 1));
    after += as_printed ? kept : std::log(kept);
  }
  std::vector<GaussianSums> sums(m.size(), no_sums());
  for (std::size_t i = 0; i < m.size(); ++i) {
    sums[i] = joined_sums(before[i], static_cast<float>(std::exp(after)), no_sums());
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const float all = static_cast<float>(mixture_density(m, samples[k].place));
      const float own = responsibility_of(gaussian_density(m[i], samples[k].place), all, static_cast<uint>(m.size()));
      GaussianSums one =
          sample_sums(samples[k].place, samples[k].weight, own, gaussian_step(seen + static_cast<float>(k) + 1));
      one.a *= static_cast<float>(left[k]);
      one.b *= static_cast<float>(left[k]);
      sums[i] = joined_sums(sums[i], 1, one);
    }
  }
  return sums;
}
double farthest(const std::vector<GaussianSums>& one, const std::vector<GaussianSums>& other) {
  double most = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
    for (int k = 0; k < 4; ++k)
      for (const auto& [a, b] : {std::pair(one[i].a[k], other[i].a[k]), std::pair(one[i].b[k], other[i].b[k])})
        most = std::max(most, static_cast<double>(std::abs(a - b) / std::max(1.0f, std::abs(a))));
  return most;
}

TEST(PstfGaussians, SumsOfLogarithmsAreWhatIsLeftOfSamples) {
  Rng rng(11);
  for (const uint count : {4u, 8u}) {
    for (const float seen : {0.0f, 1000.0f}) {
      const Mixture m = first_mixture(count);
      const std::vector<GaussianSums> before(count, {vec4(0.3f, 0.1f, -0.1f, 0.2f), vec4(0.2f, 0, 1.2f, 9)});
      std::vector<Sample> samples(200);
      for (Sample& s : samples) s = {vec2(rng.uniform(-1, 1), rng.uniform(-1, 1)), rng.uniform(0, 3)};
      const std::vector<GaussianSums> turns = learnt_in_turns(m, before, samples, seen);
      EXPECT_LT(farthest(turns, learnt_at_once(m, before, samples, seen, false)), 1e-4) << count;
      EXPECT_GT(farthest(turns, learnt_at_once(m, before, samples, seen, true)), 1) << "as printed";
    }
  }
}

// Two bright spots over dim light, drawn half from the mixture and half evenly: the weights hold the density.
TEST(PstfGaussians, LightIsFound) {
  const vec2 spots[] = {vec2(0.4f, 0.3f), vec2(-0.6f, -0.5f)};
  const auto light = [&](const vec2& p) {
    double sum = 0.02;
    for (const vec2& spot : spots) sum += std::exp(-static_cast<double>(dot(p - spot, p - spot)) / 0.005);
    return sum;
  };
  for (const uint count : {4u, 8u}) {
    Mixture m = first_mixture(count);
    std::vector<GaussianSums> sums(count, no_sums());
    Rng rng(7);
    float seen = 0;
    for (int frame = 0; frame < 60; ++frame) {
      std::vector<Sample> samples(16);
      for (Sample& s : samples) {
        s.place = rng.uniform() < 0.5f ? mixture_place(m, rng) : vec2(rng.uniform(-1, 1), rng.uniform(-1, 1));
        const double pdf = 0.5 * mixture_density(m, s.place) * kGaussPi + 0.5 / 4;
        s.weight = static_cast<float>(light(s.place) / pdf);
      }
      sums = learnt_in_turns(m, sums, samples, seen);
      seen += 16;
      for (uint i = 0; i < count; ++i) m[i] = learnt_gaussian(sums[i], i, count);
    }
    double weights = 0;
    for (const Gaussian& g : m) weights += static_cast<double>(g.weight);
    EXPECT_NEAR(weights, 1, 1e-5);
    for (const vec2& spot : spots)
      EXPECT_GT(mixture_density(m, spot), 4 * mixture_density(first_mixture(count), spot)) << count;
    // What is left of the variance of light over density, with the same share of even directions.
    const auto square = [&](const Mixture& of) {
      double sum = 0, mean = 0;
      constexpr int kPoints = 200;
      for (int i = 0; i < kPoints; ++i) {
        for (int k = 0; k < kPoints; ++k) {
          const vec2 p = (vec2(i, k) + vec2(0.5f)) * (2.0f / kPoints) - vec2(1);
          const double l = light(p);
          sum += l * l / (0.5 * mixture_density(of, p) * kGaussPi + 0.5 / 4) * 4 / (kPoints * kPoints);
          mean += l * 4 / (kPoints * kPoints);
        }
      }
      return sum / (mean * mean) - 1;
    };
    EXPECT_LT(square(m), 0.4 * square(first_mixture(count))) << count;
  }
}

// No samples, one, all at one point, weights of nothing: a whole density all the same.
TEST(PstfGaussians, MixturesOfNextToNothing) {
  const auto expect_whole = [](const GaussianSums& s) {
    const Gaussian g = learnt_gaussian(s, 1, 4);
    for (const float x : {g.scale, g.x, g.over_x, g.y, g.over_y, g.slope, g.weight}) EXPECT_TRUE(std::isfinite(x));
    EXPECT_GT(g.weight, 0);
    EXPECT_GE(1 / g.over_x, kLeastDeviation);
    EXPECT_GE(1 / g.over_y, kLeastDeviation);
  };
  expect_whole(no_sums());
  expect_whole(sample_sums(vec2(1, -1), 256, 1, gaussian_step(1)));
  expect_whole(sample_sums(vec2(1, -1), 256, 0, gaussian_step(1)));
  GaussianSums many = no_sums();
  for (int i = 1; i <= 100000; ++i)
    many = joined_sums(many, 1 - gaussian_step(static_cast<float>(i)),
                       sample_sums(vec2(0.25f), 256, 1, gaussian_step(static_cast<float>(i))));
  expect_whole(many);
  EXPECT_NEAR(learnt_gaussian(many, 1, 4).x, 0.25f, 1e-2f);
  EXPECT_NEAR(learnt_gaussian(first_gaussian(0, 4).weight > 0 ? no_sums() : many, 1, 4).weight, 0.25f, 1e-6f);
}

}  // namespace
}  // namespace fb::shared
