// render/techniques/path_store.h: what is kept, ratios of densities, and pictures of iterations.
#include "render/techniques/path_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "base/rng.h"

namespace fb::render {
namespace {

PathVertex stored_vertex(float light, vec3 position = vec3(0.0f)) {
  return {position, 0.5f, {0, 0, 1}, 1, vec3(light), 0.5f};
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
      store.add(i, static_cast<std::uint32_t>(frame), std::vector{stored_vertex(light)});
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
    EXPECT_NEAR(path.importance, store.vertices(path)[0].light.y, 1e-6f) << "grey";
  // No room at all: nothing is kept, and nothing is lost sight of.
  store.shrink(0, [&](const PathStore::Path& path) { gone.push_back(path.importance); });
  EXPECT_TRUE(store.paths().empty());
  EXPECT_EQ(gone.size(), 300u);
  EXPECT_EQ(store.bytes(), 0u);
}

TEST(PathStore, APathEndsWhereItLastMetLight) {
  PathStore store;
  store.add(4, 1, std::vector{stored_vertex(0), stored_vertex(2), stored_vertex(0)});
  store.add(5, 1, std::vector{stored_vertex(0), stored_vertex(0)});
  store.add(6, 1, {});
  ASSERT_EQ(store.paths().size(), 1u);
  EXPECT_EQ(store.paths()[0].pixel, 4u);
  EXPECT_EQ(store.paths()[0].count, 2u);
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
    for_each_ratio(trees, path, own, 3, kDefence, [&](const PathVertex&, std::span<const double> ratios) {
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
  for_each_ratio(trees, glowing, 1, 3, kDefence, [](const PathVertex&, std::span<const double> ratios) {
    for (const double ratio : ratios) EXPECT_EQ(ratio, 0);
  });
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
  store.add(4, 1, std::vector{stored_vertex(0), stored_vertex(2)});
  store.add(7, 0, std::vector{stored_vertex(3)});
  Bytes state;
  store.save(state);
  const auto load = [&](std::size_t pixels, std::size_t iterations, std::size_t lacks = 0) {
    ByteReader reader(ByteView(state.data(), state.size() - lacks), "state");
    return read.load(reader, pixels, iterations);
  };
  ASSERT_TRUE(load(8, 2));
  ASSERT_EQ(read.paths().size(), 2u);
  EXPECT_EQ(read.bytes(), store.bytes());
  EXPECT_EQ(read.vertices(read.paths()[1])[0].light, vec3(3.0f));
  EXPECT_FALSE(load(8, 2, 1));
  EXPECT_TRUE(read.paths().empty());
  EXPECT_FALSE(load(7, 2)) << "a pixel that is not there";
  EXPECT_FALSE(load(8, 1)) << "an iteration that is not there";
  state[8 + 8] = 2;  // the first path's first vertex: it has two of the three
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
