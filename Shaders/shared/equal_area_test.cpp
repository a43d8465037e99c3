// shared/equal_area.h: the map has equal areas and an inverse.
#include "shared/equal_area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/rng.h"
#include "base/test_chi_squared.h"

namespace fb::shared {
namespace {

constexpr double kMapFalseAlarm = 1e-6;
constexpr float kMapRoundTrip = 5e-7f;  // in the square

// Not by the map.
vec3 direction_by_angles(Rng& rng) {
  const float z = rng.uniform(-1, 1), phi = rng.uniform(0, 6.2831853f), s = std::sqrt(1 - z * z);
  return {s * std::cos(phi), s * std::sin(phi), z};
}

TEST(EqualArea, TheMapAndItsInverseAgree) {
  Rng rng(1);
  for (int i = 0; i < 200000; ++i) {
    const vec2 p(rng.uniform(-1, 1), rng.uniform(-1, 1));
    const vec3 d = direction_from_equal_area(p);
    ASSERT_NEAR(length(d), 1, 3e-7f);
    EXPECT_EQ(d.z >= 0, std::abs(p.x) + std::abs(p.y) <= 1) << p.x << ' ' << p.y;
    const vec2 back = equal_area_from_direction(d);
    ASSERT_NEAR(back.x, p.x, kMapRoundTrip) << p.x << ' ' << p.y;
    ASSERT_NEAR(back.y, p.y, kMapRoundTrip) << p.x << ' ' << p.y;
    const vec3 other = direction_by_angles(rng);
    ASSERT_LT(length(direction_from_equal_area(equal_area_from_direction(other)) - other), 1.5e-6f);
  }
  // Axes are where they belong, and near the pole no digit is lost.
  const auto expect_at = [](const vec3& d, const vec2& p) {
    EXPECT_LT(length(direction_from_equal_area(p) - d), 1e-6f) << p.x << ' ' << p.y;
    EXPECT_LT(length(equal_area_from_direction(d) - p), 1e-6f) << d.x << ' ' << d.y << ' ' << d.z;
  };
  expect_at({1, 0, 0}, {1, 0});
  expect_at({0, -1, 0}, {0, -1});
  expect_at({0, 0, 1}, {0, 0});
  expect_at({0, 0, -1}, {1, 1});
  const vec2 near = equal_area_from_direction(vec3(1e-5f, 0, 1));
  EXPECT_NEAR(near.x, 1e-5f / std::sqrt(2.0f), 1e-11f);
}

TEST(EqualArea, TheMapHasEqualAreas) {
  Rng rng(2);
  constexpr int kDraws = 1000000;
  constexpr std::size_t kRows = 20, kColumns = 24;
  std::array<int, kRows * kColumns> seen{};
  for (int i = 0; i < kDraws; ++i) {
    const vec3 d = direction_from_equal_area(vec2(rng.uniform(-1, 1), rng.uniform(-1, 1)));
    const double turn = std::atan2(static_cast<double>(d.y), static_cast<double>(d.x)) / (2 * std::numbers::pi) + 0.5;
    const double height = (static_cast<double>(d.z) + 1) / 2;
    const auto bin = [](double x, std::size_t n) {
      return std::min(static_cast<std::size_t>(x * static_cast<double>(n)), n - 1);
    };
    ++seen[bin(height, kRows) * kColumns + bin(turn, kColumns)];
  }
  ChiSquared test;
  for (const int n : seen) test.add(static_cast<double>(kDraws) / seen.size(), n);
  EXPECT_GT(test.p(), kMapFalseAlarm);
}

}  // namespace
}  // namespace fb::shared
