// For tests of samplers: do counts follow the distribution that they should (Pearson's chi-squared)?
//
//   ChiSquared test;
//   for (...) test.add(probability[i] * draws, seen[i]);
//   EXPECT_GT(test.p(), kFalseAlarm);
//
// With fixed seeds a test that is right once stays so; the false-alarm rate says how seldom a right sampler had to be
// given another seed.
#pragma once

#include "base/probability.h"

namespace fb {

class ChiSquared {
 public:
  // Cells of fewer expected draws are pooled into one, since their counts are far from normal (Cochran 1954); so few
  // that even the pool has no more are left out.
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
  // How likely chance alone is to stray this far; 1 where there are not two cells to compare.
  double p() const { return degrees() < 1 ? 1.0 : chi_squared_p(statistic(), degrees()); }

 private:
  static double term(double expected, double seen) { return (seen - expected) * (seen - expected) / expected; }
  bool has_pool() const { return pooled_expected_ > kLeastExpected; }

  double sum_ = 0, pooled_expected_ = 0, pooled_seen_ = 0;
  int cells_ = 0;
};

}  // namespace fb
