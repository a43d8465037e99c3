#include "base/probability.h"

#include <cmath>
#include <numbers>

namespace fb {

double normal_probability(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double two_sided_p(double z) { return std::erfc(std::abs(z) / std::numbers::sqrt2); }

double normal_quantile_two_sided(double p) {
  double low = 0, high = 40;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (two_sided_p(middle) > p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double chi_squared_p(double chi_squared, double degrees) {
  const double k = 2.0 / (9.0 * degrees);
  return 1.0 - normal_probability((std::cbrt(chi_squared / degrees) - (1 - k)) / std::sqrt(k));
}

}  // namespace fb
