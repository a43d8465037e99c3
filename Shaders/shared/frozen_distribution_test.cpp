// shared/frozen_distribution.h: its map has equal areas and an inverse, and draws have the density that it states.
#include "shared/frozen_distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "base/rng.h"
#include "base/test_chi_squared.h"

namespace fb::shared {
namespace {

constexpr double kFrozenFalseAlarm = 1e-6, kFullPi = std::numbers::pi;
constexpr float kRoundTrip = 5e-7f;  // in the square

vec3 uniform_direction(Rng& rng) {
  const float z = rng.uniform(-1, 1), phi = rng.uniform(0, 6.2831853f), s = std::sqrt(1 - z * z);
  return {s * std::cos(phi), s * std::sin(phi), z};
}

struct Built {
  FrozenMap map;
  std::vector<std::uint32_t> words;
  double wanted_sum;
};

Built built(std::uint32_t side, float least, const std::function<float(std::uint32_t)>& weight) {
  Built b{{3, side}, std::vector<std::uint32_t>(3 + side * side / 2), 0};
  std::vector<float> weights;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    weights.push_back(weight(i));
    if (weights.back() > 0) b.wanted_sum += static_cast<double>(weights.back());
  }
  build_frozen(weights.data(), b.words.data(), b.map, least);
  return b;
}
std::uint32_t parts_of(const Built& b, std::uint32_t cell) {
  return frozen_before(b.words.data(), b.map, cell + 1) - frozen_before(b.words.data(), b.map, cell);
}
float pdf(const Built& b, const vec3& direction) { return frozen_pdf(b.words.data(), b.map, direction); }

// Weights as a guide may have them: most of the light from a few directions, a hundred to one.
// One in eleven is below zero, which counts as nothing.
float uneven(std::uint32_t cell) {
  return cell % 13 == 4 ? 30.0f : cell % 11 == 3 ? -2.0f : 0.3f + static_cast<float>(cell % 7);
}

TEST(FrozenDistribution, TheMapAndItsInverseAgree) {
  Rng rng(1);
  for (int i = 0; i < 200000; ++i) {
    const vec2 p(rng.uniform(-1, 1), rng.uniform(-1, 1));
    const vec3 d = direction_from_equal_area(p);
    ASSERT_NEAR(length(d), 1, 3e-7f);
    EXPECT_EQ(d.z >= 0, std::abs(p.x) + std::abs(p.y) <= 1) << p.x << ' ' << p.y;
    const vec2 back = equal_area_from_direction(d);
    ASSERT_NEAR(back.x, p.x, kRoundTrip) << p.x << ' ' << p.y;
    ASSERT_NEAR(back.y, p.y, kRoundTrip) << p.x << ' ' << p.y;
    const vec3 other = uniform_direction(rng);
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

TEST(FrozenDistribution, TheMapHasEqualAreas) {
  Rng rng(2);
  constexpr int kDraws = 1000000;
  constexpr std::size_t kRows = 20, kColumns = 24;
  std::array<int, kRows * kColumns> seen{};
  for (int i = 0; i < kDraws; ++i) {
    const vec3 d = direction_from_equal_area(vec2(rng.uniform(-1, 1), rng.uniform(-1, 1)));
    const double turn = std::atan2(static_cast<double>(d.y), static_cast<double>(d.x)) / (2 * kFullPi) + 0.5;
    const double height = (static_cast<double>(d.z) + 1) / 2;
    const auto bin = [](double x, std::size_t n) {
      return std::min(static_cast<std::size_t>(x * static_cast<double>(n)), n - 1);
    };
    ++seen[bin(height, kRows) * kColumns + bin(turn, kColumns)];
  }
  ChiSquared test;
  for (const int n : seen) test.add(static_cast<double>(kDraws) / seen.size(), n);
  EXPECT_GT(test.p(), kFrozenFalseAlarm);
}

TEST(FrozenDistribution, ADirectionsCellGivesItBack) {
  Rng rng(3);
  for (const std::uint32_t side : {2u, 4u, 6u, 8u, 16u, 64u}) {
    const FrozenMap map{0, side};
    const float margin = kRoundTrip * static_cast<float>(side);  // in the cell
    for (std::uint32_t cell = 0; cell < side * side; ++cell) {
      for (int i = 0; i < 16; ++i) {
        const vec2 place(rng.uniform(margin, 1 - margin), rng.uniform(margin, 1 - margin));
        ASSERT_EQ(frozen_cell(map, frozen_direction(map, cell, place)), cell) << side;
      }
    }
    for (int i = 0; i < 1000; ++i) ASSERT_LT(frozen_cell(map, uniform_direction(rng)), side * side);
    for (const float x : {-1.0f, 0.0f, -0.0f, 1.0f})
      for (const float y : {-1.0f, 0.0f, 1.0f})
        for (const float z : {-1.0f, 0.0f, 1.0f}) ASSERT_LT(frozen_cell(map, vec3(x, y, z)), side * side);
  }
}

// Drawn directions by the cell and the quarter of it that they fall into.
TEST(FrozenDistribution, DrawsHaveTheirDensity) {
  Rng rng(4);
  constexpr int kDraws = 1000000;
  for (const std::uint32_t side : {4u, 8u, 16u}) {
    const Built b = built(side, 0.1f, uneven);
    const std::uint32_t fine = 2 * side;
    const FrozenMap quarters{0, fine};
    std::vector<int> seen(fine * fine);
    int strayed = 0;
    for (int i = 0; i < kDraws; ++i) {
      const float u = rng.uniform();
      const FrozenSample s = frozen_draw(b.words.data(), b.map, vec2(u, rng.uniform()));
      ASSERT_NEAR(length(s.direction), 1, 3e-7f);
      ++seen[frozen_cell(quarters, s.direction)];
      if (frozen_cell(b.map, s.direction) != s.cell) {
        ++strayed;
      } else {
        ASSERT_EQ(s.pdf, pdf(b, s.direction));
      }
    }
    ChiSquared test;
    for (std::uint32_t q = 0; q < fine * fine; ++q) {
      const vec3 middle = frozen_direction(quarters, q, vec2(0.5f, 0.5f));
      const double expected = static_cast<double>(pdf(b, middle)) * 4 * kFullPi / (fine * fine);
      test.add(expected * kDraws, seen[q]);
    }
    EXPECT_GT(test.p(), kFrozenFalseAlarm) << side;
    // Over an edge, where they lie within the round trip's error of one: four edges a cell, 2 / side wide. A Poisson
    // count exceeds its mean by six roots of it with a chance below 1e-6 where the mean is above 10.
    const double most = std::max(10.0, kDraws * 4 * static_cast<double>(kRoundTrip) * side / 2);
    EXPECT_LT(strayed, most + 6 * std::sqrt(most)) << side;
  }
}

// By the midpoint rule over strata of equal solid angle in z and azimuth. A stratum whose corners lie in one cell is
// exact; another is wrong by at most what its corners differ in, and half of that by far the most.
TEST(FrozenDistribution, TheDensityIntegratesToOne) {
  constexpr int kRows = 600, kColumns = 1200;
  const Built b = built(8, 0.05f, uneven);
  const auto at = [&](double row, double column) {
    const double z = 1 - 2 * row / kRows, phi = 2 * kFullPi * column / kColumns,
                 r = std::sqrt(std::max(0.0, 1 - z * z));
    const vec3 d(r * std::cos(phi), r * std::sin(phi), z);
    return static_cast<double>(pdf(b, d));
  };
  const double area = 4 * kFullPi / (kRows * kColumns);
  double sum = 0, squares = 0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double corners[] = {at(row, column), at(row + 1, column), at(row, column + 1), at(row + 1, column + 1)};
      const auto [low, high] = std::minmax_element(std::begin(corners), std::end(corners));
      sum += area * at(row + 0.5, column + 0.5);
      squares += area * area * (*high - *low) * (*high - *low);
    }
  }
  EXPECT_NEAR(sum, 1, 6 * std::sqrt(squares) + 1e-5) << "as if each stratum on an edge erred by itself";
  EXPECT_LT(6 * std::sqrt(squares), 0.01);
}

TEST(FrozenDistribution, PartsAreTheWeightsToOneOf65536) {
  for (const std::uint32_t side : {2u, 6u, 8u, 64u}) {
    for (const float least : {0.0f, 0.1f, 1.0f}) {
      const Built b = built(side, least, uneven);
      const std::uint32_t cells = side * side;
      const double even = 65536 / cells,
                   floor = std::clamp(std::floor(static_cast<double>(least) * even + 0.5), 1.0, even);
      std::uint32_t sum = 0;
      for (std::uint32_t cell = 0; cell < cells; ++cell) {
        const double share = std::max(static_cast<double>(uneven(cell)), 0.0) / b.wanted_sum;
        EXPECT_NEAR(parts_of(b, cell), floor + share * (65536 - cells * floor), 1.1) << side << ' ' << cell;
        EXPECT_GE(parts_of(b, cell), floor);
        sum += parts_of(b, cell);
      }
      EXPECT_EQ(sum, kFrozenParts);
    }
  }
}

TEST(FrozenDistribution, WithoutWeightsItIsUniform) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  Rng rng(5);
  for (const float weight : {0.0f, -1.0f, nan, infinite, -infinite}) {
    const Built b = built(8, 0.25f, [&](std::uint32_t) { return weight; });
    for (std::uint32_t cell = 0; cell < 64; ++cell) EXPECT_EQ(parts_of(b, cell), 1024u);
    for (int i = 0; i < 1000; ++i) EXPECT_FLOAT_EQ(pdf(b, uniform_direction(rng)), 0.25f / kSpherePi);
  }
}

// One cell has it all, or one is no number: the rest keeps its share, and no direction has none.
TEST(FrozenDistribution, NoDirectionIsLeftOut) {
  Rng rng(6);
  for (const std::uint32_t side : {2u, 8u, 64u}) {
    for (const float least : {-1.0f, 0.0f, 0.25f, 1.0f, 2.0f}) {
      const Built b = built(side, least, [&](std::uint32_t cell) {
        return cell == 1 ? 1e30f : cell == 2 ? NAN : 0.0f;
      });
      const float even = 65536.0f / static_cast<float>(side * side);
      const float lowest = std::max(std::clamp(least, 0.0f, 1.0f), 1 / even) * 0.25f / kSpherePi;
      for (int i = 0; i < 10000; ++i) ASSERT_GE(pdf(b, uniform_direction(rng)), lowest * 0.999999f) << side << least;
      for (const float u : {0.0f, 0.25f, 0x1.fffffep-1f}) {
        const FrozenSample s = frozen_draw(b.words.data(), b.map, vec2(u, 0x1.fffffep-1f));
        EXPECT_LT(s.cell, side * side);
        EXPECT_GT(s.pdf, 0.0f);
        EXPECT_NEAR(length(s.direction), 1, 1e-6f);
      }
    }
  }
}

}  // namespace
}  // namespace fb::shared
