// Trees over directions: density and samples agree, leaves cover all directions once and stay as many.
#include "estimators/pstf/pstf_tree.h"
#include "estimators/pstf/pstf_mixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/rng.h"

namespace fb::shared {
namespace {

constexpr uint kPlaceCount = 1u << kTreeDepth;

vec3 any_direction(Rng& rng) {
  const float z = rng.uniform(-1, 1), phi = rng.uniform(0, 6.2831853f), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

// Taught by light that is bright about a direction, as a cell teaches it: the leaves' means, then one step.
DirectionTree taught_tree(const vec3& bright, int frames, float ratio) {
  DirectionTree t = even_tree();
  Rng rng(3);
  for (int frame = 0; frame < frames; ++frame) {
    std::array<float, kTreeLeaves> sums{};
    for (int i = 0; i < 4000; ++i) {
      const vec3 w = any_direction(rng);
      sums[leaf_of_place(t, tree_place(w))] += dot(w, bright) > 0.95f ? 20.0f : 0.1f;
    }
    for (uint i = 0; i < kTreeLeaves; ++i) t.light[i] = sums[i] / 4000;
    split_and_collapse(t, ratio);
    set_probabilities(t);
  }
  return t;
}

void expect_whole(const DirectionTree& t) {
  uint parts = 0, next = 0;
  for (uint i = 0; i < kTreeLeaves; ++i) {
    EXPECT_EQ(leaf_begin(t.leaf[i]), next) << i;
    next += kPlaceCount >> leaf_depth(t.leaf[i]);
    parts += leaf_parts(t.leaf[i]);
  }
  EXPECT_EQ(next, kPlaceCount) << "all places are in a leaf";
  EXPECT_EQ(parts, kTreeParts);
}

TEST(PstfTree, BeginsEven) {
  const DirectionTree t = even_tree();
  expect_whole(t);
  Rng rng(1);
  for (int i = 0; i < 100; ++i)
    EXPECT_NEAR(tree_pdf(t, any_direction(rng)), 1 / (4 * 3.14159265f), 2e-4f) << "within a part of 512";
}

TEST(PstfTree, LeavesStayAsManyWhateverSplits) {
  Rng rng(2);
  DirectionTree t = even_tree();
  int steps = 0;
  for (int i = 0; i < 3000; ++i) {
    for (float& light : t.light) light = std::pow(rng.uniform(), 6.0f);
    steps += split_and_collapse(t, 2) ? 1 : 0;
    set_probabilities(t);
    expect_whole(t);
    if (HasFailure()) break;
  }
  EXPECT_GT(steps, 500);
  // No deeper than places have bits.
  for (int i = 0; i < 100; ++i) {
    for (uint k = 0; k < kTreeLeaves; ++k) t.light[k] = k == 5 ? 1.0f : 0.0f;
    split_and_collapse(t, 2);
    set_probabilities(t);
    expect_whole(t);
  }
}

TEST(PstfTree, TheBrightestLeafSplitsAndNothingElseDoes) {
  DirectionTree t = even_tree();
  for (float& light : t.light) light = 1;
  EXPECT_FALSE(split_and_collapse(t, 2));
  t.light[5] = 4.1f;
  EXPECT_TRUE(split_and_collapse(t, 2));
  set_probabilities(t);
  expect_whole(t);
  EXPECT_EQ(leaf_depth(t.leaf[0]), 3u) << "two halves became one";
  EXPECT_EQ(t.light[0], 2);
  EXPECT_EQ(leaf_depth(t.leaf[4]), 5u);
  EXPECT_EQ(t.light[4], 4.1f / 2);
  EXPECT_FALSE(split_and_collapse(t, 3));
}

// Chi squared of what is drawn against the density, over even parts of the sphere that are no leaves.
TEST(PstfTree, SamplesHaveTheirDensity) {
  const DirectionTree t = taught_tree(normalize(vec3(1, -2, 0.5f)), 12, 2);
  expect_whole(t);
  constexpr int kRings = 12, kSectors = 16, kDraws = 400000, kPoints = 40;
  std::array<double, kRings * kSectors> drawn{}, expected{};
  const auto bin = [](const vec3& w) {
    const int ring = std::min(static_cast<int>((w.z + 1) * 0.5f * kRings), kRings - 1);
    const float turn = (std::atan2(w.y, w.x) + 3.14159265f) / 6.2831853f;
    return ring * kSectors + std::min(static_cast<int>(turn * kSectors), kSectors - 1);
  };
  Rng rng(4);
  for (int i = 0; i < kDraws; ++i) drawn[bin(tree_sample(t, vec2(rng.uniform(), rng.uniform())))] += 1;
  double sum = 0;
  for (int ring = 0; ring < kRings * kPoints; ++ring) {
    for (int sector = 0; sector < kSectors * kPoints; ++sector) {
      const double z = 2 * (ring + 0.5) / (kRings * kPoints) - 1,
                   phi = 2 * 3.14159265358979 * ((sector + 0.5) / (kSectors * kPoints) - 0.5);
      const double r = std::sqrt(1 - z * z);
      const vec3 w(static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(z));
      const double p =
          static_cast<double>(tree_pdf(t, w)) * 4 * 3.14159265358979 / (kRings * kSectors * kPoints * kPoints);
      expected[bin(w)] += p;
      sum += p;
    }
  }
  EXPECT_NEAR(sum, 1, 2e-3);
  double chi = 0;
  int bins = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double e = expected[i] / sum * kDraws;
    if (e < 5) continue;
    chi += (drawn[i] - e) * (drawn[i] - e) / e;
    ++bins;
  }
  // Within six deviations and what the points' grid leaves out at the edges of leaves.
  EXPECT_LT(chi, bins + 6 * std::sqrt(2.0 * bins) + 60) << bins;
}

TEST(PstfTree, LightIsFound) {
  const vec3 bright = normalize(vec3(1, -2, 0.5f));
  const DirectionTree t = taught_tree(bright, 24, 2);
  EXPECT_GT(tree_pdf(t, bright), 10 * tree_pdf(even_tree(), bright));
  Rng rng(6);
  int near = 0;
  for (int i = 0; i < 1000; ++i) near += dot(tree_sample(t, vec2(rng.uniform(), rng.uniform())), bright) > 0.8f ? 1 : 0;
  EXPECT_GT(near, 600) << "a fifth of the sphere's area is a tenth";
}

TEST(PstfTree, DrawnDirectionsAreInTheirLeaf) {
  const DirectionTree t = taught_tree(vec3(0, 0, 1), 24, 2);
  Rng rng(7);
  int off = 0;
  for (int i = 0; i < 20000; ++i) {
    const vec3 w = tree_sample(t, vec2(rng.uniform(), rng.uniform()));
    EXPECT_NEAR(length(w), 1, 1e-5);
    off += tree_pdf(t, w) > 0 ? 0 : 1;
  }
  EXPECT_LT(off, 5) << "only at the very edge of a leaf of no light";
  for (const vec2& u : {vec2(0, 0), vec2(0.99999994f, 0.99999994f)}) EXPECT_TRUE(std::isfinite(tree_sample(t, u).x));
}

// Two densities over a few places, of which one is in proportion to the light: with half of the samples of each, and
// the factor that is learnt, no variance is left, whichever of them it is. A factor of one sign mends one case alone.
TEST(PstfMixture, TheBetterDensityTakesAllVariance) {
  constexpr std::array<double, 4> kLight{0.1, 0.4, 0.3, 0.2}, kOther{0.4, 0.1, 0.1, 0.4};
  for (const bool first : {false, true}) {
    const auto& p1 = first ? kLight : kOther;
    const auto& p0 = first ? kOther : kLight;
    ControlMoments m{0, 0, 0, 1e9f};
    for (std::size_t i = 0; i < kLight.size(); ++i) {
      const double p = (p0[i] + p1[i]) / 2, g = kLight[i] / p - 1, h = (p1[i] - p0[i]) / p;
      m.gh += static_cast<float>(p * g * h);
      m.hh += static_cast<float>(p * h * h);
      m.gg += static_cast<float>(p * g * g);
    }
    const double beta = static_cast<double>(learnt_mixture_beta(m));
    EXPECT_NEAR(beta, first ? 0.5 : -0.5, 1e-3);
    double mean = 0, square = 0;
    for (std::size_t i = 0; i < kLight.size(); ++i) {
      const double p = (p0[i] + p1[i]) / 2, estimate = (kLight[i] - beta * (p1[i] - p0[i])) / p;
      mean += p * estimate;
      square += p * estimate * estimate;
    }
    EXPECT_NEAR(mean, 1, 1e-12) << "no integral is to be added";
    EXPECT_NEAR(square, 1, 1e-5);
  }
  EXPECT_EQ(learnt_mixture_beta({-1, 1, 1, 15}), 0);
  EXPECT_EQ(learnt_mixture_beta({-9, 1, 100, 1e6f}), -kMostMixtureBeta);
}

}  // namespace
}  // namespace fb::shared
