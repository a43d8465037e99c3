// render/techniques/reweighting.h on a domain of three points, where every outcome of two or three iterations that
// teach each other is enumerated with its probability: what each weight loses is computed, not measured.
#include "render/techniques/reweighting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

namespace fb::render {
namespace {

constexpr std::size_t kPoints = 3;
using Density = std::array<double, kPoints>;
constexpr Density kLight{6, 0, 1};              // f: one point is dark
constexpr Density kScattered{0.15, 0.6, 0.25};  // of the first iteration, and half of all others
constexpr double kIntegral = 7, kExact = 1e-12;

// What samples of density p teach: half of it as they found light, each weighed by 1 / p.
Density taught(const std::vector<std::size_t>& samples, const Density& p) {
  Density found{};
  for (const std::size_t x : samples) found[x] += kLight[x] / p[x];
  const double sum = std::accumulate(found.begin(), found.end(), 0.0);
  Density next = kScattered;
  if (sum > 0)
    for (std::size_t x = 0; x < kPoints; ++x) next[x] = 0.5 * kScattered[x] + 0.5 * found[x] / sum;
  return next;
}

struct Iteration {
  Density density{};
  std::vector<std::size_t> seen;
};
using Iterations = std::vector<Iteration>;
using Estimator = std::function<double(const Iterations&)>;

// All outcomes of `count` samples, in whatever order: calls `each` with them and their probability.
void enumerate(std::size_t count, const Density& p,
               const std::function<void(const std::vector<std::size_t>&, double)>& each) {
  const auto n = static_cast<double>(count);
  for (std::size_t zeros = 0; zeros <= count; ++zeros) {
    for (std::size_t ones = 0; zeros + ones <= count; ++ones) {
      const std::array<double, kPoints> of{static_cast<double>(zeros), static_cast<double>(ones),
                                           static_cast<double>(count - zeros - ones)};
      double log_probability = std::lgamma(n + 1);
      std::vector<std::size_t> samples;
      for (std::size_t x = 0; x < kPoints; ++x) {
        log_probability += of[x] * std::log(p[x]) - std::lgamma(of[x] + 1);
        samples.insert(samples.end(), static_cast<std::size_t>(of[x]), x);
      }
      each(samples, std::exp(log_probability));
    }
  }
}

// The expectation of an estimator of iterations of so many samples. `apart`: so many others teach.
double expectation(const std::vector<std::size_t>& schedule, bool apart, const Estimator& estimator) {
  Iterations iterations;
  double sum = 0;
  const std::function<void(const Density&, double)> next = [&](const Density& p, double probability) {
    const std::size_t i = iterations.size();
    if (i == schedule.size()) {
      sum += probability * estimator(iterations);
      return;
    }
    enumerate(schedule[i], p, [&](const std::vector<std::size_t>& seen, double chance) {
      iterations.push_back({p, seen});
      if (apart)
        enumerate(schedule[i], p, [&](const std::vector<std::size_t>& teaching, double other) {
          next(taught(teaching, p), probability * chance * other);
        });
      else
        next(taught(seen, p), probability * chance);
      iterations.pop_back();
    });
  };
  next(kScattered, 1);
  return sum;
}

std::vector<double> counts_of(const Iterations& iterations) {
  std::vector<double> counts;
  for (const Iteration& i : iterations) counts.push_back(static_cast<double>(i.seen.size()));
  return counts;
}
std::vector<double> log_ratios(const Iterations& iterations, std::size_t x, std::size_t own) {
  std::vector<double> ratios;
  for (const Iteration& i : iterations) ratios.push_back(std::log(i.density[x] / iterations[own].density[x]));
  return ratios;
}
// Sum over all samples of f / p times a factor.
double weighed(const Iterations& iterations, const std::function<double(std::size_t own, std::size_t x)>& factor) {
  double sum = 0;
  for (std::size_t i = 0; i < iterations.size(); ++i)
    for (const std::size_t x : iterations[i].seen) sum += kLight[x] / iterations[i].density[x] * factor(i, x);
  return sum;
}
struct Moments {
  double mean = 0, second = 0, variance = 0;
};
Moments moments_of(const Iteration& iteration) {
  Moments m;
  const auto n = static_cast<double>(iteration.seen.size());
  for (const std::size_t x : iteration.seen) {
    const double value = kLight[x] / iteration.density[x];
    m.mean += value / n;
    m.second += value * value / n;
  }
  m.variance = n > 1 ? std::max(m.second - m.mean * m.mean, 0.0) * n / (n - 1) : std::nan("");
  return m;
}

double balance(const Iterations& iterations) {
  const std::vector<double> counts = counts_of(iterations);
  return weighed(iterations, [&](std::size_t own, std::size_t x) {
    return balance_factor(log_ratios(iterations, x, own), counts);
  });
}
double variance_aware(const Iterations& iterations) {
  const std::vector<double> counts = counts_of(iterations);
  std::vector<double> v;
  for (const Iteration& i : iterations) v.push_back(variance_factor(moments_of(i).second, moments_of(i).variance));
  return weighed(iterations, [&](std::size_t own, std::size_t x) {
    return variance_aware_factor(log_ratios(iterations, x, own), counts, v, own);
  });
}
// Room for half of the samples of an iteration: after each the dimmest go, by the mixture so far.
double partial(const Iterations& iterations, bool reweighted) {
  struct Kept {
    std::size_t own, x;
    double value;
  };
  const std::vector<double> counts = counts_of(iterations);
  const double samples = std::accumulate(counts.begin(), counts.end(), 0.0);
  std::vector<Kept> kept;
  double sum = 0;
  const auto span_of = [](const std::vector<double>& all, std::size_t n) {
    return std::span<const double>(all.data(), n);
  };
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    for (const std::size_t x : iterations[i].seen) kept.push_back({i, x, kLight[x] / iterations[i].density[x]});
    std::ranges::stable_sort(kept, [](const Kept& a, const Kept& b) { return a.value > b.value; });
    const std::size_t room = (iterations.front().seen.size() + 1) / 2;
    for (; kept.size() > room; kept.pop_back()) {
      const std::vector<double> ratios = log_ratios(iterations, kept.back().x, kept.back().own);
      sum += kept.back().value / samples *
             (reweighted ? partial_factor(span_of(ratios, i + 1), span_of(counts, i + 1)) : 1);
    }
  }
  for (const Kept& k : kept) sum += k.value * balance_factor(log_ratios(iterations, k.x, k.own), counts);
  return sum;
}
double accumulated(const Iterations& iterations) {
  const std::vector<double> counts = counts_of(iterations);
  const double samples = std::accumulate(counts.begin(), counts.end(), 0.0);
  return weighed(iterations, [&](std::size_t, std::size_t) { return 1 / samples; });
}
double last_alone(const Iterations& iterations) { return moments_of(iterations.back()).mean; }
double by_inverse_variance(const Iterations& iterations) {
  const std::vector<double> counts = counts_of(iterations);
  std::vector<double> variances;
  for (std::size_t i = 0; i < iterations.size(); ++i)
    variances.push_back(moments_of(iterations[i]).variance / counts[i]);
  const std::vector<double> shares = inverse_variance_shares(variances, counts);
  double sum = 0;
  for (std::size_t i = 0; i < iterations.size(); ++i) sum += shares[i] * moments_of(iterations[i]).mean;
  return sum;
}

// Relative.
double bias_of(const std::vector<std::size_t>& schedule, bool apart, const Estimator& estimator) {
  return expectation(schedule, apart, estimator) / kIntegral - 1;
}

TEST(ReweightingSequences, EnergyIsLostWhereTheSameSamplesTeach) {
  double former = -1, bias = -1;
  for (const std::size_t n : {1u, 2u, 4u, 8u, 16u, 32u}) {
    bias = bias_of({n, n}, false, balance);
    EXPECT_LT(bias, -1e-3) << n;
    EXPECT_GT(bias, former) << n << ": it falls with samples";
    former = bias;
  }
  EXPECT_GT(bias, -0.01) << "from 28% with one sample an iteration";
  EXPECT_LT(bias_of({2, 2, 2}, false, balance), -1e-3);
  EXPECT_GT(bias_of({4, 4, 4}, false, balance), bias_of({2, 2, 2}, false, balance));
}

// The paper finds slightly more bias; here that is so with a few samples and turns round with many.
TEST(ReweightingSequences, VarianceAwarenessLosesMoreOnlyWithFewSamples) {
  for (const std::size_t n : {4u, 8u, 12u})
    EXPECT_LT(bias_of({n, n}, false, variance_aware), bias_of({n, n}, false, balance)) << n;
  const double many = bias_of({24, 24}, false, variance_aware);
  EXPECT_GT(many, bias_of({24, 24}, false, balance));
  EXPECT_LT(many, -1e-3);
}

TEST(ReweightingSequences, AConstantStoreIsBiasedAsAFullOneWithThePartialMixture) {
  const auto with = [](bool reweighted) { return [=](const Iterations& i) { return partial(i, reweighted); }; };
  for (const std::vector<std::size_t>& schedule : {std::vector<std::size_t>{4, 4}, {2, 2, 2}, {8, 8}, {20, 20}}) {
    const double partial_bias = bias_of(schedule, false, with(true)), naive = bias_of(schedule, false, with(false));
    EXPECT_LT(naive, partial_bias - 0.02) << "what was let go of without a weight";
    EXPECT_NEAR(partial_bias, bias_of(schedule, false, balance), 0.05);
  }
  EXPECT_NEAR(bias_of({20, 20}, false, with(true)), bias_of({20, 20}, false, balance), 1e-3);
  EXPECT_LT(bias_of({20, 20}, false, with(false)), -0.07) << "which does not fall to zero";
  // What is kept hangs on other samples: so even where others teach there is a rest.
  const double apart = bias_of({4, 4}, true, with(true));
  EXPECT_GT(std::abs(apart), 1e-3);
  EXPECT_LT(std::abs(apart), 5e-3);
}

TEST(ReweightingSequences, NothingIsLostWhereOtherSamplesTeach) {
  for (const std::vector<std::size_t>& schedule :
       {std::vector<std::size_t>{1, 1}, {2, 2}, {1, 1, 1}, {2, 1, 2}, {1, 3}})
    EXPECT_NEAR(bias_of(schedule, true, balance), 0, kExact) << schedule.size();
  EXPECT_NEAR(bias_of({4, 4}, true, balance), 0, kExact);
  // Weights of the seen samples' own variance depend on them all the same.
  EXPECT_GT(std::abs(bias_of({2, 2}, true, variance_aware)), 1e-3);
}

TEST(ReweightingSequences, WhatTheFoilsLose) {
  EXPECT_NEAR(bias_of({2, 2, 1}, false, accumulated), 0, kExact);
  EXPECT_NEAR(bias_of({2, 2, 1}, false, last_alone), 0, kExact);
  EXPECT_LT(bias_of({3, 3}, false, by_inverse_variance), -1e-3) << "of a pixel: weights depend on its samples";
}

TEST(ReweightingSequences, FactorsOfAllIterationsAddUpToOne) {
  // A path that each of three iterations may make: the sum of n_i p_i times the factor is 1 (Eq. 3's condition).
  const std::array<double, 3> p{0.3, 1e-9, 4e7}, counts{2, 8, 5}, v{1, 2.5, 1.2};
  double balance_sum = 0, aware_sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    std::array<double, 3> ratios{};
    for (std::size_t k = 0; k < p.size(); ++k) ratios[k] = std::log(p[k] / p[i]);
    balance_sum += counts[i] * balance_factor(ratios, counts);
    aware_sum += counts[i] * variance_aware_factor(ratios, counts, v, i);
  }
  EXPECT_NEAR(balance_sum, 1, kExact);
  EXPECT_NEAR(aware_sum, 1, kExact);
}

TEST(ReweightingSequences, DensitiesOfZeroAndOf1e30StayFinite) {
  const double infinite = std::numeric_limits<double>::infinity();
  const std::array<double, 3> counts{2, 2, 4};
  const std::array<double, 3> never{0, -infinite, -infinite};
  EXPECT_DOUBLE_EQ(balance_factor(never, counts), 0.5) << "of its own iteration alone";
  // Twelve vertices of density 1e30 beside 1e-6.
  const double far = 12 * std::log(1e36);
  const std::array<double, 3> large{0, far, far}, small{0, -far, -far};
  EXPECT_GE(balance_factor(large, counts), 0);
  EXPECT_LT(balance_factor(large, counts), 1e-300);
  EXPECT_DOUBLE_EQ(balance_factor(small, counts), 0.5);
  const std::array<double, 3> no_number{0, std::nan(""), 0};
  EXPECT_DOUBLE_EQ(balance_factor(no_number, counts), 1.0 / 6);
  const std::array<double, 3> beyond{0, infinite, 0};
  EXPECT_EQ(balance_factor(beyond, counts), 0);
  const std::array<double, 3> one_empty{0, 0, 0}, some{2, 0, 2};
  EXPECT_DOUBLE_EQ(balance_factor(one_empty, some), 0.25) << "an iteration of no samples";
  EXPECT_EQ(variance_factor(0, 0), 1);
  EXPECT_EQ(variance_factor(1, 0), kMostVarianceFactor);
  EXPECT_EQ(variance_factor(1, std::nan("")), 1);
  EXPECT_DOUBLE_EQ(variance_factor(3, 2), 1.5);
}

TEST(ReweightingSequences, SharesOfWholeIterations) {
  const std::array<double, 3> counts{1, 2, 4};
  const auto shares = inverse_variance_shares(std::array{std::nan(""), 2.0, 0.5}, counts);
  EXPECT_DOUBLE_EQ(shares[0], 0);
  EXPECT_DOUBLE_EQ(shares[1], 0.2);
  EXPECT_DOUBLE_EQ(shares[2], 0.8);
  const auto unknown = inverse_variance_shares(std::array{std::nan(""), std::nan(""), std::nan("")}, counts);
  EXPECT_DOUBLE_EQ(unknown[2], 4.0 / 7);
  const auto exact = inverse_variance_shares(std::array{0.0, 1.0, 0.0}, counts);
  EXPECT_DOUBLE_EQ(exact[0], 0.5);
  EXPECT_DOUBLE_EQ(exact[1], 0);
}

}  // namespace
}  // namespace fb::render
