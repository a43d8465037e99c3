#include "world/liquid_windows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace fb::world {
namespace {

// A surface at z = 0 over all x: leaf 1 is above it, leafs 2 and 3 are below, either side of x = 100. Each sees itself
// alone, but for `sees_through`.
formats::Bsp pool(const std::string& texture, std::int32_t below, bool sees_through = false) {
  formats::Bsp bsp;
  formats::BspLeaf leaf{};
  leaf.contents = formats::kContentsEmpty;
  bsp.leafs.assign(4, leaf);
  bsp.leafs[0].contents = formats::kContentsSolid;
  bsp.leafs[2].contents = bsp.leafs[3].contents = below;
  for (std::size_t i = 1; i < 4; ++i) {
    bsp.leafs[i].vis_offset = static_cast<std::int32_t>(bsp.visibility.size());
    bsp.visibility.push_back(static_cast<std::uint8_t>(sees_through ? 7 : 1u << (i - 1)));
  }
  bsp.planes = {{vec3(0, 0, 1), 0, 2}, {vec3(1, 0, 0), 100, 0}};
  bsp.nodes.resize(2);
  bsp.nodes[0].plane = 0;
  bsp.nodes[0].children = {~1, 1};
  bsp.nodes[1].plane = 1;
  bsp.nodes[1].children = {~3, ~2};
  bsp.vertices = {{-200, -50, 0}, {200, -50, 0}, {200, 50, 0}, {-200, 50, 0}};
  bsp.edges = {{0, 0}, {0, 1}, {1, 2}, {2, 3}, {3, 0}};
  bsp.surfedges = {1, 2, 3, 4};
  bsp.textures.resize(1);
  bsp.textures[0].name = texture;
  bsp.texinfos.resize(1);
  bsp.texinfos[0].texture = 0;
  formats::BspFace face{};
  face.surfedge_count = 4;
  bsp.faces = {face};
  formats::BspModel model{};
  model.visible_leafs = 3;
  model.face_count = 1;
  bsp.models = {model};
  return bsp;
}

bool sees(const formats::Bsp& bsp, std::uint32_t from, std::uint32_t to) {
  LeafSet set = leaf_pvs(bsp, from);
  LiquidWindows(bsp).add(bsp, set);
  return set.contains(to);
}

TEST(LiquidWindows, ShowWhatIsBehindAnOpaqueSurfaceFromBothSides) {
  for (const std::int32_t contents :
       {formats::kContentsWater, formats::kContentsSlime, formats::kContentsCurrent0, formats::kContentsCurrentDown}) {
    const formats::Bsp bsp = pool("*water1", contents);
    EXPECT_EQ(LiquidWindows(bsp).count(), 4u);
    EXPECT_TRUE(sees(bsp, 1, 2));
    EXPECT_TRUE(sees(bsp, 1, 3));
    EXPECT_TRUE(sees(bsp, 2, 1));
    EXPECT_FALSE(sees(bsp, 2, 3)) << "by way of the air: not through one surface";
  }
}

TEST(LiquidWindows, AreNoneWhereVisibilityPassesLiquidsOrNothingIsClear) {
  EXPECT_TRUE(LiquidWindows(pool("*water1", formats::kContentsWater, true)).empty());
  EXPECT_TRUE(LiquidWindows(pool("*lava1", formats::kContentsLava)).empty());
  EXPECT_TRUE(LiquidWindows(pool("*water1", formats::kContentsEmpty)).empty()) << "no liquid on either side";
  EXPECT_TRUE(LiquidWindows(pool("rock", formats::kContentsWater)).empty()) << "no surface of a liquid";
  EXPECT_TRUE(LiquidWindows(pool("*teleport", formats::kContentsWater)).empty());
  formats::Bsp blind = pool("*water1", formats::kContentsWater);
  blind.visibility.clear();
  EXPECT_TRUE(LiquidWindows(blind).empty()) << "all see all";
  EXPECT_TRUE(LiquidWindows().empty());
}

}  // namespace
}  // namespace fb::world
