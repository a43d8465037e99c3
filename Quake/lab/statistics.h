// What the laboratory says about a handful of numbers: means with their uncertainty, quantiles, intervals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace fb::lab {

double mean(std::span<const double> values);                // 0 for none
double standard_deviation(std::span<const double> values);  // n - 1 below the sum; 0 for fewer than two
double standard_error(std::span<const double> values);      // of the mean, as if independent
// By linear interpolation between order statistics; q in [0, 1]; 0 for none.
double quantile(std::vector<double> values, double q);
inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

// Student's t: P(T <= t) for whole degrees of freedom (Abramowitz and Stegun 1964, 26.7.3 and 26.7.4), and the t of
// which P(|T| <= t) is `confidence`.
double student_t_probability(double t, int degrees_of_freedom);
double student_t_quantile(double confidence, int degrees_of_freedom);

struct Interval {
  double low = 0, high = 0;
};
struct Estimate {
  double value = 0;
  Interval interval;  // 95%
};
// Of the mean, by Student's t. Both ends are the mean for fewer than two values.
Interval t_interval(std::span<const double> values, double confidence = 0.95);

// `runs` series of `length` values each; value f of run r has index r * length + f. Blocks of consecutive values are
// drawn with replacement, because frames of an estimator that learns are not independent (moving blocks, Kuensch 1989),
// and `statistic` gets runs * length indices. Returns the percentile interval; the same seed gives the same one. Where
// the statistic has no value, neither has the interval: both ends are NaN.
struct Series {
  std::size_t runs = 1, length = 0;
  std::size_t size() const { return runs * length; }
};
using Statistic = std::function<double(std::span<const std::size_t>)>;
Interval bootstrap_interval(const Series& series, const Statistic& statistic, double confidence = 0.95,
                            int resamples = 1000, std::uint64_t seed = 1);

}  // namespace fb::lab
