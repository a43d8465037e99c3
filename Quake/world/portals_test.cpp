// Portals of small trees in code.
#include "world/portals.h"

#include <algorithm>
#include <initializer_list>

#include <gtest/gtest.h>

namespace fb::world {
namespace {

using formats::Bsp;

struct TestNode {
  vec3 normal;
  float distance;
  std::int32_t front, back;
};
// Leaf 0 is solid; `contents`: of those from 1 on.
Bsp tree_of(std::initializer_list<TestNode> nodes, std::initializer_list<std::int32_t> contents) {
  Bsp bsp;
  formats::BspLeaf leaf{};
  leaf.contents = formats::kContentsSolid;
  leaf.vis_offset = -1;
  bsp.leafs.push_back(leaf);
  for (const std::int32_t c : contents) {
    leaf.contents = c;
    bsp.leafs.push_back(leaf);
  }
  for (const TestNode& n : nodes) {
    formats::BspNode node{};
    node.plane = static_cast<std::uint32_t>(bsp.planes.size());
    node.children = {n.front, n.back};
    bsp.planes.push_back({n.normal, n.distance, 3});
    bsp.nodes.push_back(node);
  }
  formats::BspModel model{};
  model.head_nodes = {0, -1, -1, -1};
  model.visible_leafs = static_cast<std::uint32_t>(contents.size());
  bsp.models = {model};
  return bsp;
}

const vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

// Rooms at x < 0 (leaf 1) and x > 8 (leaf 2), a wall between them with a doorway, |y| < 16, z < 64 (leaf 3).
TEST(LeafPortals, ADoorwayHasOneOnEachSide) {
  const Bsp bsp =
      tree_of({{kX, 8, ~2, 1}, {kX, 0, 2, ~1}, {kY, 16, ~0, 3}, {kY, -16, 4, ~0}, {kZ, 64, ~0, 5}, {kZ, 0, ~3, ~0}},
              {formats::kContentsEmpty, formats::kContentsEmpty, formats::kContentsEmpty});
  std::vector<Portal> portals = leaf_portals(bsp);
  ASSERT_EQ(portals.size(), 2u);
  std::ranges::sort(portals, {}, [](const Portal& p) { return p.bounds.min.x; });
  const std::uint32_t sides[2][2] = {{3, 1}, {2, 3}};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(portals[i].front, sides[i][0]);
    EXPECT_EQ(portals[i].back, sides[i][1]);
    const float x = i == 0 ? 0.0f : 8.0f;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(portals[i].bounds.min[axis], vec3(x, -16, 0)[axis], 1e-3f);
      EXPECT_NEAR(portals[i].bounds.max[axis], vec3(x, 16, 64)[axis], 1e-3f);
    }
  }
}

// Without the doorway there is none, however thin the wall is; sky is as good as solid, and water is not.
TEST(LeafPortals, WallsHaveNone) {
  for (const std::int32_t other : {formats::kContentsSky, formats::kContentsSolid})
    EXPECT_TRUE(leaf_portals(tree_of({{kX, 0, ~1, ~2}}, {formats::kContentsEmpty, other})).empty());
  EXPECT_EQ(leaf_portals(tree_of({{kX, 0, ~1, ~2}}, {formats::kContentsEmpty, formats::kContentsWater})).size(), 1u);
  EXPECT_TRUE(
      leaf_portals(tree_of({{kX, 1, ~1, 1}, {kX, 0, ~0, ~2}}, {formats::kContentsEmpty, formats::kContentsEmpty}))
          .empty());
}

// A plane that is cut by others has a portal for each pair of leafs that meet on it: here 2 x 2, the halves of one side
// being split by y, those of the other by a slanted plane.
TEST(LeafPortals, PiecesOfAPlane) {
  const Bsp bsp =
      tree_of({{kX, 0, 1, 2}, {kY, 0, ~1, ~2}, {glm::normalize(vec3(0, 1, 1)), 0, ~3, ~4}},
              {formats::kContentsEmpty, formats::kContentsEmpty, formats::kContentsEmpty, formats::kContentsEmpty});
  const std::vector<Portal> portals = leaf_portals(bsp);
  for (const std::uint32_t front : {1u, 2u})
    for (const std::uint32_t back : {3u, 4u})
      EXPECT_EQ(std::ranges::count_if(portals, [&](const Portal& p) { return p.front == front && p.back == back; }), 1)
          << front << " " << back;
  // And on each side one between its halves.
  EXPECT_EQ(portals.size(), 6u);
}

// A tree may have a plane again below itself; the way through is found nonetheless, the solid beside it is none.
TEST(LeafPortals, APlaneThatComesAgain) {
  const Bsp bsp = tree_of({{kX, 0, 1, ~2}, {kX, 0, ~1, ~0}}, {formats::kContentsEmpty, formats::kContentsEmpty});
  const std::vector<Portal> portals = leaf_portals(bsp);
  ASSERT_EQ(portals.size(), 1u);
  EXPECT_EQ(portals[0].front, 1u);
  EXPECT_EQ(portals[0].back, 2u);
}

}  // namespace
}  // namespace fb::world
