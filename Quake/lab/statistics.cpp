#include "lab/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "base/check.h"

namespace fb::lab {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr Interval kUnknown{kNone, kNone};

// Nothing where one has none.
std::optional<std::vector<double>> logarithms(std::span<const double> values) {
  std::vector<double> logs;
  for (const double v : values) {
    if (!(v > 0)) return std::nullopt;
    logs.push_back(std::log(v));
  }
  if (logs.empty()) return std::nullopt;
  return logs;
}

Estimate exponential(const Estimate& e) {
  return {std::exp(e.value), {std::exp(e.interval.low), std::exp(e.interval.high)}};
}

}  // namespace

double mean(std::span<const double> values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return 0;
  const double center = mean(values);
  double sum = 0;
  for (const double v : values) sum += (v - center) * (v - center);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double standard_error(std::span<const double> values) {
  return values.empty() ? 0 : standard_deviation(values) / std::sqrt(static_cast<double>(values.size()));
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double at = std::clamp(q, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const std::size_t below = static_cast<std::size_t>(at), above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

double student_t_probability(double t, int degrees_of_freedom) {
  FB_CHECK(degrees_of_freedom >= 1);
  const int n = degrees_of_freedom;
  const double angle = std::atan(t / std::sqrt(static_cast<double>(n)));
  const double sine = std::sin(angle), cosine2 = std::cos(angle) * std::cos(angle);
  double within = 0;  // P(|T| <= |t|), with the sign of t
  if (n % 2 == 1) {
    double term = std::cos(angle), sum = 0;
    for (int k = 3; k <= n; k += 2) {
      sum += term;
      term *= cosine2 * (k - 1) / k;
    }
    within = 2 / std::numbers::pi * (angle + sine * sum);
  } else {
    double term = 1, sum = 0;
    for (int k = 2; k <= n; k += 2) {
      sum += term;
      term *= cosine2 * (k - 1) / k;
    }
    within = sine * sum;
  }
  return 0.5 + 0.5 * within;
}

double student_t_quantile(double confidence, int degrees_of_freedom) {
  const double wanted = 0.5 + 0.5 * confidence;
  double low = 0, high = 1;
  while (student_t_probability(high, degrees_of_freedom) < wanted) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (student_t_probability(middle, degrees_of_freedom) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Estimate mean_over_runs(std::span<const double> runs, std::size_t fewest) {
  const double center = mean(runs);
  if (runs.size() < std::max(fewest, std::size_t{2})) return {center, kUnknown};
  const double half = student_t_quantile(0.95, static_cast<int>(runs.size()) - 1) * standard_error(runs);
  return {center, {center - half, center + half}};
}

Estimate factor_over_runs(std::span<const double> runs, std::size_t fewest) {
  const auto logs = logarithms(runs);
  return logs ? exponential(mean_over_runs(*logs, fewest)) : Estimate{kNone, kUnknown};
}

Estimate factor_between(std::span<const double> above, std::span<const double> below, std::size_t fewest) {
  const auto a = logarithms(above), b = logarithms(below);
  if (!a || !b) return {kNone, kUnknown};
  const double center = mean(*a) - mean(*b);
  if (std::min(a->size(), b->size()) < std::max(fewest, std::size_t{2})) return {std::exp(center), kUnknown};
  const double square_a = standard_error(*a) * standard_error(*a), square_b = standard_error(*b) * standard_error(*b);
  const double square = square_a + square_b;
  if (!(square > 0)) return exponential({center, {center, center}});
  const double degrees = square * square /
                         (square_a * square_a / static_cast<double>(a->size() - 1) +
                          square_b * square_b / static_cast<double>(b->size() - 1));
  // Rounded down: wider rather than narrower.
  const double half = student_t_quantile(0.95, std::max(1, static_cast<int>(degrees))) * std::sqrt(square);
  return exponential({center, {center - half, center + half}});
}

bool rare_values_rule(std::span<const double> values) {
  constexpr std::size_t kFewest = 20;
  if (values.size() < kFewest) return false;
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return sum > 0 && *std::ranges::max_element(values) > 0.1 * sum;
}

std::size_t tail_count(std::size_t total) {
  const double n = static_cast<double>(total);
  return static_cast<std::size_t>(std::min(0.2 * n, 3 * std::sqrt(n)));
}

double tail_shape(std::vector<double> largest, std::size_t total) {
  const std::size_t n = tail_count(total);
  if (n < 5 || largest.size() <= n) return kNone;
  std::ranges::sort(largest);
  const double threshold = largest[largest.size() - n - 1];
  std::vector<double> x(largest.end() - static_cast<std::ptrdiff_t>(n), largest.end());
  for (double& value : x) value -= threshold;
  const double quartile = x[static_cast<std::size_t>(static_cast<double>(n) / 4 + 0.5) - 1], most = x.back();
  if (!(quartile > 0)) return kNone;
  // The mean over a grid of theta = k / scale, each weighed by its profile likelihood; mean_log(theta) is k there.
  const auto mean_log = [&](double theta) {
    double sum = 0;
    for (const double value : x) sum += std::log1p(-theta * value);
    return sum / static_cast<double>(n);
  };
  const std::size_t grid = 30 + static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
  std::vector<double> thetas(grid), likelihoods(grid);
  for (std::size_t i = 0; i < grid; ++i) {
    const double at = 1 - std::sqrt(static_cast<double>(grid) / (static_cast<double>(i) + 0.5));
    thetas[i] = 1 / most + at / (3 * quartile);
    const double k = mean_log(thetas[i]);
    likelihoods[i] = static_cast<double>(n) * (std::log(-thetas[i] / k) - k - 1);
  }
  const double best = *std::ranges::max_element(likelihoods);
  double weights = 0, theta = 0;
  for (std::size_t i = 0; i < grid; ++i) {
    const double weight = std::exp(likelihoods[i] - best);
    weights += weight;
    theta += weight * thetas[i];
  }
  const double k = mean_log(theta / weights), count = static_cast<double>(n);
  return (k * count + 0.5 * 10) / (count + 10);
}

std::string too_few_runs(std::size_t runs, std::size_t fewest) {
  return fmt::format("95% intervals want {} runs; there {} {}", fewest, runs == 1 ? "is" : "are", runs);
}

}  // namespace fb::lab
