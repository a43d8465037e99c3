#include "base/probability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "base/rng.h"
#include "base/test_chi_squared.h"

namespace fb {
namespace {

TEST(Probability, NormalTailsAndQuantilesAgree) {
  EXPECT_NEAR(two_sided_p(1.959964), 0.05, 1e-6);
  EXPECT_NEAR(normal_probability(1.959964), 0.975, 1e-6);
  for (const double p : {0.5, 0.05, 1e-6}) EXPECT_NEAR(two_sided_p(normal_quantile_two_sided(p)) / p, 1.0, 1e-9) << p;
}

TEST(Probability, ChiSquaredHasItsClosedForm) {
  for (const int half : {5, 15, 54}) {  // even degrees of freedom: a finite sum
    for (const double sigmas : {-1.0, 0.0, 1.0, 3.0, 6.0}) {
      const double x = 2 * half + sigmas * std::sqrt(4.0 * half);
      double term = std::exp(-0.5 * x), exact = 0;
      for (int k = 0; k < half; ++k) {
        exact += term;
        term *= 0.5 * x / (k + 1);
      }
      EXPECT_NEAR(chi_squared_p(x, 2 * half) / exact, 1.0, sigmas > 3 ? 0.3 : 0.03) << x << " of " << 2 * half;
    }
  }
}

// Counts of a fair die, or of a die that shows a six with the additional probability `more`.
ChiSquared die(double more, std::uint64_t seed) {
  constexpr int kDraws = 6000;
  double counts[6] = {};
  Rng rng(seed);
  for (int i = 0; i < kDraws; ++i) {
    const double u = static_cast<double>(rng.uniform());
    ++counts[u < more ? 5 : rng.below(6)];
  }
  ChiSquared test;
  for (const double count : counts) test.add(kDraws / 6.0, count);
  return test;
}

TEST(ChiSquaredTest, AlarmsAsOftenAsItSays) {
  int alarms = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) alarms += die(0.0, seed).p() < 0.05;
  EXPECT_NEAR(alarms, 50, 4 * 6.9) << "four standard deviations of a binomial count";
}

TEST(ChiSquaredTest, FindsALoadedDie) { EXPECT_LT(die(0.05, 1).p(), 1e-5); }

TEST(ChiSquaredTest, PoolsRareCellsAndLeavesOutTheRarest) {
  ChiSquared test;
  test.add(100, 90);
  EXPECT_EQ(test.p(), 1.0) << "one cell cannot be tested";
  test.add(4, 8);
  EXPECT_EQ(test.degrees(), 0) << "too rare";
  test.add(4, 8);
  EXPECT_EQ(test.degrees(), 1);
  EXPECT_DOUBLE_EQ(test.statistic(), 1.0 + 8.0) << "16 where 8 were expected";
  EXPECT_NEAR(test.p(), std::erfc(std::sqrt(9.0 / 2)), 0.001) << "one degree: z^2";
}

}  // namespace
}  // namespace fb
