#include "lab/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/check.h"
#include "base/rng.h"

namespace fb::lab {

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

Interval t_interval(std::span<const double> values, double confidence) {
  const double center = mean(values);
  if (values.size() < 2) return {center, center};
  const double half = student_t_quantile(confidence, static_cast<int>(values.size()) - 1) * standard_error(values);
  return {center - half, center + half};
}

Interval bootstrap_interval(const Series& series, const Statistic& statistic, double confidence, int resamples,
                            std::uint64_t seed) {
  if (series.size() == 0) return {};
  const auto block = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(series.length))));
  const auto starts = static_cast<std::uint32_t>(series.length - block + 1);
  Rng rng(seed);
  std::vector<std::size_t> indices(series.size());
  std::vector<double> values;
  for (int i = 0; i < resamples; ++i) {
    for (std::size_t filled = 0; filled < indices.size();) {
      const std::size_t run = rng.below(static_cast<std::uint32_t>(series.runs)), start = rng.below(starts);
      for (std::size_t k = 0; k < block && filled < indices.size(); ++k)
        indices[filled++] = run * series.length + start + k;
    }
    values.push_back(statistic(indices));
    if (std::isnan(values.back())) return {values.back(), values.back()};
  }
  const double tail = 0.5 * (1 - confidence);
  return {quantile(values, tail), quantile(values, 1 - tail)};
}

}  // namespace fb::lab
