// Quantiles from tables, and intervals that cover what they should as often as they say.
#include "lab/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/rng.h"

namespace fb::lab {
namespace {

double normal(Rng& rng) {  // Box and Muller
  return std::sqrt(-2 * std::log(1.0 - rng.uniform())) * std::cos(2 * M_PI * rng.uniform());
}

TEST(StatisticsOfRuns, OfFourNumbers) {
  const std::vector<double> values{1, 2, 3, 6};
  EXPECT_DOUBLE_EQ(mean(values), 3);
  EXPECT_DOUBLE_EQ(standard_deviation(values), std::sqrt(14.0 / 3));
  EXPECT_DOUBLE_EQ(standard_error(values), std::sqrt(14.0 / 3) / 2);
  EXPECT_DOUBLE_EQ(median(values), 2.5);
  EXPECT_DOUBLE_EQ(quantile(values, 0), 1);
  EXPECT_DOUBLE_EQ(quantile(values, 1), 6);
  EXPECT_DOUBLE_EQ(quantile({}, 0.5), 0);
  EXPECT_DOUBLE_EQ(standard_deviation(std::vector<double>{7}), 0);
}

TEST(StatisticsOfRuns, StudentsTOfTheTables) {
  EXPECT_NEAR(student_t_quantile(0.95, 1), 12.706, 1e-3);
  EXPECT_NEAR(student_t_quantile(0.95, 2), 4.303, 1e-3);
  EXPECT_NEAR(student_t_quantile(0.95, 9), 2.262, 1e-3);
  EXPECT_NEAR(student_t_quantile(0.95, 30), 2.042, 1e-3);
  EXPECT_NEAR(student_t_quantile(0.99, 5), 4.032, 1e-3);
  EXPECT_NEAR(student_t_quantile(0.95, 100000), 1.95998, 1e-4);
  EXPECT_NEAR(student_t_probability(-2.262, 9), 0.025, 1e-4);
}

// How often an interval holds `truth`, of so many.
template <typename Draw>
double coverage(int trials, double truth, const Draw& draw) {
  int held = 0;
  for (int i = 0; i < trials; ++i) {
    const Interval interval = draw().interval;
    held += interval.low <= truth && truth <= interval.high;
  }
  return held / static_cast<double>(trials);
}

TEST(StatisticsOfRuns, IntervalsCoverTheTruthAsOftenAsTheySay) {
  // 2000 trials: three binomial standard errors are 1.5%. Errors of runs are the exponential of normal numbers; two
  // sides that are unequally many and unequally noisy, as Welch allows for.
  constexpr int kTrials = 2000;
  constexpr double kThreeErrors = 0.0147;
  Rng rng(11);
  const auto runs = [&](std::size_t count, double log_mean, double deviation) {
    std::vector<double> values(count);
    for (double& v : values) v = std::exp(log_mean + deviation * normal(rng));
    return values;
  };
  for (const std::size_t n : {std::size_t{8}, std::size_t{40}}) {
    EXPECT_NEAR(coverage(kTrials, 5,
                         [&] {
                           std::vector<double> values(n);
                           for (double& v : values) v = 5 + 2 * normal(rng);
                           return mean_over_runs(values);
                         }),
                0.95, kThreeErrors)
        << n;
    EXPECT_NEAR(coverage(kTrials, std::exp(0.3), [&] { return factor_over_runs(runs(n, 0.3, 1.2)); }), 0.95,
                kThreeErrors)
        << n;
  }
  EXPECT_NEAR(coverage(kTrials, 2, [&] { return factor_over_runs(runs(4, std::log(2.0), 0.1), kFewestSteadyRuns); }),
              0.95, kThreeErrors);
  EXPECT_NEAR(coverage(kTrials, std::exp(0.5),
                       [&] { return factor_between(runs(4, 0.5, 0.1), runs(12, 0.0, 0.3), kFewestSteadyRuns); }),
              0.95, 0.02)
      << "Welch's degrees of freedom are approximate";
}

TEST(StatisticsOfRuns, FewRunsHaveNoInterval) {
  const std::vector<double> seven{1, 2, 1, 2, 1, 2, 1}, eight{1, 2, 1, 2, 1, 2, 1, 2};
  EXPECT_FALSE(mean_over_runs(seven).has_interval());
  EXPECT_FALSE(factor_over_runs(seven).has_interval());
  EXPECT_FALSE(factor_between(eight, seven).has_interval());
  EXPECT_NEAR(factor_between(eight, eight).value, 1, 1e-12);
  EXPECT_TRUE(factor_over_runs(eight).has_interval());
  EXPECT_NEAR(factor_over_runs(eight).value, std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(mean_over_runs(std::vector<double>{1, 2}, 2).has_interval());
  EXPECT_EQ(too_few_runs(3), "95% intervals want 8 runs; there are 3");
  EXPECT_EQ(too_few_runs(1, kFewestSteadyRuns), "95% intervals want 4 runs; there is 1");
}

TEST(StatisticsOfRuns, WhatDoesNotMultiplyHasNoFactor) {
  EXPECT_TRUE(std::isnan(factor_over_runs(std::vector<double>{1, 0, 1}).value));
  EXPECT_TRUE(std::isnan(factor_over_runs({}).value));
  EXPECT_TRUE(std::isnan(factor_between(std::vector<double>{1, 2}, std::vector<double>{1, NAN}).value));
}

TEST(StatisticsOfRuns, RareValuesThatRuleAreToldOf) {
  std::vector<double> values(128, 1.0);
  EXPECT_FALSE(rare_values_rule(values));
  values[5] = 10;
  EXPECT_FALSE(rare_values_rule(values));
  values[5] = 20;  // of 147
  EXPECT_TRUE(rare_values_rule(values));
  EXPECT_FALSE(rare_values_rule(std::vector<double>{1, 100})) << "of few, one always holds much";
  // Of 128 values whose logarithms have a deviation of 1, one holds so much in 11.4% of cases: 23 of 200, give or take
  // three binomial standard errors.
  Rng rng(3);
  int told = 0;
  for (int i = 0; i < 200; ++i) {
    for (double& v : values) v = std::exp(normal(rng));
    told += rare_values_rule(values);
  }
  EXPECT_NEAR(told, 23, 14);
}

TEST(StatisticsOfRuns, TheTailsShapeIsThatOfTheDistribution) {
  // Pareto of exponent a has shape 1 / a, an exponential 0, a uniform -1; of 20,000 values 424 are the tail, whose
  // shape k is known to about (1 + k) / sqrt(424), which is 0.1 at most here. The prior pulls by 10 in 434 to 0.5.
  constexpr std::size_t kValues = 20000;
  const auto shape = [](auto inverse) {
    Rng rng(8);
    std::vector<double> values(kValues);
    for (double& v : values) v = inverse(1.0 - rng.uniform());
    return tail_shape(std::move(values), kValues);
  };
  EXPECT_NEAR(shape([](double u) { return std::pow(u, -1.0); }), 1.0, 0.3);
  EXPECT_NEAR(shape([](double u) { return std::pow(u, -0.5); }), 0.5, 0.23);
  EXPECT_NEAR(shape([](double u) { return 7 * std::pow(u, -0.25); }), 0.25, 0.2);
  EXPECT_NEAR(shape([](double u) { return -std::log(u); }), 0.01, 0.16);
  EXPECT_NEAR(shape([](double u) { return 1 - u; }), -0.97, 0.16);
}

TEST(StatisticsOfRuns, TheLargestValuesAloneTellTheTail) {
  Rng rng(9);
  std::vector<double> values(1000);
  for (double& v : values) v = 1 / (1.0 - rng.uniform());
  std::vector<double> largest = values;
  std::ranges::sort(largest, std::greater<>());
  largest.resize(tail_count(values.size()) + 1);
  EXPECT_EQ(tail_shape(largest, values.size()), tail_shape(values, values.size()));
  largest.pop_back();
  EXPECT_TRUE(std::isnan(tail_shape(largest, values.size()))) << "no threshold";
  EXPECT_TRUE(std::isnan(tail_shape(std::vector<double>(10, 1.0), 10)));
  EXPECT_TRUE(std::isnan(tail_shape(std::vector<double>(1000, 1.0), 1000))) << "nothing varies";
  EXPECT_TRUE(std::isnan(tail_shape({}, 0)));
}

}  // namespace
}  // namespace fb::lab
