#include "render/techniques/reweighting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace fb::render {
namespace {

// 1 / sum_k weight_k exp(log_ratio_k). The largest term is taken out, so that none of them overflows.
template <typename Weight>
double inverse_of_sum(std::span<const double> log_ratios, const Weight& weight) {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < log_ratios.size(); ++k)
    if (weight(k) > 0 && log_ratios[k] > most) most = log_ratios[k];
  if (!(most < std::numeric_limits<double>::infinity())) return 0;  // infinitely more likely elsewhere
  double sum = 0;
  for (std::size_t k = 0; k < log_ratios.size(); ++k)
    if (weight(k) > 0 && log_ratios[k] >= -std::numeric_limits<double>::max())
      sum += weight(k) * std::exp(log_ratios[k] - most);
  return sum > 0 ? std::exp(-most) / sum : 0;
}

}  // namespace

double balance_factor(std::span<const double> log_ratios, std::span<const double> counts) {
  return inverse_of_sum(log_ratios, [&](std::size_t k) { return counts[k]; });
}

double end_log_ratio(double proposed, double own_proposed, double looked_for) {
  return std::log(proposed + looked_for) - std::log(own_proposed + looked_for);
}

double variance_aware_factor(std::span<const double> log_ratios, std::span<const double> counts,
                             std::span<const double> variances, std::size_t own) {
  return variances[own] * inverse_of_sum(log_ratios, [&](std::size_t k) { return counts[k] * variances[k]; });
}

double variance_factor(double second_moment, double variance) {
  if (!(second_moment > 0) || !(variance >= 0)) return 1;
  return std::clamp(second_moment / std::max(variance, second_moment / kMostVarianceFactor), 1.0, kMostVarianceFactor);
}

double partial_factor(std::span<const double> log_ratios, std::span<const double> counts) {
  return balance_factor(log_ratios, counts) * std::accumulate(counts.begin(), counts.end(), 0.0);
}

std::vector<double> inverse_variance_shares(std::span<const double> variances, std::span<const double> counts) {
  std::vector<double> shares(variances.size());
  const bool exact = std::ranges::any_of(variances, [](double v) { return v == 0; });
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (exact)
      shares[k] = variances[k] == 0 ? 1 : 0;
    else
      shares[k] = variances[k] > 0 ? 1 / variances[k] : 0;
  }
  double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  if (!(sum > 0)) {
    shares.assign(counts.begin(), counts.end());
    sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  }
  for (double& share : shares) share = sum > 0 ? share / sum : 0;
  return shares;
}

}  // namespace fb::render
