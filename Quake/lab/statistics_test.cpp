// Quantiles from tables, and intervals that cover what they should as often as they say.
#include "lab/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"

namespace fb::lab {
namespace {

double normal(Rng& rng) {  // Box and Muller
  return std::sqrt(-2 * std::log(1.0 - rng.uniform())) * std::cos(2 * M_PI * rng.uniform());
}

TEST(Statistics, OfFourNumbers) {
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

TEST(Statistics, StudentsTOfTheTables) {
  EXPECT_NEAR(student_t_quantile(0.95, 1), 12.706, 1e-3);
  EXPECT_NEAR(student_t_quantile(0.95, 2), 4.303, 1e-3);
  EXPECT_NEAR(student_t_quantile(0.95, 9), 2.262, 1e-3);
  EXPECT_NEAR(student_t_quantile(0.95, 30), 2.042, 1e-3);
  EXPECT_NEAR(student_t_quantile(0.99, 5), 4.032, 1e-3);
  EXPECT_NEAR(student_t_quantile(0.95, 100000), 1.95998, 1e-4);
  EXPECT_NEAR(student_t_probability(-2.262, 9), 0.025, 1e-4);
}

TEST(Statistics, IntervalsCoverTheTruthAsOftenAsTheySay) {
  // 400 series of 40 normal numbers with mean 5. The t interval covers 95% exactly; the bootstrap of blocks is known to
  // be too narrow for short series. Three binomial standard errors are 3.3%.
  Rng rng(11);
  int t_covers = 0, bootstrap_covers = 0;
  constexpr int kSeries = 400, kLength = 40;
  for (int s = 0; s < kSeries; ++s) {
    std::vector<double> values(kLength);
    for (double& v : values) v = 5 + 2 * normal(rng);
    const Interval t = t_interval(values);
    t_covers += t.low <= 5 && 5 <= t.high;
    const auto mean_at = [&](std::span<const std::size_t> indices) {
      double sum = 0;
      for (const std::size_t i : indices) sum += values[i];
      return sum / static_cast<double>(indices.size());
    };
    const Interval b = bootstrap_interval({4, kLength / 4}, mean_at, 0.95, 300, 1);
    bootstrap_covers += b.low <= 5 && 5 <= b.high;
  }
  EXPECT_NEAR(t_covers / double{kSeries}, 0.95, 0.033);
  EXPECT_GT(bootstrap_covers / double{kSeries}, 0.85);
  EXPECT_LT(bootstrap_covers / double{kSeries}, 0.985);
}

TEST(Statistics, BlocksKeepWhatBelongsTogether) {
  // Values that come in long stretches of equal ones: a bootstrap of single values would call their mean far too
  // certain.
  std::vector<double> values(64);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = (i / 8) % 2 == 0 ? 0.0 : 1.0;
  const auto mean_at = [&](std::span<const std::size_t> indices) {
    EXPECT_EQ(indices.size(), 64u);
    double sum = 0;
    for (const std::size_t i : indices) sum += values[i];
    return sum / 64;
  };
  const Interval interval = bootstrap_interval({1, 64}, mean_at);
  EXPECT_LT(interval.low, 0.33);  // 2 * 0.5 / sqrt(64) = 0.125 if they were independent
  EXPECT_GT(interval.high, 0.67);
  const Interval again = bootstrap_interval({1, 64}, mean_at);
  EXPECT_EQ(interval.low, again.low);
  int calls = 0;
  const auto sometimes_none = [&](std::span<const std::size_t>) { return ++calls % 7 == 0 ? std::nan("") : 1.0; };
  EXPECT_TRUE(std::isnan(bootstrap_interval({1, 64}, sometimes_none).low));
}

}  // namespace
}  // namespace fb::lab
