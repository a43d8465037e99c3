// Integrals for tests: Gauss and Legendre's rule with 4 nodes on equal panels.
#pragma once

#include <array>
#include <cstddef>

namespace fb::shared {

template <typename F>
long double integrate(F f, long double low, long double high, int panels = 1) {
  constexpr std::array<long double, 4> kNodes{-0.861136311594052575L, -0.339981043584856265L, 0.339981043584856265L,
                                              0.861136311594052575L};
  constexpr std::array<long double, 4> kWeights{0.347854845137453857L, 0.652145154862546143L, 0.652145154862546143L,
                                                0.347854845137453857L};
  const long double width = (high - low) / panels;
  long double sum = 0;
  for (int i = 0; i < panels; ++i) {
    for (std::size_t node = 0; node < 4; ++node) {
      sum += kWeights[node] / 2 * width * f(low + width * (i + (kNodes[node] + 1) / 2));
    }
  }
  return sum;
}

}  // namespace fb::shared
