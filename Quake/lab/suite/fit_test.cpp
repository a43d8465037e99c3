#include "lab/suite/fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/rng.h"

namespace fb::lab {
namespace {

TEST(FitPower, FindsTheExponentOfAPower) {
  const std::vector<double> x{1, 2, 5, 10},
      y{3, 3 * std::pow(2.0, 1.5), 3 * std::pow(5.0, 1.5), 3 * std::pow(10.0, 1.5)};
  const auto fit = fit_power(x, y);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->value, 1.5, 1e-12);
  EXPECT_NEAR(fit->interval.low, 1.5, 1e-6);
  EXPECT_NEAR(fit->interval.high, 1.5, 1e-6);
}

// Noise of the logarithm: 95% of the intervals hold the exponent, to three standard errors of that share.
TEST(FitPower, ItsIntervalHoldsTheExponentAsOftenAsItSays) {
  Rng rng(3);
  constexpr int kTrials = 2000;
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> x, y;
    for (const double value : {1.0, 4.0, 16.0, 64.0, 256.0}) {
      double noise = 0;
      for (int i = 0; i < 12; ++i) noise += static_cast<double>(rng.uniform()) - 0.5;
      x.push_back(value);
      y.push_back(std::pow(value, 0.7) * std::exp(0.3 * noise));
    }
    const auto fit = fit_power(x, y);
    ASSERT_TRUE(fit);
    held += fit->interval.low <= 0.7 && 0.7 <= fit->interval.high ? 1 : 0;
  }
  EXPECT_NEAR(held / static_cast<double>(kTrials), 0.95, 0.015);
}

TEST(FitPower, HasNothingToSayOfTooLittle) {
  EXPECT_FALSE(fit_power(std::vector<double>{1, 2}, std::vector<double>{1, 2}));
  EXPECT_FALSE(fit_power(std::vector<double>{2, 2, 2}, std::vector<double>{1, 2, 3}));
  EXPECT_FALSE(fit_power(std::vector<double>{0, 1, 2}, std::vector<double>{1, 2, 3}));
  EXPECT_FALSE(fit_power(std::vector<double>{1, 2, 3}, std::vector<double>{1, 0, 3}));
}

}  // namespace
}  // namespace fb::lab
