// Pearson's chi-squared test of counts against their expected values, for tests of samplers:
//
//   ChiSquared test;
//   for (...) test.add(probability[i] * draws, seen[i]);
//   EXPECT_GT(test.p(), kFalseAlarm);
//
// The seeds of tests are fixed, so a test that passes once always passes; the false-alarm rate is the probability that
// a correct sampler needs another seed.
#pragma once

#include "base/probability.h"

namespace fb {

class ChiSquared {
 public:
  // Cells with fewer expected draws are pooled, since their counts are not nearly normal (Cochran 1954). A pool with no
  // more than this is left out.
  static constexpr double kLeastExpected = 5;

  void add(double expected, double seen) {
    if (expected < kLeastExpected) {
      pooled_expected_ += expected;
      pooled_seen_ += seen;
    } else {
      sum_ += term(expected, seen);
      ++cells_;
    }
  }

  double statistic() const { return sum_ + (has_pool() ? term(pooled_expected_, pooled_seen_) : 0.0); }
  int degrees() const { return cells_ + (has_pool() ? 1 : 0) - 1; }
  // The probability of a statistic this large by chance; 1 with fewer than two cells.
  double p() const { return degrees() < 1 ? 1.0 : chi_squared_p(statistic(), degrees()); }

 private:
  static double term(double expected, double seen) { return (seen - expected) * (seen - expected) / expected; }
  bool has_pool() const { return pooled_expected_ > kLeastExpected; }

  double sum_ = 0, pooled_expected_ = 0, pooled_seen_ = 0;
  int cells_ = 0;
};

}  // namespace fb
