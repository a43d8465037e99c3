#include "base/rng.h"

#include <gtest/gtest.h>

#include <array>

#include "base/test_chi_squared.h"

namespace fb {
namespace {

TEST(Rng, RepeatsWithItsSeedAndDiffersByStream) {
  Rng a(42), b(42), c(43), d(42, 2);
  int same_c = 0, same_d = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto x = a.next();
    EXPECT_EQ(x, b.next());
    same_c += x == c.next();
    same_d += x == d.next();
  }
  EXPECT_LE(same_c, 2);
  EXPECT_LE(same_d, 2);
}

TEST(Rng, UniformFillsItsRangeEvenly) {
  Rng rng(7);
  std::array<int, 16> bins{};
  constexpr int kDraws = 160000;
  for (int i = 0; i < kDraws; ++i) {
    const float u = rng.uniform();
    ASSERT_GE(u, 0.0f);
    ASSERT_LT(u, 1.0f);
    ++bins[static_cast<std::size_t>(u * 16)];
  }
  ChiSquared test;
  for (const int n : bins) test.add(kDraws / 16.0, n);
  EXPECT_GT(test.p(), 1e-4);
}

}  // namespace
}  // namespace fb
