// The builder's promises: every primitive in exactly one leaf, boxes that contain what is below, bounded depth, the
// same tree every time, whatever comes in.
#include "gpu/bvh.h"

#include <algorithm>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "base/rng.h"

namespace fb::gpu {
namespace {

std::vector<Bounds> random_boxes(std::size_t count, float extent, float size, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Bounds> boxes(count);
  for (Bounds& box : boxes) {
    vec3 center{rng.uniform() * extent, rng.uniform() * extent, rng.uniform() * extent};
    for (int i = 0; i < 3; ++i) {
      box.add(center + vec3{rng.uniform() * size, rng.uniform() * size, rng.uniform() * size});
    }
  }
  return boxes;
}

bool contains(const Bounds& outer, const Bounds& inner) {
  return glm::all(glm::lessThanEqual(outer.min, inner.min)) && glm::all(glm::greaterThanEqual(outer.max, inner.max));
}

struct Walk {
  const Bvh& bvh;
  const std::vector<Bounds>& boxes;
  const BvhOptions& options;
  std::vector<int> seen;
  std::uint32_t depth = 0;

  Bounds visit(std::uint32_t ref, std::uint32_t level) {
    Bounds all;
    if (ref >= shared::kRefLeaf) {
      std::uint32_t first = ref & shared::kRefFirstMask;
      std::uint32_t count = (ref >> shared::kRefCountShift & shared::kRefCountMask) + 1;
      EXPECT_LE(count, options.max_leaf);
      for (std::uint32_t i = first; i < first + count; ++i) {
        ++seen.at(bvh.order.at(i));
        all.add(boxes[bvh.order[i]]);
      }
      return all;
    }
    depth = std::max(depth, level + 1);
    const shared::BvhNode& node = bvh.nodes.at(ref);
    Bounds below0 = visit(node.child0, level + 1), below1 = visit(node.child1, level + 1);
    EXPECT_TRUE(contains({node.min0, node.max0}, below0));
    EXPECT_TRUE(contains({node.min1, node.max1}, below1));
    all.add(below0);
    all.add(below1);
    return all;
  }
};

void expect_valid(const std::vector<Bounds>& boxes, const BvhOptions& options) {
  Bvh bvh = build_bvh(boxes, options);
  Walk walk{bvh, boxes, options, std::vector<int>(boxes.size())};
  Bounds all = walk.visit(bvh.root, 0);
  EXPECT_TRUE(contains(bvh.bounds, all));
  for (int times : walk.seen) EXPECT_EQ(times, 1);
  EXPECT_EQ(walk.depth, bvh.depth);
  EXPECT_LE(bvh.depth, options.max_depth);
  // Every node once, its inner children in the next level.
  EXPECT_EQ(bvh.level_order.size(), bvh.nodes.size());
  EXPECT_EQ(bvh.level_first.back(), bvh.nodes.size());
  std::vector<std::size_t> level_of(bvh.nodes.size(), ~std::size_t{0});
  for (std::size_t level = 0; level + 1 < bvh.level_first.size(); ++level) {
    for (std::uint32_t i = bvh.level_first[level]; i < bvh.level_first[level + 1]; ++i) {
      EXPECT_EQ(level_of.at(bvh.level_order[i]), ~std::size_t{0});
      level_of[bvh.level_order[i]] = level;
    }
  }
  for (std::size_t i = 0; i < bvh.nodes.size(); ++i) {
    for (std::uint32_t child : {bvh.nodes[i].child0, bvh.nodes[i].child1}) {
      if (child >= shared::kRefLeaf) continue;
      EXPECT_EQ(level_of.at(child), level_of[i] + 1);
    }
  }
}

TEST(Bvh, HoldsEveryPrimitiveOnce) {
  for (std::size_t count : {1, 2, 3, 4, 5, 9, 100, 5000}) {
    for (std::uint32_t leaf : {1u, 2u, 4u, 8u}) {
      expect_valid(random_boxes(count, 1000, 20, count), {.max_leaf = leaf});
    }
  }
}

TEST(Bvh, NothingGivesATreeThatNoRayHits) {
  Bvh bvh = build_bvh({}, {});
  ASSERT_EQ(bvh.nodes.size(), 1u);
  EXPECT_EQ(bvh.root, 0u);
  EXPECT_GE(bvh.nodes[0].min0.x, 1e30f);
  EXPECT_GE(bvh.nodes[0].min1.x, 1e30f);
}

TEST(Bvh, BearsCoincidentFlatAndHugeBoxes) {
  std::vector<Bounds> same(1000, Bounds{{1, 2, 3}, {4, 5, 6}});
  expect_valid(same, {});
  std::vector<Bounds> points(777, Bounds{vec3(5), vec3(5)});
  expect_valid(points, {.max_leaf = 1});
  std::vector<Bounds> huge = random_boxes(500, 3e38f, 1e37f, 3);
  expect_valid(huge, {});
  std::vector<Bounds> flat = random_boxes(500, 100, 10, 4);
  for (Bounds& box : flat) box.min.z = box.max.z = 0;
  expect_valid(flat, {});
}

// Sizes that double: the heuristic alone would peel off one primitive a level.
TEST(Bvh, KeepsToItsDepth) {
  std::vector<Bounds> boxes;
  for (int i = 0; i < 120; ++i) {
    float size = std::ldexp(1.0f, i - 60);
    boxes.push_back({vec3(size), vec3(2 * size)});
  }
  expect_valid(boxes, {.max_leaf = 1, .max_depth = 7});
  expect_valid(boxes, {.max_leaf = 1, .max_depth = 10});
  expect_valid(random_boxes(1 << 12, 100, 1, 9), {.max_leaf = 1, .max_depth = 12});
}

TEST(Bvh, IsTheSameEveryTime) {
  std::vector<Bounds> boxes = random_boxes(3000, 1000, 20, 11);
  Bvh a = build_bvh(boxes, {}), b = build_bvh(boxes, {});
  EXPECT_EQ(a.order, b.order);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  EXPECT_EQ(std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(a.nodes[0])), 0);
}

// On a grid of unit boxes the heuristic must do far better than leaves taken in any order.
TEST(Bvh, IsCheapToTraverse) {
  std::vector<Bounds> boxes;
  for (int i = 0; i < 4096; ++i) {
    int shuffled = i * 1567 % 4096;
    vec3 at{shuffled % 16, shuffled / 16 % 16, shuffled / 256};
    boxes.push_back({at * 4.0f, at * 4.0f + 1.0f});
  }
  EXPECT_LT(bvh_cost(build_bvh(boxes, {}), 1.0f), 60.0);
}

}  // namespace
}  // namespace fb::gpu
