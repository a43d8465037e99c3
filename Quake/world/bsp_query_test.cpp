// A map of two rooms in code: x < 0 solid, 0..10 air, 10..12 solid wall, 12..20 water, beyond solid.
#include "world/bsp_query.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fb::world {
namespace {

using formats::Bsp;

Bsp slabs() {
  Bsp bsp;
  for (float d : {0.0f, 10.0f, 12.0f, 20.0f}) bsp.planes.push_back({vec3(1, 0, 0), d, 0});
  const auto leaf = [](std::int32_t contents) {
    formats::BspLeaf l{};
    l.contents = contents;
    l.vis_offset = -1;
    return l;
  };
  bsp.leafs = {leaf(formats::kContentsSolid), leaf(formats::kContentsEmpty), leaf(formats::kContentsWater)};
  const auto node = [](std::uint32_t plane, std::int32_t front, std::int32_t back) {
    formats::BspNode n{};
    n.plane = plane;
    n.children = {front, back};
    return n;
  };
  // Root: x = 10; in front 12, then 20; behind 0.
  bsp.nodes = {node(1, 1, 3), node(2, 2, ~0), node(3, ~0, ~2), node(0, ~1, ~0)};
  formats::BspModel model{};
  model.head_nodes = {0, -1, -1, -1};
  bsp.models = {model};
  return bsp;
}

TEST(BspQuery, FindsLeafs) {
  const Bsp bsp = slabs();
  EXPECT_EQ(point_in_leaf(bsp, {5, 0, 0}), 1u);
  EXPECT_EQ(point_contents(bsp, {-1, 0, 0}), formats::kContentsSolid);
  EXPECT_EQ(point_contents(bsp, {0, 0, 0}), formats::kContentsEmpty) << "on the plane is in front";
  EXPECT_EQ(point_contents(bsp, {11, 0, 0}), formats::kContentsSolid);
  EXPECT_EQ(point_contents(bsp, {15, 0, 0}), formats::kContentsWater);
  EXPECT_EQ(point_contents(bsp, {25, 0, 0}), formats::kContentsSolid);
}

TEST(BspQuery, ModelWithoutNodes) {
  Bsp bsp = slabs();
  bsp.models[0].head_nodes[0] = ~2;
  EXPECT_EQ(point_contents(bsp, {0, 0, 0}), formats::kContentsWater);
  EXPECT_FALSE(trace_line(bsp, {0, 0, 0}, {1, 1, 1}).hit);
}

TEST(BspQuery, TracesLines) {
  const Bsp bsp = slabs();
  const LineHit hit = trace_line(bsp, {5, 0, 0}, {15, 0, 0});
  EXPECT_TRUE(hit.hit);
  EXPECT_FLOAT_EQ(hit.fraction, 0.5f);
  EXPECT_EQ(hit.normal, vec3(-1, 0, 0));
  EXPECT_FALSE(hit.start_solid);

  const LineHit back = trace_line(bsp, {5, 0, 0}, {-5, 3, 0});
  EXPECT_TRUE(back.hit);
  EXPECT_FLOAT_EQ(back.fraction, 0.5f);
  EXPECT_EQ(back.normal, vec3(1, 0, 0));

  EXPECT_FALSE(trace_line(bsp, {1, 0, 0}, {9, 9, 9}).hit);
  EXPECT_FALSE(trace_line(bsp, {13, 0, 0}, {19, 0, 0}).hit) << "water is open space";

  const LineHit out = trace_line(bsp, {-5, 0, 0}, {15, 0, 0});
  EXPECT_TRUE(out.start_solid);
  EXPECT_FALSE(out.all_solid);
  EXPECT_TRUE(out.hit);
  EXPECT_FLOAT_EQ(out.fraction, 0.75f) << "the wall, after leaving the solid at the start";

  const LineHit inside = trace_line(bsp, {-5, 0, 0}, {-1, 0, 0});
  EXPECT_TRUE(inside.all_solid);
  EXPECT_FALSE(inside.hit);
}

TEST(BspQuery, Visibility) {
  Bsp bsp = slabs();
  bsp.leafs.resize(20, bsp.leafs[1]);
  EXPECT_THAT(leaf_visibility(bsp, 1), testing::Each(true)) << "no data: everything";
  bsp.visibility = {0x03, 0x00, 0x01, 0x04};  // leafs 1 and 2; a byte of none; leaf 19
  bsp.leafs[1].vis_offset = 0;
  const std::vector<bool> seen = leaf_visibility(bsp, 1);
  ASSERT_EQ(seen.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(seen[i], i == 1 || i == 2 || i == 19) << i;
  EXPECT_THAT(leaf_visibility(bsp, 2), testing::Each(true));

  bsp.visibility = {0x01, 0x00};  // cut short in a run
  EXPECT_EQ(std::ranges::count(leaf_visibility(bsp, 1), true), 1);
  bsp.visibility = {0x00, 0x00, 0xff};  // a run of no bytes
  EXPECT_EQ(std::ranges::count(leaf_visibility(bsp, 1), true), 0);
  bsp.leafs[1].vis_offset = 99;
  EXPECT_EQ(std::ranges::count(leaf_visibility(bsp, 1), true), 0);
}

}  // namespace
}  // namespace fb::world
