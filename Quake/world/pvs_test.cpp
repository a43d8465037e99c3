#include "world/pvs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fb::world {
namespace {

using ::testing::ElementsAre;

// Leafs in a row along x, each 100 wide: leaf 1 is x < 100, leaf 2 is 100 to 200, ... Leaf `solid`, if any, is rock.
formats::Bsp row_of_leafs(std::uint32_t count, std::uint32_t solid = 0) {
  formats::Bsp bsp;
  formats::BspLeaf leaf{};
  leaf.vis_offset = -1;
  leaf.contents = formats::kContentsEmpty;
  bsp.leafs.assign(count + 1, leaf);
  bsp.leafs[0].contents = formats::kContentsSolid;
  if (solid != 0) bsp.leafs[solid].contents = formats::kContentsSolid;
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    bsp.planes.push_back({vec3(1, 0, 0), 100.0f * static_cast<float>(i + 1), 0});
    formats::BspNode node{};
    node.plane = i;
    node.children = {i + 2 < count ? static_cast<std::int32_t>(i + 1) : ~static_cast<std::int32_t>(count),
                     ~static_cast<std::int32_t>(i + 1)};
    bsp.nodes.push_back(node);
  }
  formats::BspModel model{};
  model.visible_leafs = count;
  bsp.models = {model};
  return bsp;
}
// Rows by which each leaf sees itself alone.
void see_only_oneself(formats::Bsp& bsp) {
  for (std::size_t leaf = 1; leaf < bsp.leafs.size(); ++leaf) {
    bsp.leafs[leaf].vis_offset = static_cast<std::int32_t>(bsp.visibility.size());
    const std::size_t zeros = (leaf - 1) / 8;
    if (zeros > 0) {
      bsp.visibility.push_back(0);
      bsp.visibility.push_back(static_cast<std::uint8_t>(zeros));
    }
    bsp.visibility.push_back(static_cast<std::uint8_t>(1u << ((leaf - 1) % 8)));
    const std::size_t bytes = (bsp.leafs.size() - 1 + 7) / 8;
    if (bytes > zeros + 1) {
      bsp.visibility.push_back(0);
      bsp.visibility.push_back(static_cast<std::uint8_t>(bytes - zeros - 1));
    }
  }
}
std::vector<std::uint32_t> members(const LeafSet& set) {
  std::vector<std::uint32_t> leafs;
  for (std::uint32_t leaf = 0; leaf <= set.leaf_count(); ++leaf)
    if (set.contains(leaf)) leafs.push_back(leaf);
  return leafs;
}

TEST(PvsLeaf, OnThePlaneIsBehind) {
  const formats::Bsp bsp = row_of_leafs(4);
  EXPECT_EQ(pvs_leaf(bsp, {150, 0, 0}), 2u);
  EXPECT_EQ(pvs_leaf(bsp, {200, 0, 0}), 2u);
  EXPECT_EQ(pvs_leaf(bsp, {200.1f, 0, 0}), 3u);
  EXPECT_EQ(pvs_leaf(bsp, {9999, 0, 0}), 4u);
}

TEST(LeafPvs, RowsAndWhatHasNone) {
  formats::Bsp bsp = row_of_leafs(20);
  EXPECT_EQ(members(leaf_pvs(bsp, 3)).size(), 20u) << "no data: everything";
  see_only_oneself(bsp);
  for (std::uint32_t leaf = 1; leaf <= 20; ++leaf) EXPECT_THAT(members(leaf_pvs(bsp, leaf)), ElementsAre(leaf));
  EXPECT_EQ(members(leaf_pvs(bsp, 0)).size(), 20u) << "solid sees everything";
  bsp.leafs[5].vis_offset = -1;
  EXPECT_EQ(members(leaf_pvs(bsp, 5)).size(), 20u);
  EXPECT_TRUE(leaf_pvs(bsp, 6).contains(21)) << "unknown to the map's visibility";
  EXPECT_FALSE(leaf_pvs(bsp, 5).contains(0));
}

TEST(LeafPvs, RowsCutShort) {
  formats::Bsp bsp = row_of_leafs(20);
  bsp.leafs[1].vis_offset = 0;
  bsp.visibility = {0x81, 0x00};
  EXPECT_THAT(members(leaf_pvs(bsp, 1)), ElementsAre(1, 8));
  bsp.visibility = {0x01, 0x00, 0xff};
  EXPECT_THAT(members(leaf_pvs(bsp, 1)), ElementsAre(1));
  bsp.visibility = {0x00, 0x00, 0x00, 0x00, 0x02};
  EXPECT_THAT(members(leaf_pvs(bsp, 1)), ElementsAre(2)) << "runs of none take no room";
  bsp.leafs[1].vis_offset = 99;
  EXPECT_TRUE(members(leaf_pvs(bsp, 1)).empty());
}

TEST(FatPvs, EightUnitsOnBothSides) {
  formats::Bsp bsp = row_of_leafs(12);
  see_only_oneself(bsp);
  EXPECT_THAT(members(fat_pvs(bsp, {150, 0, 0})), ElementsAre(2));
  EXPECT_THAT(members(fat_pvs(bsp, {192, 0, 0})), ElementsAre(2, 3)) << "8 units counts";
  EXPECT_THAT(members(fat_pvs(bsp, {191.9f, 0, 0})), ElementsAre(2));
  EXPECT_THAT(members(fat_pvs(bsp, {208, 0, 0})), ElementsAre(2, 3));
  EXPECT_THAT(members(fat_pvs(bsp, {208.1f, 0, 0})), ElementsAre(3));
  LeafSet two = fat_pvs(bsp, {150, 0, 0});
  add_fat_pvs(bsp, {1199, 0, 0}, two);
  EXPECT_THAT(members(two), ElementsAre(2, 12));
  two.add(fat_pvs(bsp, {550, 0, 0}));
  EXPECT_THAT(members(two), ElementsAre(2, 6, 12));
}

TEST(FatPvs, SolidLeafsSeeNothing) {
  formats::Bsp bsp = row_of_leafs(12, 3);
  see_only_oneself(bsp);
  EXPECT_TRUE(members(fat_pvs(bsp, {250, 0, 0})).empty());
  EXPECT_THAT(members(fat_pvs(bsp, {201, 0, 0})), ElementsAre(2)) << "but what is near does";
}

std::vector<std::uint32_t> touched(const formats::Bsp& bsp, float from, float to) {
  const TouchedLeafs t = touched_leafs(bsp, {vec3(from, -1, -1), vec3(to, 1, 1)});
  return {t.leafs.begin(), t.leafs.begin() + t.count};
}

TEST(TouchedLeafs, InTheOrderOfTheTreeWithoutSolidOnes) {
  const formats::Bsp bsp = row_of_leafs(6, 4);
  EXPECT_THAT(touched(bsp, 110, 120), ElementsAre(2));
  EXPECT_THAT(touched(bsp, 110, 620), ElementsAre(6, 5, 3, 2)) << "front first";
  EXPECT_THAT(touched(bsp, 310, 390), ElementsAre());
  EXPECT_THAT(touched(bsp, 100, 200), ElementsAre(2)) << "touching planes from one side";
  EXPECT_THAT(touched(bsp, 100, 100), ElementsAre(2)) << "flat on a plane: in front";
}

TEST(TouchedLeafs, SlantedPlanes) {
  formats::Bsp bsp = row_of_leafs(2);
  bsp.planes[0] = {glm::normalize(vec3(1, -1, 0)), 0.0f, 3};
  const auto leafs = [&](const vec3& min, const vec3& max) {
    const TouchedLeafs t = touched_leafs(bsp, {min, max});
    return std::vector<std::uint32_t>(t.leafs.begin(), t.leafs.begin() + t.count);
  };
  EXPECT_THAT(leafs({10, -10, 0}, {20, 5, 0}), ElementsAre(2));
  EXPECT_THAT(leafs({-10, 10, 0}, {5, 20, 0}), ElementsAre(1));
  EXPECT_THAT(leafs({-10, -10, 0}, {10, 10, 0}), ElementsAre(2, 1));
  EXPECT_THAT(leafs({-5, 0, 0}, {0, 5, 0}), ElementsAre(2, 1)) << "touching a slanted plane counts in front as well";
}

TEST(TouchedLeafs, TooManyAreVisibleFromEverywhere) {
  formats::Bsp bsp = row_of_leafs(60);
  see_only_oneself(bsp);
  const TouchedLeafs some = touched_leafs(bsp, {vec3(150, 0, 0), vec3(450, 1, 1)});
  EXPECT_EQ(some.count, 4u);
  EXPECT_TRUE(some.visible_in(leaf_pvs(bsp, 4)));
  EXPECT_FALSE(some.visible_in(leaf_pvs(bsp, 40)));
  const TouchedLeafs nearly = touched_leafs(bsp, {vec3(50, 0, 0), vec3(3050, 1, 1)});
  EXPECT_EQ(nearly.count, 31u);
  EXPECT_FALSE(nearly.visible_in(leaf_pvs(bsp, 60)));
  const TouchedLeafs many = touched_leafs(bsp, {vec3(50, 0, 0), vec3(5950, 1, 1)});
  EXPECT_EQ(many.count, TouchedLeafs::kMost);
  EXPECT_TRUE(many.visible_in(leaf_pvs(bsp, 1)));
  const LeafSet none(60);
  EXPECT_FALSE(TouchedLeafs{}.visible_in(leaf_pvs(bsp, 1)));
  EXPECT_TRUE(members(none).empty());
}

}  // namespace
}  // namespace fb::world
