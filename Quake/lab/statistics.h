// What the laboratory says about a handful of numbers: means with their uncertainty, quantiles, intervals.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
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
// What is told of a figure: its value over independent runs and a 95% interval of what it would be over infinitely
// many. Not a number where it is not known.
struct Estimate {
  double value = 0;
  Interval interval;
  bool has_interval() const { return !std::isnan(interval.low) && !std::isnan(interval.high); }
};

// Intervals are Student's t over runs, whatever happens within one: frames of an estimator that learns depend on each
// other, and frames of one run share what it has learnt. t holds where runs' values are near to normal. Those of errors
// and times multiply, so it is taken of their logarithms; even these have long tails where rare samples rule, and with
// few runs such a sample is missing more often than an interval allows for. So fewer than these tell none, and where
// rare values rule (rare_values_rule) even these promise too much.
inline constexpr std::size_t kFewestRuns = 8;
// Times of whole runs and figures of finished pictures, whose tails are short.
inline constexpr std::size_t kFewestSteadyRuns = 4;

// The mean.
Estimate mean_over_runs(std::span<const double> runs, std::size_t fewest = kFewestRuns);
// The geometric mean, of figures that multiply (errors, times, ratios of these); not a number where one is not
// positive.
Estimate factor_over_runs(std::span<const double> runs, std::size_t fewest = kFewestRuns);
// The geometric mean of `above` over that of `below`, runs that are not paired (Welch 1947, of logarithms).
Estimate factor_between(std::span<const double> above, std::span<const double> below, std::size_t fewest = kFewestRuns);
// Whether rare values rule the sum: one of twenty or more holds over a tenth of it. What happens in fewer than a third
// of eight runs is often in none of them, so that no interval of these knows of it.
bool rare_values_rule(std::span<const double> values);
// The shape k of a generalised Pareto distribution fitted to the tail of `total` values (Zhang and Stephens 2009, with
// Vehtari 2024's prior for few): from 1 / n on moments of order n do not exist. `largest`: at least those that
// tail_count says, and one more. Not a number where there are fewer than 5, or all are the same.
std::size_t tail_count(std::size_t total);
double tail_shape(std::vector<double> largest, std::size_t total);
// From here on squared errors have no variance, and the interval of their mean promises too much.
inline constexpr double kHeavyTail = 0.5;
// Why there is no interval: "95% intervals want 8 runs; there are 3".
std::string too_few_runs(std::size_t runs, std::size_t fewest = kFewestRuns);

}  // namespace fb::lab
