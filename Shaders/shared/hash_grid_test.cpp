// shared/hash_grid.h: vertices are chosen with trilinear weights, levels and coarsening with their distributions, and
// hashes and checks collide as often as random numbers would, on cells as scenes have them.
#include "shared/hash_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "base/rng.h"
#include "base/test_chi_squared.h"

namespace fb::shared {
namespace {

constexpr double kFalseAlarm = 1e-6;

vec3 uniform_vector(Rng& rng) {
  const float x = rng.uniform(), y = rng.uniform();
  return {x, y, rng.uniform()};
}

// How often each of the eight vertices about `p` is chosen; a choice of any other is a failure.
std::array<int, 8> vertex_counts(const vec3& p, float width, int draws, Rng& rng) {
  std::array<GridKey, 8> keys;
  for (unsigned k = 0; k < 8; ++k) {
    const auto at = [&](int axis) {
      return static_cast<int>(std::floor(static_cast<double>(p[axis]) / static_cast<double>(width))) +
             static_cast<int>((k >> static_cast<unsigned>(axis)) & 1u);
    };
    keys[k] = grid_key(at(0), at(1), at(2), 3);
  }
  std::array<int, 8> counts{};
  for (int i = 0; i < draws; ++i) {
    const GridKey key = grid_vertex(p, width, 3, uniform_vector(rng));
    const auto found = std::find_if(keys.begin(), keys.end(),
                                    [&](const GridKey& k) { return k.hash == key.hash && k.check == key.check; });
    if (found == keys.end()) {
      ADD_FAILURE() << "not a vertex about " << p.x << ' ' << p.y << ' ' << p.z << " of width " << width;
      return counts;
    }
    ++counts[static_cast<std::size_t>(found - keys.begin())];
  }
  return counts;
}

// Trilinear, of the exact point.
double vertex_weight(const vec3& p, float width, unsigned k) {
  double product = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double q = static_cast<double>(p[axis]) / static_cast<double>(width), f = q - std::floor(q);
    product *= ((k >> static_cast<unsigned>(axis)) & 1u) != 0 ? f : 1 - f;
  }
  return product;
}

TEST(HashGrid, VerticesAreChosenWithTrilinearWeights) {
  Rng rng(1);
  constexpr int kDraws = 20000;
  for (int i = 0; i < 100; ++i) {
    const float width = i % 2 == 0 ? 64.0f : std::exp2(static_cast<float>(i % 10));
    const vec3 p = (uniform_vector(rng) - vec3(0.5f)) * (width * 8);
    const auto counts = vertex_counts(p, width, kDraws, rng);
    ChiSquared test;
    for (unsigned k = 0; k < 8; ++k) test.add(vertex_weight(p, width, k) * kDraws, counts[k]);
    EXPECT_GT(test.p(), kFalseAlarm) << p.x << ' ' << p.y << ' ' << p.z << " width " << width;
  }
}

// p / width + u is rounded to steps of 2^-9 there, which moves each coordinate's weight by half a step at most; never
// to a vertex that is not about the point.
TEST(HashGrid, FarFromTheOriginWeightsAreRoundedAndNothingElse) {
  Rng rng(2);
  constexpr int kDraws = 50000;
  for (int i = 0; i < 40; ++i) {
    vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      // Also whole coordinates, and the last float below one: where rounding would show most.
      const float whole = std::floor(rng.uniform(29900, 30100));
      const float near[] = {whole, std::nextafter(whole, 0.0f), whole + rng.uniform()};
      p[axis] = near[rng.below(3)] * (rng.below(2) == 0 ? 1.0f : -1.0f);
    }
    const auto counts = vertex_counts(p, 1.0f, kDraws, rng);
    for (unsigned k = 0; k < 8; ++k) {
      const double w = vertex_weight(p, 1.0f, k);
      const double sigma = std::sqrt(kDraws * std::max(w * (1 - w), 3.0 / 1024));
      EXPECT_NEAR(counts[k], w * kDraws, 5.5 * sigma + 3.0 / 1024 * kDraws) << p.x << ' ' << p.y << ' ' << p.z;
    }
  }
}

TEST(HashGrid, TheLevelIsRightInTheMeanAndStaysInItsRange) {
  Rng rng(3);
  for (const float distance : {0.0f, 1e-3f, 1.0f, 100.0f, 3000.0f, 6e4f, 1e10f}) {
    for (const float tangent : {1e-4f, 0.0105f, 1.0f}) {
      const double wanted = std::min(std::log2(std::max(static_cast<double>(distance * tangent), 1.0)), 15.0);
      double sum = 0;
      constexpr int kDraws = 20000;
      for (int i = 0; i < kDraws; ++i) {
        const uint level = grid_level(distance, tangent, rng.uniform());
        EXPECT_LT(level, kGridLevels);
        EXPECT_LE(std::abs(static_cast<double>(level) - wanted), 1.0);
        sum += level;
      }
      // A level is one of two: a deviation of 1/2 at most.
      EXPECT_NEAR(sum / kDraws, wanted, 4.75 * 0.5 / std::sqrt(kDraws) + 1e-5) << distance << ' ' << tangent;
    }
  }
}

TEST(HashGrid, CoarseningIsGeometric) {
  Rng rng(4);
  constexpr int kDraws = 100000;
  for (const float rho : {0.05f, 0.3f, 0.7f, 0.95f}) {
    std::array<int, kGridLevels + 1> counts{};
    for (int i = 0; i < kDraws; ++i) {
      const uint k = grid_coarsening(rho, rng.uniform());
      ASSERT_LE(k, kGridLevels);
      ++counts[k];
    }
    ChiSquared test;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const double p = std::pow(static_cast<double>(rho), static_cast<double>(k));
      test.add(kDraws * (k + 1 < counts.size() ? p * (1 - static_cast<double>(rho)) : p), counts[k]);
    }
    EXPECT_GT(test.p(), kFalseAlarm) << rho;
  }
  for (const float u : {0.0f, 0.5f, 1.0f - 0x1p-24f}) {
    EXPECT_EQ(grid_coarsening(0, u), 0u);
    EXPECT_LE(grid_coarsening(1, u), kGridLevels);
  }
}

TEST(HashGrid, FacesOfTheCube) {
  uint seen = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {1.0f, -1.0f}) {
      vec3 n(0.1f, -0.2f, 0.3f);
      n[axis] = sign;
      const uint face = cube_face(n);
      ASSERT_LT(face, 6u);
      EXPECT_EQ(face, cube_face(n * 1e-3f));
      seen |= 1u << face;
    }
  }
  EXPECT_EQ(seen, 63u) << "every direction of an axis has a face of its own";
}

// --- collisions ---

struct Collisions {
  double same_slot = 0, same_key = 0;  // pairs
};
constexpr uint kSlots = 1u << 14u;

Collisions count_collisions(std::vector<GridKey> keys) {
  const auto slot = [](const GridKey& k) { return k.hash & (kSlots - 1); };
  std::sort(keys.begin(), keys.end(), [&](const GridKey& a, const GridKey& b) {
    return slot(a) != slot(b) ? slot(a) < slot(b) : a.check < b.check;
  });
  const auto pairs = [&](auto same) {
    double sum = 0;
    for (std::size_t i = 0, n = 0; i < keys.size(); ++i) {
      n = i > 0 && same(keys[i - 1], keys[i]) ? n + 1 : 0;
      sum += static_cast<double>(n);
    }
    return sum;
  };
  Collisions c;
  c.same_slot = pairs([&](const GridKey& a, const GridKey& b) { return slot(a) == slot(b); });
  c.same_key = pairs([&](const GridKey& a, const GridKey& b) { return slot(a) == slot(b) && a.check == b.check; });
  return c;
}

TEST(HashGrid, SlotsAndChecksCollideAsRandomNumbersWould) {
  Rng rng(5);
  constexpr int kCells = 1 << 18;
  using Cell = std::function<GridKey(int)>;
  const std::pair<const char*, Cell> sets[] = {
      {"random",
       [&](int) {
         const auto at = [&] { return static_cast<int>(rng.below(60000)) - 30000; };
         const int x = at(), y = at();
         return grid_key(x, y, at(), rng.below(128));
       }},
      {"a block", [](int i) { return grid_key((i & 63) - 32, ((i >> 6) & 63) - 32, (i >> 12) - 32, 24); }},
      {"a floor", [](int i) { return grid_key((i & 511) - 256, (i >> 9) - 256, 7, 28); }},
      {"a wall, far", [](int i) { return grid_key(30000, (i & 511) - 30000, (i >> 9) - 256, kStaticTag); }},
      {"levels of a floor",
       [](int i) {
         return grid_key((i & 127) - 64, ((i >> 7) & 127) - 64, 0,
                         adaptive_tag(static_cast<uint>(i >> 14), vec3(0, 0, 1)));
       }},
  };
  for (const auto& [name, cell] : sets) {
    std::vector<GridKey> keys;
    for (int i = 0; i < kCells; ++i) keys.push_back(cell(i));
    for (const GridKey& key : keys) ASSERT_TRUE(key.check != 0 && key.check < 65536) << "0 is an empty entry";
    const Collisions c = count_collisions(keys);
    // 15 bits of the check are free. Counts of rare pairs are Poisson: 5.5 deviations.
    const double pairs = 0.5 * kCells * (kCells - 1.0), slot = pairs / kSlots, key = slot / 32768;
    EXPECT_NEAR(c.same_slot, slot, 5.5 * std::sqrt(slot)) << name;
    EXPECT_NEAR(c.same_key, key, 5.5 * std::sqrt(key)) << name;
  }
}

}  // namespace
}  // namespace fb::shared
