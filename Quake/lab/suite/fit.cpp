#include "lab/suite/fit.h"

#include <cmath>
#include <vector>

#include "base/check.h"

namespace fb::lab {

std::optional<Estimate> fit_power(std::span<const double> x, std::span<const double> y) {
  FB_CHECK_EQ(x.size(), y.size());
  const std::size_t n = x.size();
  if (n < 3) return std::nullopt;
  std::vector<double> u, v;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(x[i] > 0.0) || !(y[i] > 0.0)) return std::nullopt;
    u.push_back(std::log(x[i]));
    v.push_back(std::log(y[i]));
  }
  const double mean_u = mean(u), mean_v = mean(v);
  double uu = 0, uv = 0;
  for (std::size_t i = 0; i < n; ++i) {
    uu += (u[i] - mean_u) * (u[i] - mean_u);
    uv += (u[i] - mean_u) * (v[i] - mean_v);
  }
  if (!(uu > 0.0)) return std::nullopt;
  const double slope = uv / uu;
  double left = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double residual = v[i] - mean_v - slope * (u[i] - mean_u);
    left += residual * residual;
  }
  const int freedom = static_cast<int>(n) - 2;
  const double reach = student_t_quantile(0.95, freedom) * std::sqrt(left / freedom / uu);
  return Estimate{slope, {slope - reach, slope + reach}};
}

}  // namespace fb::lab
