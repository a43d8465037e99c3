// render/techniques/guiding_trees.h: draws have the density that is asked for, also after subdivisions, and what an
// iteration knew is known as it was when trees have been split.
#include "render/techniques/guiding_trees.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "base/rng.h"
#include "base/test_chi_squared.h"

namespace fb::render {
namespace {

constexpr double kTreesFalseAlarm = 1e-6, kSphere = 4 * 3.14159265358979323846;

vec3 any_direction(Rng& rng) { return shared::direction_from_equal_area(vec2{rng.uniform(-1, 1), rng.uniform(-1, 1)}); }

// Light from a narrow cone that moves with x, and a little from everywhere; one vertex in five finds none.
std::vector<GuidingSample> samples_of(int count, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<GuidingSample> samples;
  for (int i = 0; i < count; ++i) {
    GuidingSample s;
    s.position = {rng.uniform(-100, 300), rng.uniform(0, 50), rng.uniform(10, 90)};
    const bool narrow = i % 3 == 0;
    const vec3 towards = glm::normalize(vec3(s.position.x / 100, 1, 0.4f));
    s.direction = narrow ? glm::normalize(towards + 0.05f * any_direction(rng)) : any_direction(rng);
    s.weight = i % 5 == 0 ? 0.0f : narrow ? 10.0f : 0.2f;
    samples.push_back(s);
  }
  return samples;
}

// Of draws from the distribution of a place, in cells of equal solid angle.
double p_of_draws(const GuidingTrees& trees, const vec3& place, std::uint64_t seed) {
  constexpr std::uint32_t kSide = 32;
  constexpr int kDraws = 300000, kPerCell = 16;
  const std::uint32_t leaf = trees.leaf(place), first = trees.firsts()[leaf];
  Rng rng(seed);
  std::vector<int> seen(kSide * kSide);
  for (int i = 0; i < kDraws; ++i) {
    const float u = rng.uniform();
    const vec2 p = shared::guiding_place(
        shared::guiding_draw(trees.nodes().data(), first, trees.node_levels(), {u, rng.uniform()}));
    ++seen[static_cast<std::uint32_t>(p.y * kSide) * kSide + static_cast<std::uint32_t>(p.x * kSide)];
  }
  ChiSquared test;
  for (std::uint32_t cell = 0; cell < kSide * kSide; ++cell) {
    double density = 0;
    for (int k = 0; k < kPerCell * kPerCell; ++k) {
      const vec2 inside((static_cast<float>(k % kPerCell) + 0.5f) / kPerCell,
                        (static_cast<float>(k / kPerCell) + 0.5f) / kPerCell);
      const vec2 p = (vec2(static_cast<float>(cell % kSide), static_cast<float>(cell / kSide)) + inside) / float(kSide);
      density += static_cast<double>(shared::guiding_pdf(trees.nodes().data(), first, trees.node_levels(),
                                                         shared::direction_from_equal_area(2.0f * p - vec2(1.0f))));
    }
    test.add(density / (kPerCell * kPerCell) * kSphere / (kSide * kSide) * kDraws, seen[cell]);
  }
  return test.p();
}

TEST(GuidingTreesSequences, DrawsHaveTheirDensityAlsoAfterSubdivisions) {
  for (const bool filtered : {true, false}) {
    GuidingTrees trees;
    std::size_t leaves = 0, nodes = 0;
    for (std::uint32_t i = 0; i < 4; ++i) {
      trees.learn(samples_of(8000, i), 1, {1000, 0.01f, filtered}, i);
      for (const vec3 place : {vec3(-60, 10, 20), vec3(250, 40, 80), vec3(1e4f, -1e4f, 0)}) {
        ASSERT_NE(trees.firsts()[trees.leaf(place)], shared::kUntaught);
        EXPECT_GT(p_of_draws(trees, place, i + 7), kTreesFalseAlarm) << filtered << ' ' << i;
      }
      EXPECT_GE(trees.firsts().size(), leaves);
      leaves = trees.firsts().size();
      if (i == 0) nodes = trees.nodes().size() / leaves;
    }
    EXPECT_GE(leaves, 8u);
    EXPECT_GT(trees.nodes().size() / leaves, 4 * nodes) << "quarters were split where the light is";
  }
}

TEST(GuidingTrees, DensitiesIntegrateToOne) {
  GuidingTrees trees;
  for (std::uint32_t i = 0; i < 4; ++i) trees.learn(samples_of(8000, i), 1, {}, i);
  // Cells of 2^-11 are finer than what three refinements make (6 + 2 levels).
  constexpr int kSide = 2048;
  double sum = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const vec2 p((static_cast<float>(x) + 0.5f) / kSide, (static_cast<float>(y) + 0.5f) / kSide);
      sum += static_cast<double>(trees.density(0, 3, shared::direction_from_equal_area(2.0f * p - vec2(1.0f))));
    }
  }
  EXPECT_NEAR(sum * kSphere / (kSide * kSide), 1, 1e-4);
}

TEST(GuidingTrees, LearnsWhereLightComesFrom) {
  GuidingTrees trees;
  for (std::uint32_t i = 0; i < 4; ++i) trees.learn(samples_of(20000, i), 1, {1000, 0.01f, true}, i);
  for (const float x : {-90.0f, 0.0f, 150.0f, 280.0f}) {
    const vec3 place(x, 25, 50), towards = glm::normalize(vec3(x / 100, 1, 0.4f));
    const float there = trees.density(trees.leaf(place), 3, towards);
    EXPECT_GT(there, 4.0f) << x << ": fifty times as much as evenly";
    EXPECT_LT(trees.density(trees.leaf(place), 3, -towards), 0.2f);
  }
}

// What iterations before knew, at any place, is the same function when leaves have been split since.
TEST(GuidingTrees, KeepsWhatEachIterationKnew) {
  GuidingTrees trees;
  std::vector<std::vector<float>> then;
  const auto ask = [&](std::uint32_t iteration) {
    Rng rng(99);
    std::vector<float> densities;
    for (int i = 0; i < 500; ++i) {
      const vec3 place{rng.uniform(-120, 320), rng.uniform(-5, 55), rng.uniform(0, 100)};
      densities.push_back(trees.density(trees.leaf(place), iteration, any_direction(rng)));
    }
    return densities;
  };
  std::size_t leaves = 0;
  for (std::uint32_t i = 0; i < 4; ++i) {
    trees.learn(samples_of(4000 << i, i), 1, {600, 0.01f, true}, i);
    then.push_back(ask(i));
    EXPECT_GT(trees.firsts().size(), leaves) << "leaves were split";
    leaves = trees.firsts().size();
    for (std::uint32_t k = 0; k <= i; ++k) ASSERT_EQ(ask(k), then[k]) << i << ' ' << k;
  }
  EXPECT_NE(then[1], then[3]);
  EXPECT_LT(trees.bytes(), 4u << 20u);
}

TEST(GuidingTrees, WhatTeachesNothingIsUntaught) {
  GuidingTrees trees;
  trees.learn({}, 1, {}, 0);
  EXPECT_EQ(trees.firsts()[trees.leaf({1, 2, 3})], shared::kUntaught);
  EXPECT_LT(trees.density(0, 0, {0, 0, 1}), 0);
  // All samples at one place: leaves end at a least width. Weights of any size stay finite.
  std::vector<GuidingSample> same(5000, {{5, 5, 5}, {0, 0, 1}, 1e38f});
  trees.learn(same, 1, {100, 0.01f, true}, 0);
  const float known = trees.density(trees.leaf({5, 5, 5}), 1, {0, 0, 1});
  EXPECT_TRUE(std::isfinite(known));
  EXPECT_GT(known, 1.0f / 12.6f);
  same.assign(10, {{5, 5, 5}, {0, 0, 1}, std::numeric_limits<float>::quiet_NaN()});
  trees.learn(same, 1, {}, 0);
  EXPECT_LT(trees.density(trees.leaf({5, 5, 5}), 2, {0, 0, 1}), 0);
}

TEST(GuidingTrees, SavedAndLoadedTheyLearnOnAsIfNothingHadBeen) {
  GuidingTrees trees, others;
  for (std::uint32_t i = 0; i < 3; ++i) trees.learn(samples_of(4000, i), 1, {500, 0.01f, true}, i);
  Bytes state;
  trees.save(state);
  ByteReader reader(state, "state");
  ASSERT_TRUE(others.load(reader));
  EXPECT_EQ(reader.remaining(), 0u);
  EXPECT_EQ(others.iterations(), 3u);
  EXPECT_EQ(others.firsts(), trees.firsts());
  EXPECT_EQ(others.nodes(), trees.nodes());
  Bytes first, second;
  for (GuidingTrees* each : {&trees, &others}) each->learn(samples_of(4000, 9), 1, {500, 0.01f, true}, 9);
  trees.save(first);
  others.save(second);
  EXPECT_EQ(first, second);
}

TEST(GuidingTrees, LoadsNothingThatLeadsNowhere) {
  GuidingTrees trees;
  for (std::uint32_t i = 0; i < 2; ++i) trees.learn(samples_of(1500, i), 1, {300, 0.05f, true}, i);
  Bytes state;
  trees.save(state);
  for (std::size_t size = 0; size < state.size(); size += 97) {
    GuidingTrees read;
    ByteReader reader(ByteView(state.data(), size), "state");
    EXPECT_FALSE(read.load(reader)) << size;
    EXPECT_EQ(read.iterations(), 0u);
    EXPECT_EQ(read.leaf({}), 0u);
  }
  // A word that is another: it is refused, or walks end where there is something.
  Rng rng(5);
  std::uint32_t refused = 0;
  for (int round = 0; round < 3000; ++round) {
    Bytes changed = state;
    const auto at = static_cast<std::size_t>(rng.uniform() * static_cast<float>(state.size() / 4 - 1)) * 4;
    const auto word = static_cast<std::uint32_t>(rng.uniform(0, 4e9f)) >> (round % 24);
    std::memcpy(&changed[at], &word, sizeof(word));
    GuidingTrees read;
    ByteReader reader(changed, "state");
    if (!read.load(reader)) {
      ++refused;
      continue;
    }
    for (const vec3 place : {vec3(-60, 10, 20), vec3(250, 40, 80)}) {
      const std::uint32_t leaf = read.leaf(place);
      ASSERT_LT(leaf, read.firsts().size());
      for (std::uint32_t k = 0; k < read.iterations(); ++k) read.density(leaf, k, {0.6f, 0, 0.8f});
    }
  }
  EXPECT_GT(refused, 300u);
  // The root's halves beyond the tree; it stands behind three numbers, the cube and a count.
  Bytes lost = state;
  const std::uint32_t beyond = 1u << 30u;
  std::memcpy(&lost[3 * 4 + sizeof(shared::GuidingCube) + 8], &beyond, sizeof(beyond));
  GuidingTrees read;
  ByteReader reader(lost, "state");
  EXPECT_FALSE(read.load(reader));
}

}  // namespace
}  // namespace fb::render
