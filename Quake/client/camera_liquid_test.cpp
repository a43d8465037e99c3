#include "client/camera_liquid.h"

#include <gtest/gtest.h>

namespace fb::cl {
namespace {

// Two models of one plane each, z = 0: in the world's there is slime below it, in submodel 1's water. Materials: stone,
// water, slime.
struct Pools {
  Pools() {
    for (const std::int32_t contents : {formats::kContentsSolid, formats::kContentsEmpty, formats::kContentsWater,
                                        formats::kContentsSlime, formats::kContentsCurrent0}) {
      map.leafs.push_back({});
      map.leafs.back().contents = contents;
    }
    map.planes.push_back({vec3(0, 0, 1), 0.0f, 2});
    for (const std::int32_t below : {3, 2}) {
      formats::BspNode node{};
      node.children = {~1, ~below};
      formats::BspModel model{};
      model.head_nodes[0] = static_cast<std::int32_t>(map.nodes.size());
      map.nodes.push_back(node);
      map.models.push_back(model);
    }
    assets.materials.resize(3);
    for (const std::size_t liquid : {1u, 2u})
      assets.materials[liquid].flags = scene::kMaterialDielectric | scene::kMaterialLiquid;
    assets.materials[2].emission_kind = scene::EmissionKind::kSlime;
    assets.meshes.resize(2);
    for (const std::uint32_t material : {0u, 1u}) assets.meshes[1].triangles.push_back({{}, material, {}});
    assets.meshes[0].triangles.push_back({{}, 0, {}});
  }
  formats::Bsp map;
  scene::Assets assets;
};

TEST(CameraLiquid, OfTheWorldIsOfTheKindThatItsLeafsSay) {
  Pools p;
  EXPECT_EQ(liquid_of_world(p.map, p.assets, {}, {5, 5, 1}), scene::kNone);
  EXPECT_EQ(liquid_of_world(p.map, p.assets, {}, {5, 5, -1}), 2u) << "slime";
  p.map.nodes[0].children[1] = ~4;
  EXPECT_EQ(liquid_of_world(p.map, p.assets, {}, {5, 5, -1}), 1u) << "a current is water";
  p.assets.materials[1].flags = scene::kMaterialDielectric;
  EXPECT_EQ(liquid_of_world(p.map, p.assets, {}, {5, 5, -1}), 2u) << "glass is no liquid";
}

TEST(CameraLiquid, LavaIsOneTooAndOfNoMaterialWhereOpaque) {
  Pools p;
  EXPECT_FALSE(liquid_is_at(p.map, {5, 5, 1}));
  for (const std::int32_t contents : {formats::kContentsWater, formats::kContentsSlime, formats::kContentsLava,
                                      formats::kContentsCurrent0, formats::kContentsCurrentDown}) {
    p.map.leafs[3].contents = contents;
    EXPECT_TRUE(liquid_is_at(p.map, {5, 5, -1})) << contents;
  }
  for (const std::int32_t contents : {formats::kContentsSolid, formats::kContentsSky}) {
    p.map.leafs[3].contents = contents;
    EXPECT_FALSE(liquid_is_at(p.map, {5, 5, -1})) << contents;
  }
  p.map.leafs[3].contents = formats::kContentsLava;
  EXPECT_EQ(liquid_of_world(p.map, p.assets, {}, {5, 5, -1}), scene::kNone);
}

TEST(CameraLiquid, LavaHasAMaterialWhereItIsLessThanOpaque) {
  Pools p;
  p.map.leafs[3].contents = formats::kContentsLava;
  scene::Material lava;
  lava.flags = scene::kMaterialLiquid;
  lava.emission_kind = scene::EmissionKind::kLava;
  lava.opacity_from = scene::OpacityFrom::kLava;
  p.assets.materials.push_back(lava);
  const auto number = static_cast<std::uint32_t>(p.assets.materials.size() - 1);
  EXPECT_EQ(liquid_of_world(p.map, p.assets, {}, {5, 5, -1}), scene::kNone) << "not the map's water";
  EXPECT_EQ(liquid_of_world(p.map, p.assets, {.lava = 0.5f}, {5, 5, -1}), number);
}

TEST(CameraLiquid, OfABrushModelIsWhereItHasMoved) {
  const Pools p;
  const mat4x3 lifted = entity_transform({0, 0, 100}, vec3(0.0f));
  const mat4x3 upside_down = entity_transform(vec3(0.0f), {0, 0, 180});
  EXPECT_EQ(liquid_of_submodel(p.map, p.assets, {}, 1, 1, mat4x3(1.0f), {5, 5, 50}), scene::kNone);
  EXPECT_EQ(liquid_of_submodel(p.map, p.assets, {}, 1, 1, lifted, {5, 5, 50}), 1u);
  EXPECT_EQ(liquid_of_submodel(p.map, p.assets, {}, 1, 1, upside_down, {5, 5, 50}), 1u);
  EXPECT_EQ(liquid_of_submodel(p.map, p.assets, {}, 1, 1, upside_down, {5, 5, -50}), scene::kNone);
  EXPECT_EQ(liquid_of_submodel(p.map, p.assets, {}, 1, 0, lifted, {5, 5, 50}), scene::kNone) << "it shows no liquid";
  EXPECT_EQ(liquid_of_submodel(p.map, p.assets, {}, 2, 1, lifted, {5, 5, 50}), scene::kNone) << "there is none";
}

}  // namespace
}  // namespace fb::cl
