// render/techniques/path_store.h: what is kept, ratios of densities, and pictures of iterations.
#include "render/techniques/path_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "base/rng.h"
#include "render/techniques/reweighting.h"

namespace fb::render {
namespace {

PathVertex stored_vertex(float light, vec3 position = vec3(0.0f)) {
  return {position, 0.5f, {0, 0, 1}, 1, vec3(light), 0.5f};
}

// Without light that was looked for.
void add(PathStore& store, std::uint32_t pixel, std::uint32_t iteration, const std::vector<PathVertex>& vertices) {
  store.add(pixel, iteration, 0, {vertices, {}});
}

TEST(PathStore, KeepsWhatAHeapWouldKeep) {
  constexpr std::size_t kRoom = 50;
  const std::uint64_t bytes = kRoom * (sizeof(PathStore::Path) + sizeof(PathVertex));
  Rng rng(3);
  PathStore store;
  std::priority_queue<float, std::vector<float>, std::greater<>> heap;
  std::vector<float> gone, popped;
  for (int frame = 0; frame < 10; ++frame) {
    for (std::uint32_t i = 0; i < 30; ++i) {
      const float light = rng.uniform(0.01f, 1);
      add(store, i, static_cast<std::uint32_t>(frame), {stored_vertex(light)});
      heap.push(light);
    }
    store.shrink(bytes, [&](const PathStore::Path& path) { gone.push_back(path.importance); });
    EXPECT_LE(store.bytes(), bytes);
    for (; heap.size() > kRoom; heap.pop()) popped.push_back(heap.top());
  }
  EXPECT_EQ(store.paths().size(), kRoom);
  EXPECT_EQ(gone.size(), 250u);
  std::ranges::sort(gone);
  std::ranges::sort(popped);
  for (std::size_t i = 0; i < gone.size(); ++i) EXPECT_NEAR(gone[i], popped[i], 1e-6f);
  for (const PathStore::Path& path : store.paths())
    EXPECT_NEAR(path.importance, store.stored(path).vertices[0].light.y, 1e-6f) << "grey";
  // No room at all: nothing is kept, and nothing is lost sight of.
  store.shrink(0, [&](const PathStore::Path& path) { gone.push_back(path.importance); });
  EXPECT_TRUE(store.paths().empty());
  EXPECT_EQ(gone.size(), 300u);
  EXPECT_EQ(store.bytes(), 0u);
}

TEST(PathStore, APathEndsWhereItLastMetLight) {
  PathStore store;
  add(store, 4, 1, {stored_vertex(0), stored_vertex(2), stored_vertex(0)});
  add(store, 5, 1, {stored_vertex(0), stored_vertex(0)});
  add(store, 6, 1, {});
  ASSERT_EQ(store.paths().size(), 1u);
  EXPECT_EQ(store.paths()[0].pixel, 4u);
  EXPECT_EQ(store.paths()[0].count, 2u);
}

TEST(PathStore, LightThatWasLookedForEndsAPathToo) {
  PathStore store;
  const std::vector<PathVertex> dark{stored_vertex(0), stored_vertex(0), stored_vertex(0)};
  const auto found = [](std::uint32_t vertex, float light) {
    return LookedFor{vertex, vec3(light), {0, 0, 1}, 0.5f, 0.25f};
  };
  store.add(3, 0, 0, {dark, std::vector{found(0, 1), found(1, 2), found(2, 0)}});
  store.add(4, 0, 0, {dark, std::vector{found(0, 0)}});
  store.add(5, 0, 0, {dark, std::vector{found(0, 9)}});
  ASSERT_EQ(store.paths().size(), 2u);
  const PathStore::Path first = store.paths()[0];
  EXPECT_EQ(first.count, 2u) << "what found nothing is not stored";
  ASSERT_EQ(store.stored(first).looked.size(), 2u);
  EXPECT_NEAR(first.importance, 3, 1e-6f);
  // The dimmer path goes, and the other one's light is still its own.
  store.shrink(store.bytes() - 1, [&](const PathStore::Path& gone) { EXPECT_EQ(gone.pixel, 3u); });
  ASSERT_EQ(store.paths().size(), 1u);
  EXPECT_EQ(store.stored(store.paths()[0]).looked[0].light, vec3(9.0f));
  EXPECT_EQ(store.bytes(), sizeof(PathStore::Path) + sizeof(PathVertex) + sizeof(LookedFor));
  Bytes state;
  store.save(state);
  ByteReader reader(state, "state");
  PathStore read;
  ASSERT_TRUE(read.load(reader, 6, 1, 1));
  EXPECT_EQ(read.stored(read.paths()[0]).looked[0].density, 0.25f);
  state[state.size() - sizeof(LookedFor)] = 1;  // of a vertex that is not there
  ByteReader bad(state, "state");
  EXPECT_FALSE(read.load(bad, 6, 1, 1));
}

// Two vertices at two places, of which only one has been taught, each with light.
TEST(PathStore, RatiosAreProductsOfDensities) {
  GuidingTrees trees;
  Rng rng(5);
  const auto teach = [&](float z) {
    std::vector<GuidingSample> samples;
    for (int i = 0; i < 4000; ++i) {
      const vec3 place{rng.uniform(0, 100), rng.uniform(0, 10), rng.uniform(0, 10)};  // in this order
      samples.push_back({place, glm::normalize(vec3(rng.uniform(-1, 1), 0.2f, z)), place.x > 50 ? 1.0f : 0.0f});
    }
    trees.learn(samples, 1, {500, 0.05f, false}, 1);
  };
  teach(1);
  teach(-1);
  const std::vector<PathVertex> path{stored_vertex(1, {90, 5, 5}), stored_vertex(2, {10, 5, 5})};
  constexpr float kDefence = 0.25f;
  const std::uint32_t leaf = trees.leaf({90, 5, 5});
  const double first[] = {0.5, 0.25 * 0.5 + 0.75 * static_cast<double>(trees.density(leaf, 0, {0, 0, 1})),
                          0.25 * 0.5 + 0.75 * static_cast<double>(trees.density(leaf, 1, {0, 0, 1}))};
  ASSERT_GT(first[1], 1.5 * first[2]);
  EXPECT_LT(trees.density(trees.leaf({10, 5, 5}), 1, {0, 0, 1}), 0) << "untaught";
  for (std::uint32_t own = 0; own < 3; ++own) {
    int seen = 0;
    for_each_ratio(trees, {path, {}}, own, 3, kDefence, [&](const vec3&, std::span<const double> ratios) {
      ++seen;
      ASSERT_EQ(ratios.size(), 3u);
      for (std::uint32_t k = 0; k < 3; ++k) EXPECT_NEAR(std::exp(ratios[k]), first[k] / first[own], 1e-9);
    });
    EXPECT_EQ(seen, 2) << "light of the first vertex has the density of a shorter path";
  }
  std::vector<PathVertex> drawn = path;
  drawn[0].pdf = static_cast<float>(first[2]);
  EXPECT_EQ(other_densities(trees, drawn, 2, kDefence), 0u);
  EXPECT_EQ(other_densities(trees, drawn, 1, kDefence), 1u);
  // A vertex that no distribution has a share in: no iteration is more likely to make it.
  std::vector<PathVertex> glowing{stored_vertex(1, {90, 5, 5})};
  glowing[0].guided = 0;
  const std::vector around_it{LookedFor{0, vec3(1.0f), {0, 0, 1}, 0.5f, 0.2f}};
  for_each_ratio(trees, {glowing, around_it}, 1, 3, kDefence, [](const vec3&, std::span<const double> ratios) {
    for (const double ratio : ratios) EXPECT_EQ(ratio, 0);
  });
  // Light that was looked for, in another direction than the path took, and light that could have been: the density of
  // looking, the same in all, stands beside theirs. The path's third light has that of its first direction alone.
  std::vector<PathVertex> both = path;
  both[0].met_density = 0.3f;
  constexpr std::array kLights{4.0f, 1.0f, 2.0f};
  const std::vector found{LookedFor{0, vec3(4.0f), {0, 0.6f, 0.8f}, 0.4f, 0.7f}};
  const auto looked_first = [&](std::uint32_t k) {
    return k == 0 ? 0.4
                  : 0.25 * static_cast<double>(0.4f) +
                        0.75 * static_cast<double>(trees.density(leaf, k - 1, {0, 0.6f, 0.8f}));
  };
  for (std::uint32_t own = 0; own < 3; ++own) {
    std::vector<std::vector<double>> seen;
    for_each_ratio(trees, {both, found}, own, 3, kDefence, [&](const vec3& light, std::span<const double> ratios) {
      EXPECT_EQ(light.x, kLights[seen.size()]);
      seen.emplace_back(ratios.begin(), ratios.end());
    });
    ASSERT_EQ(seen.size(), 3u);
    for (std::uint32_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(std::exp(seen[0][k]), (looked_first(k) + 0.7) / (looked_first(own) + 0.7), 1e-6);
      EXPECT_NEAR(std::exp(seen[1][k]), (first[k] + 0.3) / (first[own] + 0.3), 1e-6);
      EXPECT_NEAR(std::exp(seen[2][k]), first[k] / first[own], 1e-9);
    }
    // With weights of vertices the second one, which no iteration has another density of, changes nothing either.
    const std::vector<double> counts{1, 2, 3};
    std::size_t light = 0;
    for_each_vertex_factor(trees, {both, found}, own, counts, kDefence, [&](const vec3&, double factor) {
      EXPECT_NEAR(factor, balance_factor(seen[light], counts), 1e-12);
      ++light;
    });
    EXPECT_EQ(light, 3u);
    // Twice the same vertex: the product of two weights, not the weight of both.
    std::size_t met = 0;
    for_each_vertex_factor(
        trees, {std::vector{both[0], both[0]}, {}}, own, counts, kDefence, [&](const vec3&, double factor) {
          const double once = balance_factor(seen[1], counts), direction = balance_factor(seen[2], counts);
          EXPECT_NEAR(factor, met == 0 ? once : 6 * direction * once, 1e-9);
          ++met;
        });
    EXPECT_EQ(met, 2u);
  }
}

TEST(IterationPictures, CombineWholeIterations) {
  IterationPictures pictures;
  pictures.begin({2, 1});
  const auto add = [&](float left, float right) {
    pictures.add(std::vector<vec4>{vec4(vec3(left), 0), vec4(vec3(right), 0)});
  };
  pictures.begin_iteration();
  add(1, 4);
  add(3, 4);
  pictures.begin_iteration();
  add(5, 2);
  add(6, 6);
  add(7, 4);
  add(6, 4);
  const auto left = [&](IterationWeights w) { return pictures.combined(w)[0].x; };
  const auto right = [&](IterationWeights w) { return pictures.combined(w)[1].x; };
  EXPECT_FLOAT_EQ(left(IterationWeights::kAccumulate), 28.0f / 6);
  EXPECT_FLOAT_EQ(left(IterationWeights::kBalance), 28.0f / 6) << "what weights of paths are added to";
  EXPECT_FLOAT_EQ(left(IterationWeights::kLast), 6);
  // Variances of a frame: 2 and 0; 2/3 and 8/3. Of means: 1 and 0; 1/6 and 2/3. Over the picture: 1/2 and 5/12.
  EXPECT_NEAR(pictures.variance(0, 0), 2, 1e-5);
  EXPECT_NEAR(pictures.variance(1, 1), 8.0 / 3, 1e-5);
  EXPECT_NEAR(left(IterationWeights::kInverseVariance), 2 + 4 * (12.0f / 5) / (12.0f / 5 + 2), 1e-4);
  EXPECT_NEAR(left(IterationWeights::kPixelInverseVariance), 2 + 4 * 6.0f / 7, 1e-4);
  EXPECT_NEAR(right(IterationWeights::kPixelInverseVariance), 4, 1e-4);
  // Over the tile: second moments (5 + 16) / 2 and (36.5 + 18) / 2.
  const auto factors = pictures.variance_factors();
  ASSERT_EQ(factors.size(), 2u);
  EXPECT_NEAR(factors[0], 21.0 / 2, 1e-4);
  EXPECT_NEAR(factors[1], 54.5 / (10.0 / 3), 1e-4);
  // An iteration of no frames that are seen has no part in it.
  pictures.begin_iteration();
  EXPECT_FLOAT_EQ(left(IterationWeights::kAccumulate), 28.0f / 6);
  EXPECT_FLOAT_EQ(left(IterationWeights::kLast), 6);
  EXPECT_NEAR(left(IterationWeights::kInverseVariance), 2 + 4 * (12.0f / 5) / (12.0f / 5 + 2), 1e-4);
}

TEST(PathStore, SavedAndLoadedItIsTheSame) {
  PathStore store, read;
  add(store, 4, 1, {stored_vertex(0), stored_vertex(2)});
  add(store, 7, 0, {stored_vertex(3)});
  Bytes state;
  store.save(state);
  const auto load = [&](std::size_t pixels, std::size_t iterations, std::size_t lacks = 0) {
    ByteReader reader(ByteView(state.data(), state.size() - lacks), "state");
    return read.load(reader, pixels, iterations, 1);
  };
  ASSERT_TRUE(load(8, 2));
  ASSERT_EQ(read.paths().size(), 2u);
  EXPECT_EQ(read.bytes(), store.bytes());
  EXPECT_EQ(read.stored(read.paths()[1]).vertices[0].light, vec3(3.0f));
  EXPECT_FALSE(load(8, 2, 1));
  EXPECT_TRUE(read.paths().empty());
  EXPECT_FALSE(load(7, 2)) << "a pixel that is not there";
  EXPECT_FALSE(load(8, 1)) << "an iteration that is not there";
  ByteReader no_frames(state, "state");
  EXPECT_FALSE(read.load(no_frames, 8, 2, 0)) << "a frame that is not there";
  state[8 + 12] = 2;  // the first path's first vertex: it has two of the three
  EXPECT_FALSE(load(8, 2)) << "vertices that are not there";
}

TEST(IterationPictures, SavedAndLoadedTheyAreTheSame) {
  IterationPictures pictures, read;
  pictures.begin({2, 1});
  pictures.begin_iteration();
  for (const float light : {1.0f, 3.0f}) pictures.add(std::vector{vec4(light), vec4(2 * light)});
  pictures.begin_iteration();
  pictures.add(std::vector{vec4(5.0f), vec4(6.0f)});
  Bytes state;
  pictures.save(state);
  ByteReader reader(state, "state");
  ASSERT_TRUE(read.load(reader));
  EXPECT_EQ(read.size(), uvec2(2, 1));
  EXPECT_EQ(read.counts(), pictures.counts());
  EXPECT_EQ(read.combined(IterationWeights::kAccumulate), pictures.combined(IterationWeights::kAccumulate));
  EXPECT_EQ(read.variance(0, 1), pictures.variance(0, 1));
  ByteReader cut(ByteView(state.data(), state.size() - 1), "state");
  EXPECT_FALSE(read.load(cut));
  EXPECT_EQ(read.size(), uvec2(0));
}

}  // namespace
}  // namespace fb::render
