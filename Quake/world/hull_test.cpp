#include "world/hull.h"

#include <cmath>

#include <gtest/gtest.h>

#include "formats/test_bsp.h"
#include "world/test_hulls.h"

namespace fb::world {
namespace {

using formats::kContentsEmpty;
using formats::kContentsSolid;
using formats::kContentsWater;

TEST(HullForSize, LooksAtTheWidthAlongXAlone) {
  EXPECT_EQ(hull_for_size({0, 0, 0}), 0);
  EXPECT_EQ(hull_for_size({2.999f, 500, 500}), 0);
  EXPECT_EQ(hull_for_size({3, 0, 0}), 1);
  EXPECT_EQ(hull_for_size({32, 32, 56}), 1);
  EXPECT_EQ(hull_for_size({32.01f, 1, 1}), 2);
  EXPECT_EQ(hull_for_size({500, 1, 1}), 2);
}

TEST(BoxHull, IsSolidInside) {
  const BoxHull box({-1, -2, -3}, {4, 5, 6});
  const Hull hull = box.hull();
  EXPECT_EQ(hull_point_contents(hull, {0, 0, 0}), kContentsSolid);
  for (int axis = 0; axis < 3; ++axis) {
    vec3 p(0.0f);
    p[axis] = 6.5f;
    EXPECT_EQ(hull_point_contents(hull, p), kContentsEmpty) << axis;
    p[axis] = -3.5f;
    EXPECT_EQ(hull_point_contents(hull, p), kContentsEmpty) << axis;
  }
  // A point on a plane is in front of it: out of the upper faces, inside of the lower ones.
  EXPECT_EQ(hull_point_contents(hull, {4, 0, 0}), kContentsEmpty);
  EXPECT_EQ(hull_point_contents(hull, {-1, -2, -3}), kContentsSolid);
}

// A model whose hulls differ: the point's from nodes and leafs, the boxes' from clip nodes.
TEST(MapHulls, TakesNodesAndClipNodes) {
  formats::Bsp bsp = formats::testing::box_room(formats::BspVersion::kBsp29);
  bsp.clip_nodes[0].children = {kContentsWater, kContentsSolid};
  bsp.leafs[1].contents = formats::kContentsSky;
  const MapHulls map(bsp);
  EXPECT_EQ(map.model_count(), 2u);
  EXPECT_EQ(hull_point_contents(map.hull(0, 0), {0, 0, 0}), formats::kContentsSky);
  EXPECT_EQ(hull_point_contents(map.hull(0, 0), {0, 200, 0}), kContentsSolid);
  EXPECT_EQ(hull_point_contents(map.hull(0, 1), {0, 0, 0}), kContentsWater);
  EXPECT_EQ(hull_point_contents(map.hull(1, 0), {0, 0, 0}), kContentsSolid) << "a head that is a leaf";
  EXPECT_EQ(hull_point_contents(map.hull(1, 2), {0, 0, 0}), kContentsSolid) << "a head that is contents";
  EXPECT_EQ(map.hull(0, 0).clip_mins, vec3(0, 0, 0));
  EXPECT_EQ(map.hull(0, 1).clip_mins, vec3(-16, -16, -24));
  EXPECT_EQ(map.hull(0, 1).clip_maxs, vec3(16, 16, 32));
  EXPECT_EQ(map.hull(0, 2).clip_mins, vec3(-32, -32, -24));
  EXPECT_EQ(map.hull(0, 2).clip_maxs, vec3(32, 32, 64));
}

TEST(MapHulls, CurrentsAreWater) {
  formats::Bsp bsp = formats::testing::box_room(formats::BspVersion::kBsp2);
  const auto told = [&](std::int32_t contents) {
    bsp.leafs[1].contents = contents;
    return sv_point_contents(MapHulls(bsp), {0, 0, 0});
  };
  for (std::int32_t contents = kContentsEmpty; contents > formats::kContentsCurrent0; --contents)
    EXPECT_EQ(told(contents), contents);
  EXPECT_EQ(told(formats::kContentsCurrent0), kContentsWater);
  EXPECT_EQ(told(formats::kContentsCurrentDown), kContentsWater);
  EXPECT_EQ(told(formats::kContentsCurrentDown - 1), formats::kContentsCurrentDown - 1);
  bsp.leafs[1].contents = formats::kContentsCurrent0;
  EXPECT_EQ(true_point_contents(MapHulls(bsp), {0, 0, 0}), formats::kContentsCurrent0);
}

// Slanted planes are asked in double. With floats some points near a plane far out would be on its other side.
TEST(HullPlaneDistance, IsRoundedOnce) {
  Rng rng(7);
  int floats_differ = 0;
  for (int i = 0; i < 10000; ++i) {
    HullNode node;
    node.normal = glm::normalize(testing::random_point(rng, 1.0f));
    node.type = 3;
    const vec3 p = testing::random_point(rng, 8000.0f);
    node.distance = glm::dot(node.normal, p) + rng.uniform(-1e-3f, 1e-3f);
    const long double exact = static_cast<long double>(node.normal.x) * p.x +
                              static_cast<long double>(node.normal.y) * p.y +
                              static_cast<long double>(node.normal.z) * p.z - node.distance;
    const float d = hull_plane_distance(node, p);
    EXPECT_NEAR(d, static_cast<double>(exact), 1e-9 + 1e-7 * std::fabs(static_cast<double>(exact)));
    EXPECT_EQ(d < 0.0f, exact < 0);
    const float in_floats = node.normal.x * p.x + node.normal.y * p.y + node.normal.z * p.z - node.distance;
    if ((in_floats < 0.0f) != (exact < 0)) ++floats_differ;
  }
  EXPECT_GT(floats_differ, 100) << "else this test could not tell";
}

}  // namespace
}  // namespace fb::world
