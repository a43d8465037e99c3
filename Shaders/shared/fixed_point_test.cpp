// shared/fixed_point.h: words whose mean over their random number is the value, and sums with signs that fit.
#include "shared/fixed_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/rng.h"

namespace fb::shared {
namespace {

int signed_word(float value, float steps, float u) {
  return static_cast<int>(fixed_point(value, steps, -1000, 1000, u));
}

// The mean of the word over all u that rng_uniform gives, exactly: the word is a step function of u with one step.
double mean_over_u(float value, float steps, float least = -1000, float most = 1000) {
  const auto word = [&](std::uint32_t k) {
    return static_cast<int>(fixed_point(value, steps, least, most, static_cast<float>(k) * 0x1p-24f));
  };
  constexpr std::uint32_t kLast = (1u << 24u) - 1;
  const int up = word(0), down = word(kLast);
  if (up == down) return up;
  EXPECT_EQ(up, down + 1);
  std::uint32_t low = 0, high = kLast;  // up at low, down at high
  while (high - low > 1) {
    const std::uint32_t middle = (low + high) / 2;
    (word(middle) == up ? low : high) = middle;
  }
  return down + high * 0x1p-24;
}

// To one step of u, that is 2^-24 of a step of the sum, of numbers that the product holds exactly: powers of two as
// steps.
TEST(FixedPoint, TheMeanOverTheRandomNumberIsTheValue) {
  Rng rng(1);
  for (int i = 0; i < 100000; ++i) {
    const float steps = std::exp2(static_cast<float>(rng.below(12)));
    const float value = (i % 2 == 0 ? 1.0f : -1.0f) * std::exp2(rng.uniform(-30, 9.9f));
    const double wanted = static_cast<double>(value) * static_cast<double>(steps);
    ASSERT_NEAR(mean_over_u(value, steps), wanted, 0x1p-24) << value << ' ' << steps;
  }
  for (const float value : {0.0f, -0.0f, 1.0f, -1.0f, 999.0f, -3.0f}) EXPECT_EQ(mean_over_u(value, 256), 256.0 * value);
  // Of a number and the same below zero nothing is left, in the mean.
  EXPECT_NEAR(mean_over_u(0.3f, 7) + mean_over_u(-0.3f, 7), 0, 0x1p-23);
}

TEST(FixedPoint, ValuesAreHeldToTheirBounds) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  for (const float u : {0.0f, 0.5f, 0x1.fffffep-1f}) {
    EXPECT_EQ(signed_word(1e30f, 1024, u), 1024000);
    EXPECT_EQ(signed_word(infinite, 1024, u), 1024000);
    EXPECT_EQ(signed_word(-1e30f, 1024, u), -1024000);
    EXPECT_EQ(signed_word(-infinite, 1024, u), -1024000);
    EXPECT_EQ(signed_word(nan, 1024, u), 0);
    EXPECT_EQ(fixed_point(-3, 1024, 0, 64, u), 0u) << "without signs";
    EXPECT_EQ(fixed_point(100, 1024, 0, 64, u), 65536u);
  }
}

// Partial sums wrap; the last does not. Its error is that of rounding: n independent errors of variance at most 1/4 of
// a step, so 6 sqrt(n) / 2 steps are left with a chance of 2e-9.
TEST(FixedPoint, SumsOfBothSignsAreRightInAnyOrder) {
  Rng rng(2);
  constexpr float kSteps = 4096, kMost = 1000;
  const std::uint32_t room = signed_room(kMost, kSteps);
  EXPECT_EQ(room, 524u);
  std::vector<std::uint32_t> words;
  double wanted = 0;
  // More than fit of one sign, then as many of the other: the sum between is out of range, the last is not.
  for (const float sign : {1.0f, -1.0f}) {
    for (std::uint32_t i = 0; i < 4 * room; ++i) {
      const float value = sign * rng.uniform(900, 1000);
      wanted += static_cast<double>(value);
      words.push_back(fixed_point(value, kSteps, -kMost, kMost, rng.uniform()));
    }
  }
  std::uint32_t sum = 0, backwards = 0;
  for (const std::uint32_t w : words) sum += w;
  std::for_each(words.rbegin(), words.rend(), [&](std::uint32_t w) { backwards += w; });
  EXPECT_EQ(sum, backwards);
  EXPECT_NEAR(signed_sum(sum, kSteps), wanted, 3 * std::sqrt(static_cast<double>(words.size())) / kSteps);
}

TEST(FixedPoint, AsManyFitAsItSays) {
  for (const float most : {1.0f, 0.3f, 1000.0f, 8191.9f}) {
    constexpr float kSteps = 4096;
    const auto worst = static_cast<std::uint64_t>(fixed_point(most, kSteps, -most, most, 0));
    const std::uint64_t room = signed_room(most, kSteps), unsigned_ = unsigned_room(most, kSteps);
    EXPECT_LE(room * worst, 0x7fffffffu) << most;
    EXPECT_GT((room + 1) * worst, 0x7fffffffu) << most << ": and no fewer";
    EXPECT_LE(unsigned_ * worst, 0xffffffffu) << most;
    EXPECT_GT((unsigned_ + 1) * worst, 0xffffffffu) << most;
    std::uint32_t up = 0, down = 0;
    for (std::uint64_t i = 0; i < std::min<std::uint64_t>(room, 100000); ++i) {
      up += fixed_point(most, kSteps, -most, most, 0);
      down += fixed_point(-most, kSteps, -most, most, 0x1.fffffep-1f);
    }
    EXPECT_GT(signed_sum(up, kSteps), 0.0f);
    EXPECT_LT(signed_sum(down, kSteps), 0.0f);
  }
}

TEST(FixedPoint, SumsAreReadBackWithTheirSign) {
  EXPECT_EQ(signed_sum(0u, 256), 0.0f);
  EXPECT_EQ(signed_sum(0xffffff00u, 256), -1.0f);
  EXPECT_EQ(signed_sum(0x80000000u, 256), -8388608.0f);
  EXPECT_EQ(unsigned_sum(0x80000000u, 256), 8388608.0f);
}

}  // namespace
}  // namespace fb::shared
