// The material table: frames for the time, alternates, clocks of their own, the cvars' scales; and what instances say.
#include "render/scene/gpu_scene_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <memory>
#include <utility>

#include "render/passes/frame_keys.h"
#include "render/passes/settings.h"
#include "render/scene/gpu_scene_tree.h"

namespace fb::render {
namespace {

struct Tables : testing::Test {
  Tables() {
    scene::Material still, playing;
    still.frames = {{.base = 7}};
    still.emission_kind = scene::EmissionKind::kConstant;
    still.emission = vec3(1, 2, 3);
    playing.frames = {{.base = 10}, {.base = 11}, {.base = 12}};
    playing.alternate_frames = {{.base = 20}, {.base = 21}};
    playing.frames_per_second = 10;
    playing.emission_kind = scene::EmissionKind::kLava;
    playing.emission = vec3(1, 1, 0.5f);
    assets.materials = {still, playing};
    scales.fill(1.0f);
    scales[static_cast<std::size_t>(scene::EmissionKind::kLava)] = 8;
    scales[static_cast<std::size_t>(scene::EmissionKind::kConstant)] = 100;
    mesh.triangle_count = 1;
    mesh.materials = {0};
  }
  const shared::GpuMaterial& entry(const scene::Instance& instance) {
    const std::uint32_t base = table.base_for(assets, mesh, instance);
    return table.entries().at(base + mesh.materials[0]);
  }
  scene::Assets assets;
  EmissionScales scales;
  MeshRecord mesh;
  MaterialTable table;
};

TEST_F(Tables, ResolveTextureFramesForTheTime) {
  scene::Instance instance;
  instance.material_base = 1;
  for (auto [time, base] : {std::pair(0.0, 10u), {0.15, 11u}, {0.25, 12u}, {0.35, 10u}}) {
    table.begin(assets, time, scales);
    EXPECT_EQ(entry(instance).base, base) << time;
  }
  instance.flags = scene::kInstanceAlternate;
  table.begin(assets, 0.15, scales);
  EXPECT_EQ(entry(instance).base, 21u);
  EXPECT_EQ(table.entries().size(), 4u);
}

TEST_F(Tables, GiveAClockOfItsOwnItsEntry) {
  scene::Instance instance;
  instance.material_base = 1;
  instance.time_offset = 0.1f;
  table.begin(assets, 0.25, scales);
  EXPECT_EQ(entry(instance).base, 11u);
  EXPECT_EQ(table.entries().size(), 5u);
  instance.flags = scene::kInstanceShareTime;
  EXPECT_EQ(entry(instance).base, 12u);
  instance = {};
  instance.time_offset = 0.1f;  // nothing moves in this material
  EXPECT_EQ(entry(instance).base, 7u);
  EXPECT_EQ(table.entries().size(), 5u);
}

TEST_F(Tables, ScaleEmissionByItsKindButNotConstants) {
  table.begin(assets, 0, scales);
  EXPECT_EQ(vec3(table.entries()[0].emission), vec3(1, 2, 3));
  EXPECT_EQ(vec3(table.entries()[1].emission), vec3(8, 8, 4));
  scene::Instance instance;
  instance.flags = scene::kInstanceColor;
  instance.emission = vec3(2, 0, 1);
  const auto out =
      make_gpu_instance(mesh, instance, mat4x3(1.0f), 0, emission_scale(scales, scene::EmissionKind::kLava));
  EXPECT_EQ(vec3(out.emission), vec3(16, 0, 8));
  EXPECT_NE(out.flags & shared::kInstanceHasColor, 0u);
}

TEST_F(Tables, WhatAMaterialLightsIsNotHowItLooksWhereItsAuthorsLightCounts) {
  assets.materials[1].cast = vec3(0.25f, 0.5f, 2.0f);
  scene::Instance instance;
  instance.material_base = 1;
  table.begin(assets, 0.0, scales);
  const shared::GpuMaterial plain = entry(instance);
  EXPECT_EQ(vec3(plain.emission), vec3(8, 8, 4));
  EXPECT_EQ(glm::unpackHalf2x16(plain.seen_rg), vec2(1));
  table.begin(assets, 0.0, scales, {}, {}, true);
  const shared::GpuMaterial authored = entry(instance);
  EXPECT_EQ(vec3(authored.emission), vec3(2, 4, 8));
  const vec2 seen = glm::unpackHalf2x16(authored.seen_rg);
  EXPECT_NEAR(authored.emission.x * seen.x, 1.0f, 1e-3f) << "as painted";
  EXPECT_NEAR(authored.emission.y * seen.y, 1.0f, 1e-3f);
  EXPECT_NEAR(authored.emission.z * glm::unpackHalf2x16(authored.seen_b).x, 1.0f, 1e-3f);
  assets.materials[1].cast = vec3(0.0f);
  table.begin(assets, 0.0, scales, {}, {}, true);
  EXPECT_TRUE(std::isfinite(glm::unpackHalf2x16(entry(instance).seen_rg).x)) << "one that casts nothing can be seen";
}

TEST_F(Tables, WhatAStyledTextureLightsPulsesAndItsLookDoesNot) {
  assets.materials[1].cast_style = 5;
  std::array<float, 64> styles = scene::all_styles_of_one();
  scene::Instance instance;
  instance.material_base = 1;
  const auto emission = [&](bool authored) {
    table.begin(assets, 0.0, scales, {}, {}, authored, styles);
    const shared::GpuMaterial m = entry(instance);
    return vec2(m.emission.x, m.emission.x * glm::unpackHalf2x16(m.seen_rg).x);
  };
  const vec2 whole = emission(true), plain = emission(false);
  styles[5] = 0.25f;
  EXPECT_FLOAT_EQ(emission(true).x, 0.25f * whole.x);
  EXPECT_NEAR(emission(true).y, whole.y, 1e-3f * whole.y);
  EXPECT_EQ(emission(false), plain);
  styles[5] = 0.0f;
  EXPECT_TRUE(std::isfinite(emission(true).y));
}

TEST_F(Tables, WhatBeginsOffGlowsWhenItsStyleIsOn) {
  assets.materials[1].cast_style = 33;
  assets.materials[1].switched = true;
  std::array<float, 64> styles = scene::all_styles_of_one();
  scene::Instance instance;
  instance.material_base = 1;
  for (const bool authored : {false, true}) {
    const auto seen_and_cast = [&](float style) {
      styles[33] = style;
      table.begin(assets, 0.0, scales, {}, {}, authored, styles);
      const shared::GpuMaterial m = entry(instance);
      return vec2(m.emission.x * glm::unpackHalf2x16(m.seen_rg).x, m.emission.x);
    };
    const vec2 on = seen_and_cast(1.0f), off = seen_and_cast(0.0f);
    EXPECT_GT(on.x, 0.0f);
    EXPECT_EQ(off.x, 0.0f) << "to the camera, authored " << authored;
    EXPECT_LE(off.y, 2e-3f * on.y);
  }
}

TEST_F(Tables, LavaIsSeenAsPaintedWhereItsAuthorsLightCounts) {
  scene::Material& lava = assets.materials[0];
  lava.base_color = vec3(0.5f);
  lava.emission = vec3(1.0f);
  lava.flags = scene::kMaterialLiquid;
  using Kind = scene::EmissionKind;
  for (const auto& [kind, unlit] : {std::pair{Kind::kLava, true}, std::pair{Kind::kSlime, true},
                                    std::pair{Kind::kTeleport, true}, std::pair{Kind::kNone, false}}) {
    lava.emission_kind = kind;
    table.begin(assets, 0.0, scales);
    EXPECT_EQ(entry({}).base_color.x, 0.5f);
    table.begin(assets, 0.0, scales, {}, {}, true);
    EXPECT_EQ(entry({}).base_color.x, unlit ? 0.0f : 0.5f) << "water has its light";
    EXPECT_EQ(entry({}).base_color.w, lava.alpha);
  }
}

TEST_F(Tables, GlossByNameIsNoAuthors) {
  assets.materials[0].roughness = 0.3f;
  assets.materials[0].specular = 0.04f;
  assets.materials[0].gloss_by_name = true;
  table.begin(assets, 0.0, scales);
  EXPECT_EQ(entry({}).specular, 0.04f);
  table.begin(assets, 0.0, scales, {}, {}, true);
  EXPECT_EQ(entry({}).specular, 0.0f);
  EXPECT_EQ(entry({}).roughness, 1.0f);
  assets.materials[0].frames[0].gloss = 3;
  table.begin(assets, 0.0, scales, {}, {}, true);
  EXPECT_EQ(entry({}).specular, 0.04f) << "a gloss map is";
}

TEST(UsualEmission, IsWhatTheSettingsBeginWith) {
  const EmissionScales scales = emission_scales(RenderSettings());
  for (std::uint32_t kind = 1; kind < shared::kEmissionKinds; ++kind)
    EXPECT_EQ(emission_scale(scales, static_cast<scene::EmissionKind>(kind)),
              scene::usual_emission(static_cast<scene::EmissionKind>(kind)))
        << kind;
}

TEST_F(Tables, LetNewInstancesStandStill) {
  scene::Instance instance;
  instance.prev_transform[3] = vec3(5, 0, 0);
  auto out = make_gpu_instance(mesh, instance, mat4x3(1.0f), 0, 1);
  EXPECT_EQ(out.prev_to_world[0].w, 5.0f);
  EXPECT_EQ(out.flags & shared::kInstanceIsNew, 0u);
  instance.flags = scene::kInstanceNew;
  out = make_gpu_instance(mesh, instance, mat4x3(1.0f), 0, 1);
  EXPECT_EQ(out.prev_to_world[0].w, 0.0f);
  EXPECT_NE(out.flags & shared::kInstanceIsNew, 0u);
}

// What fills a liquid is multiplied where the material says so; by 1 it keeps its bits.
TEST_F(Tables, ThePlayersOpacityIsAFactorOnWhatFillsALiquid) {
  scene::Material& m = assets.materials[0];
  m.flags = scene::kMaterialDielectric | scene::kMaterialLiquid;
  m.absorption = vec3(0.0031f, 0.0017f, 0.0047f);
  m.scattering = 0.0011f;
  const auto filled = [&](scene::OpacityFrom from, scene::LiquidOpacity opacity) {
    m.opacity_from = from;
    table.begin(assets, 0, scales, {.water = true, .scattering = 0.7f}, opacity);
    const shared::GpuMaterial& out = table.entries()[0];
    return vec4(out.extinction_r, out.extinction_g, out.extinction_b, out.scattering);
  };
  using enum scene::OpacityFrom;
  const vec4 own(m.absorption + m.scattering, m.scattering * 0.7f);
  for (const auto from : {kItself, kWater, kSlime}) EXPECT_EQ(filled(from, {}), own);
  EXPECT_EQ(filled(kItself, {0.5f, 0.25f}), own) << "the map or a text has said it";
  EXPECT_EQ(filled(kWater, {0.5f, 0.25f}), own * 0.5f);
  EXPECT_EQ(filled(kSlime, {0.5f, 0.25f}), own * 0.25f);
  EXPECT_EQ(filled(kWater, {0.0f, 1.0f}), vec4(0.0f));
}

// What glows is an interface where it is less than opaque, and by the rest.
TEST_F(Tables, LavaLetsLightInWhereThePlayerWantsIt) {
  scene::Material& m = assets.materials[0];
  m.flags = scene::kMaterialLiquid;
  m.emission_kind = scene::EmissionKind::kLava;
  m.emission = vec3(1.0f);
  m.absorption = vec3(0.01f);
  m.opacity_from = scene::OpacityFrom::kLava;
  const auto resolved = [&](const scene::LiquidOpacity& opacity, bool water) {
    const Interfaces interfaces{.water = water, .scattering = 1.0f};
    EXPECT_EQ(needs_of(assets, mesh, 0, interfaces, opacity).water, opacity.lava < 1.0f);
    table.begin(assets, 0, scales, interfaces, opacity);
    return table.entries()[0];
  };
  const auto is_interface = [](const shared::GpuMaterial& out) {
    return (out.flags & scene::kMaterialDielectric) != 0;
  };
  EXPECT_FALSE(is_interface(resolved({}, true)));
  EXPECT_FALSE(is_interface(resolved({.lava = 0.5f}, false))) << "r_water 0";
  const shared::GpuMaterial half = resolved({.lava = 0.5f}, true);
  EXPECT_TRUE(is_interface(half));
  EXPECT_EQ(half.opaque_share, 0.5f);
  EXPECT_EQ(half.extinction_g, 0.005f);
  EXPECT_EQ(half.emission_kind, shared::kEmissionLava);
  EXPECT_GT(half.emission.x, 0.0f);
}

// A still view begins anew when the water becomes clearer.
TEST_F(Tables, ThePlayersOpacityIsPartOfTheFramesKey) {
  scene::FrameSnapshot snapshot;
  snapshot.assets = std::make_shared<scene::Assets>();
  const std::uint64_t key = scene_key(snapshot);
  EXPECT_EQ(scene_key(snapshot), key);
  snapshot.liquid_opacity.slime = 0.5f;
  EXPECT_NE(scene_key(snapshot), key);
}

TEST_F(Tables, SayWhatMaterialsNeed) {
  assets.materials[1].flags = scene::kMaterialAlphaTest;
  assets.materials[1].metalness = 0.5f;
  MaterialNeeds needs = needs_of(assets, mesh, 0);
  EXPECT_TRUE(needs.known && !needs.alpha_test && !needs.translucent && !needs.specular);
  needs = needs_of(assets, mesh, 1);
  EXPECT_TRUE(needs.known && needs.alpha_test && !needs.translucent && needs.specular);
  EXPECT_FALSE(needs_of(assets, mesh, 2).known);
  EXPECT_FALSE(needs_of(assets, mesh, 0xffffffffu).known);
}

TEST(GpuSceneTables, FeaturesAreOfAllAssetsAndOfTheSky) {
  scene::Assets assets;
  assets.materials.resize(3);
  assets.meshes.resize(1);
  EXPECT_EQ(features_of(assets), 0u);
  assets.materials[1].frames = {{.base = 0}, {.base = 1, .gloss = 2}};
  EXPECT_EQ(features_of(assets), shared::kFeatureDetail);
  assets.materials[2].alternate_frames = {{.base = 0, .luma = 3}};
  assets.materials[2].flags = scene::kMaterialWarp;
  assets.meshes[0].normals.resize(3);
  EXPECT_EQ(features_of(assets),
            shared::kFeatureDetail | shared::kFeatureLuma | shared::kFeatureWarp | shared::kFeatureSmooth);

  scene::Sky sky;
  sky.mode = scene::SkyMode::kConstant;
  EXPECT_EQ(features_of(sky), 0u);
  sky.mode = scene::SkyMode::kBox;
  sky.suns.resize(1);
  EXPECT_EQ(features_of(sky), shared::kFeatureSkyTexture | shared::kFeatureSuns);
}

TEST(InstanceTree, RefersToItsLeavesAsTheDeviceDoes) {
  std::vector<TreeLeaf> leaves;
  for (std::uint32_t i = 0; i < 37; ++i) {
    const vec3 at(static_cast<float>(i * 7 % 11), static_cast<float>(i * 5 % 13), static_cast<float>(i));
    leaves.push_back({shared::kRefLeaf | i, {at, at + 1.0f}});
  }
  const auto nodes = build_instance_tree(leaves, 1000);
  EXPECT_EQ(nodes.size(), leaves.size() - 1);
  std::vector<int> leaf_seen(leaves.size()), node_seen(nodes.size());
  for (const shared::BvhNode& node : nodes) {
    for (std::uint32_t child : {node.child0, node.child1}) {
      if (child >= shared::kRefLeaf)
        ++leaf_seen.at(child & shared::kRefFirstMask);
      else
        ++node_seen.at(child - 1000 + 1);
    }
  }
  EXPECT_EQ(leaf_seen, std::vector<int>(leaves.size(), 1));
  node_seen[0] = 1;  // the root, which nothing refers to
  EXPECT_EQ(node_seen, std::vector<int>(nodes.size(), 1));
  EXPECT_EQ(build_instance_tree({}, 5).size(), 1u);
  EXPECT_EQ(build_instance_tree(std::span(leaves).first(1), 5)[0].child0, leaves[0].ref);
}

}  // namespace
}  // namespace fb::render
