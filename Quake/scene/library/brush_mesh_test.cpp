// Faces to triangles, and textures to materials, on maps built in code.
#include "scene/library/brush_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "scene/library/coincident_faces.h"
#include "scene/library/surface_names.h"
#include "scene/library/test_maps.h"
#include "scene/shapes.h"

namespace fb::scene {
namespace {

using test::MapBuilder;
using test::texture;
using testing::ElementsAre;

struct Built {
  test::TestFiles files;
  std::unique_ptr<AssetBuilder> builder;
  std::unique_ptr<MapMaterials> materials;
  Mesh mesh;
  const Material& material(std::size_t triangle) const {
    return builder->assets().materials[mesh.triangles[triangle].material];
  }
  const Image& base(std::size_t triangle, double time = 0.0, bool alternate = false) const {
    return builder->assets().images[texture_at(material(triangle), time, alternate).base];
  }
};
std::unique_ptr<Built> build(const MapBuilder& map, test::TestFiles files = {}, LiquidAlphas alphas = {},
                             SurfaceLights lights = {}) {
  auto built = std::make_unique<Built>();
  built->files = std::move(files);
  built->files.add_palette();
  built->builder = std::make_unique<AssetBuilder>(built->files.loader());
  built->materials = std::make_unique<MapMaterials>(*built->builder, map.bsp, "m", alphas, std::move(lights));
  built->mesh = make_brush_mesh(map.bsp, 0, *built->materials, "m");
  return built;
}

vec3 normal_of(const Mesh& mesh, const MeshTriangle& t) {
  const vec3 a = mesh.positions[t.vertices[0]];
  return glm::normalize(glm::cross(mesh.positions[t.vertices[1]] - a, mesh.positions[t.vertices[2]] - a));
}

TEST(BrushMesh, FacesTheSideOfItsPlane) {
  MapBuilder map;
  const std::uint32_t t = map.add_texture(texture("wall"));
  map.add_square(0, 0, 0, 64, t, true);
  map.add_square(0, 0, 128, 64, t, false);
  const auto built = build(map);
  const Mesh& mesh = built->mesh;
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(normal_of(mesh, mesh.triangles[0]), vec3(0, 0, 1));
  EXPECT_EQ(normal_of(mesh, mesh.triangles[3]), vec3(0, 0, -1));
  EXPECT_NEAR(mesh_area(mesh), 2 * 64 * 64, 1e-2);
  EXPECT_EQ(mesh.vertex_count, 8u);
  EXPECT_EQ(mesh.bounds.max, vec3(64, 64, 128));
  EXPECT_EQ(built->builder->assets().materials.size(), 1u) << "one material a texture";
  for (const MeshTriangle& triangle : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const vec3 p = mesh.positions[triangle.vertices[k]];
      const vec2 exact(p.x / 16.0f, -p.y / 16.0f), off = triangle.uv[k] - exact;
      EXPECT_EQ(off, glm::floor(off)) << "texture coordinates but for whole repeats";
    }
}

TEST(BrushMesh, CollinearCornersLeaveNoSlivers) {
  MapBuilder map;
  const std::uint32_t t = map.add_texture(texture("wall"));
  map.add_face({{0, 0, 0}, {0, 32, 0}, {0, 64, 0}, {64, 64, 0}, {64, 0, 0}, {32, 0, 0}}, {0, 0, 1}, t);
  const auto built = build(map);
  EXPECT_NEAR(mesh_area(built->mesh), 64 * 64, 1e-2);
  for (const MeshTriangle& triangle : built->mesh.triangles) {
    const vec3 a = built->mesh.positions[triangle.vertices[0]];
    const float area = 0.5f * glm::length(glm::cross(built->mesh.positions[triangle.vertices[1]] - a,
                                                     built->mesh.positions[triangle.vertices[2]] - a));
    EXPECT_GT(area, 100.0f);
  }
}

TEST(BrushMesh, LeavesToolsOutAndKeepsMissingTextures) {
  MapBuilder map;
  map.add_square(0, 0, 0, 64, map.add_texture(texture("skip")));
  map.add_square(64, 0, 0, 64, map.add_texture(texture("TRIGGER")));
  map.add_square(128, 0, 0, 64, formats::kNoTexture);
  map.add_square(192, 0, 0, 64, map.add_texture({"outside", 32, 32, {}}));
  const auto built = build(map);
  ASSERT_EQ(built->mesh.triangles.size(), 4u);
  EXPECT_EQ(built->base(0).name, "missing texture");
  EXPECT_EQ(built->base(3).name, "missing texture");
  EXPECT_EQ(built->material(3).name, "outside");
}

// Upward and downward area of a square whose other side is cut otherwise, and reaches beyond.
std::pair<double, double> area_of_two_sides(const char* name) {
  MapBuilder map;
  const std::uint32_t surface = map.add_texture(texture(name));
  map.add_square(0, 0, 0, 64, surface, true);
  map.add_square(0, 0, 0, 32, surface, false);
  map.add_square(32, 32, 0, 32, surface, false);
  map.add_square(60, 0, 0, 32, surface, false);
  const auto built = build(map);
  double up = 0.0, down = 0.0;
  for (const MeshTriangle& t : built->mesh.triangles) {
    const vec3 a = built->mesh.positions[t.vertices[0]], b = built->mesh.positions[t.vertices[1]],
               c = built->mesh.positions[t.vertices[2]];
    const double z = 0.5 * static_cast<double>(glm::cross(b - a, c - a).z);
    (z > 0 ? up : down) += std::fabs(z);
  }
  return {up, down};
}

TEST(BrushMesh, LiquidsAndSkiesHaveOneSurface) {
  for (const char* name : {"*water1", "sky1"}) {
    const auto [up, down] = area_of_two_sides(name);
    EXPECT_NEAR(up, 64 * 64, 0.1) << name;
    EXPECT_NEAR(down, 28 * 32, 0.1) << name;
  }
  const auto [up, down] = area_of_two_sides("wall");
  EXPECT_NEAR(up, 64 * 64, 0.1);
  EXPECT_NEAR(down, 3 * 32 * 32, 0.1);
}

// Where nothing coincides triangles are in the order of the map's faces.
TEST(BrushMesh, SkiesStayInTheirPlace) {
  MapBuilder map;
  map.add_square(0, 0, 0, 64, map.add_texture(texture("sky1")));
  map.add_square(64, 0, 0, 64, map.add_texture(texture("wall")));
  const auto built = build(map);
  ASSERT_EQ(built->mesh.triangles.size(), 4u);
  EXPECT_EQ(built->material(0).name, "sky1");
  EXPECT_EQ(built->material(3).name, "wall");
}

// A texel of 32 by 32 textures covers 1, 2 or 4 units; liquids repeat every 64, and twice or four times that if they
// are lit.
TEST(BrushMesh, Quake64TexturesAreDrawnAsLargeAsTheirShiftSays) {
  const auto repeats = [](const char* name, int shift, std::uint32_t flags) {
    MapBuilder map;
    map.bsp.version = formats::BspVersion::kQuake64;
    formats::BspTexture t = texture(name, 10, 32, 32);
    t.shift = shift;
    map.add_square(0, 0, 0, 64, map.add_texture(t));
    map.bsp.texinfos[0].flags = flags;
    const auto built = build(map);
    float least = 1e9f, most = -1e9f;
    for (const MeshTriangle& triangle : built->mesh.triangles)
      for (const vec2& uv : triangle.uv) {
        least = std::min(least, uv.x);
        most = std::max(most, uv.x);
      }
    return most - least;
  };
  EXPECT_EQ(repeats("wall", 0, 0), 2.0f);
  EXPECT_EQ(repeats("wall", 1, 0), 1.0f);
  EXPECT_EQ(repeats("wall", 2, 0), 0.5f);
  EXPECT_EQ(repeats("*water", 0, formats::kTexSpecial), 1.0f);
  EXPECT_EQ(repeats("*water", 2, formats::kTexSpecial), 1.0f);
  EXPECT_EQ(repeats("*water", 2, 0), 0.25f);
}

TEST(CoincidentFaces, Subtraction) {
  const std::vector<vec3> a{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  const std::vector<vec3> hole{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  const std::vector<vec3> beside{{4, 0, 0}, {8, 0, 0}, {8, 4, 0}, {4, 4, 0}};
  const auto area = [](const std::vector<std::vector<vec3>>& parts) {
    double sum = 0.0;
    for (const auto& part : parts) sum += polygon_area(part);
    return sum;
  };
  EXPECT_NEAR(area(subtract_polygon(a, hole, {0, 0, 1}, 0.01f)), 15.0, 1e-5);
  EXPECT_EQ(subtract_polygon(a, beside, {0, 0, 1}, 0.01f).size(), 1u);
  EXPECT_NEAR(area(subtract_polygon(a, beside, {0, 0, 1}, 0.01f)), 16.0, 1e-5);
  EXPECT_TRUE(subtract_polygon(hole, a, {0, 0, 1}, 0.01f).empty());
}

TEST(MapMaterials, LiquidsSkyAndHoles) {
  MapBuilder map;
  const char* names[] = {"*lava1", "*SLIME", "*teleport", "*04water", "sky1", "{fence", "lamp", "wall"};
  float x = 0;
  for (const char* name : names) {
    map.add_square(x, 0, x, 64, map.add_texture(texture(name, std::string_view(name) == "lamp" ? 230 : 10)));
    x += 64;
  }
  const auto built = build(map, {}, {0.5f, 0.6f, 0.7f, 0.8f});
  std::map<std::string, const Material*> by_name;
  for (const Material& material : built->builder->assets().materials) by_name[material.name] = &material;
  EXPECT_EQ(by_name.at("*lava1")->emission_kind, EmissionKind::kLava);
  EXPECT_EQ(by_name.at("*SLIME")->emission_kind, EmissionKind::kSlime);
  EXPECT_EQ(by_name.at("*teleport")->emission_kind, EmissionKind::kTeleport);
  EXPECT_EQ(by_name.at("*04water")->emission_kind, EmissionKind::kNone);
  EXPECT_FLOAT_EQ(by_name.at("*04water")->alpha, 0.5f);
  EXPECT_FLOAT_EQ(by_name.at("*lava1")->alpha, 0.6f);
  EXPECT_FLOAT_EQ(by_name.at("*teleport")->alpha, 0.8f);
  EXPECT_EQ(by_name.at("*lava1")->flags, kMaterialWarp | kMaterialLiquid | kMaterialDielectric) << "light gets in";
  EXPECT_EQ(by_name.at("sky1")->emission_kind, EmissionKind::kSky);
  EXPECT_EQ(by_name.at("{fence")->flags, kMaterialAlphaTest);
  EXPECT_EQ(by_name.at("lamp")->emission_kind, EmissionKind::kFullbright);
  EXPECT_EQ(by_name.at("wall")->emission_kind, EmissionKind::kNone);
  EXPECT_EQ(by_name.at("wall")->flags, 0u);
  EXPECT_EQ(by_name.at("wall")->roughness, 1.0f);
  EXPECT_EQ(by_name.at("wall")->specular, 0.0f);
}

TEST(MapMaterials, LiquidsAreAsOpaqueAsTheMapOrElseThePlayerSays) {
  MapBuilder map;
  map.add_square(0, 0, 0, 64, map.add_texture(texture("*water", 10)));
  map.add_square(64, 0, 0, 64, map.add_texture(texture("*slime", 10)));
  map.add_square(128, 0, 0, 64, map.add_texture(texture("*lava", 10)));
  const auto from = [&](const LiquidAlphas& alphas, test::TestFiles files = {}) {
    const auto built = build(map, std::move(files), alphas);
    return std::array{built->material(0).opacity_from, built->material(2).opacity_from,
                      built->material(4).opacity_from};
  };
  using enum OpacityFrom;
  EXPECT_THAT(from({}), ElementsAre(kWater, kSlime, kLava));
  EXPECT_THAT(from({0.5f, {}, {}, {}}), ElementsAre(kItself, kSlime, kLava));
  EXPECT_THAT(from({1.0f, {}, 0.3f, {}}), ElementsAre(kItself, kItself, kLava));
  EXPECT_THAT(from({{}, 0.5f, {}, {}}), ElementsAre(kWater, kSlime, kItself));
  test::TestFiles files;
  constexpr std::string_view kText = "index 1.33\n";
  files.files["textures/#water.mat"] = Bytes(kText.begin(), kText.end());
  EXPECT_THAT(from({}, files), ElementsAre(kItself, kSlime, kLava)) << "a text names what fills it";
  // A map's alpha is the factor that the player's would be.
  const auto plain = build(map), half = build(map, {}, {0.5f, {}, {}, {}});
  for (int i = 0; i < 3; ++i) EXPECT_FLOAT_EQ(half->material(0).absorption[i], 0.5f * plain->material(0).absorption[i]);
  EXPECT_FLOAT_EQ(half->material(0).scattering, 0.5f * plain->material(0).scattering);
}

// What is left of white light after `depth` in it, by what is neither absorbed nor scattered.
double luminance_left(const LiquidMedium& medium, double depth) {
  const double weights[] = {0.2126, 0.7152, 0.0722};
  double left = 0.0;
  for (int i = 0; i < 3; ++i)
    left += weights[i] * std::exp(-depth * static_cast<double>(medium.absorption[i] + medium.scattering));
  return left;
}

TEST(LiquidMedium, GreyLeavesHalfOfTheLightAtItsDepth) {
  for (const float grey : {0.0f, 0.05f, 0.5f, 1.0f})
    for (const float alpha : {0.1f, 0.5f, 1.0f})
      for (const float scatters : {0.0f, kWaterScatters, kSlimeScatters}) {
        const LiquidMedium medium = liquid_medium(vec3(grey), alpha, scatters);
        EXPECT_NEAR(luminance_left(medium, kLiquidHalfDepth / alpha), 0.5, 1e-5) << grey << " " << alpha;
        const float extinction = medium.absorption.x + medium.scattering;
        EXPECT_NEAR(medium.scattering, scatters * extinction, 1e-7f);
        EXPECT_FLOAT_EQ(medium.absorption.y, medium.absorption.x);
        EXPECT_FLOAT_EQ(medium.absorption.z, medium.absorption.x);
      }
}

// Of coloured ones the mean of the exponents is ln 2, so that at least half is left (Jensen), and not much more.
TEST(LiquidMedium, ColoursLeaveAtLeastHalfAndALittleMore) {
  double least = 1.0, most = 0.0;
  for (int i = 0; i < 9 * 9 * 9; ++i) {
    const vec3 color(static_cast<float>(i % 9) / 8.0f, static_cast<float>(i / 9 % 9) / 8.0f,
                     static_cast<float>(i / 81) / 8.0f);
    const LiquidMedium medium = liquid_medium(color, 0.5f, kWaterScatters);
    const double left = luminance_left(medium, kLiquidHalfDepth / 0.5);
    least = std::min(least, left);
    most = std::max(most, left);
    for (int channel = 0; channel < 3; ++channel) EXPECT_GE(medium.absorption[channel], 0.0f);
    if (color.y > color.x) {
      EXPECT_LT(medium.absorption.y, medium.absorption.x) << "what it shows is lost later";
    }
  }
  EXPECT_NEAR(least, 0.5, 1e-5);
  EXPECT_GT(most, 0.51);
  EXPECT_LT(most, 0.515) << "media.md says so";
}

TEST(MapMaterials, AnimationSequencesAreShared) {
  MapBuilder map;
  const std::uint32_t zero = map.add_texture(texture("+0lamp", 10)), b = map.add_texture(texture("+blamp", 21)),
                      one = map.add_texture(texture("+1lamp", 11)), a = map.add_texture(texture("+alamp", 20)),
                      three = map.add_texture(texture("+3lamp", 13)), other = map.add_texture(texture("+0wall", 30));
  (void)b;
  float x = 0;
  for (std::uint32_t t : {one, a, three, other, zero}) map.add_square(x += 64, 0, 0, 64, t);
  const auto built = build(map);
  const auto& triangles = built->mesh.triangles;
  EXPECT_EQ(triangles[0].material, triangles[4].material) << "any frame of a sequence is the sequence";
  EXPECT_EQ(triangles[0].material, triangles[8].material);
  EXPECT_NE(triangles[0].material, triangles[2].material);
  EXPECT_NE(triangles[0].material, triangles[6].material);
  EXPECT_EQ(built->base(0, 0.1).texels[0], 10);
  EXPECT_EQ(built->base(0, 0.3).texels[0], 11);
  EXPECT_EQ(built->base(0, 0.5).texels[0], 13) << "a missing frame is passed over";
  EXPECT_EQ(built->base(0, 0.7).texels[0], 10);
  EXPECT_EQ(built->base(0, 0.1, true).texels[0], 20);
  EXPECT_EQ(built->base(0, 0.3, true).texels[0], 21);
  EXPECT_EQ(built->base(2, 0.3).texels[0], 21) << "a face of the alternate sequence starts with it";
  EXPECT_EQ(built->base(2, 0.3, true).texels[0], 11);
  EXPECT_EQ(built->base(6, 0.3, true).texels[0], 30) << "no alternates";
}

// Quake 64's maps call textures so that are not animated: frames are missing.
TEST(MapMaterials, Quake64SequencesThatLackAFrameStandStill) {
  for (const bool complete : {false, true}) {
    MapBuilder map;
    map.bsp.version = formats::BspVersion::kQuake64;
    map.add_square(0, 0, 0, 64, map.add_texture(texture("+0lamp", 1)));
    map.add_square(64, 0, 0, 64, map.add_texture(texture("+2lamp", 3)));
    if (complete) map.add_texture(texture("+1lamp", 2));
    const auto built = build(map);
    EXPECT_EQ(built->material(0).frames.size(), complete ? 3u : 1u);
    EXPECT_EQ(built->base(2).texels[0], complete ? 1 : 3);
    EXPECT_EQ(built->base(2, 0.4).texels[0], 3) << "five frames a second";
    EXPECT_EQ(built->mesh.triangles[0].material == built->mesh.triangles[2].material, complete);
  }
}

TEST(MapMaterials, ATextNamesGlass) {
  MapBuilder map;
  float z = 0;
  for (const char* name : {"pane", "wrong", "*water1", "*lava1", "plain"})
    map.add_square(0, 0, z += 64, 64, map.add_texture(texture(name, 100)));
  test::TestFiles files;
  const auto add_text = [&](const std::string& path, std::string_view text) {
    files.files[path] = Bytes(text.begin(), text.end());
  };
  add_text("textures/m/pane.mat", "index 1.5\ncolor 0.5 1 1\ndistance 10");
  add_text("textures/pane.mat", "index 2");
  add_text("textures/wrong.mat", "index 1.5 7");
  add_text("textures/#water1.mat", "index 1.4");
  add_text("textures/#lava1.mat", "index 1.4");
  const auto built = build(map, files);
  std::map<std::string, const Material*> by_name;
  for (const Material& material : built->builder->assets().materials) by_name[material.name] = &material;
  EXPECT_EQ(by_name.at("pane")->flags, kMaterialDielectric);
  EXPECT_FLOAT_EQ(by_name.at("pane")->index, 1.5f);
  EXPECT_NEAR(by_name.at("pane")->absorption.x, std::log(2.0f) / 10, 1e-6);
  for (const char* name : {"wrong", "*lava1", "plain"})
    EXPECT_EQ(by_name.at(name)->flags & kMaterialDielectric, 0u) << name;
  EXPECT_FLOAT_EQ(by_name.at("*water1")->index, 1.4f);
  EXPECT_EQ(by_name.at("*water1")->absorption, vec3(0.0f)) << "the text's, not the texture's";
  EXPECT_EQ(by_name.at("*water1")->scattering, 0.0f) << "likewise";
}

TEST(MapMaterials, ReplacementOrder) {
  MapBuilder map;
  float z = 0;
  for (const char* name : {"both", "general", "*lava", "lamp", "none"})
    map.add_square(0, 0, z += 64, 64, map.add_texture(texture(name, 230)));
  test::TestFiles files;
  files.add_tga("textures/both.tga", 2, 2, {1, 1, 1});
  files.add_tga("textures/m/both.tga", 2, 2, {2, 2, 2});
  files.add_tga("textures/both_luma.tga", 2, 2, {3, 3, 3});  // not beside the one that is used
  files.add_tga("textures/m/both_glow.tga", 2, 2, {4, 4, 4});
  files.add_tga("textures/m/both_norm.tga", 2, 2, {128, 128, 255});
  files.add_tga("textures/m/both_gloss.tga", 2, 2, {99, 0, 0});
  files.add_tga("textures/general.tga", 2, 2, {5, 5, 5});
  files.add_tga("textures/#lava.tga", 2, 2, {6, 6, 6});
  files.add_tga("textures/lamp.tga", 2, 2, {7, 7, 7});
  files.files["textures/none.tga"] = {1, 2, 3};  // malformed
  const auto built = build(map, files);
  const std::vector<Image>& images = built->builder->assets().images;
  std::map<std::string, const Material*> by_name;
  for (const Material& material : built->builder->assets().materials) by_name[material.name] = &material;
  const TextureSet& both = by_name.at("both")->frames[0];
  EXPECT_EQ(images[both.base].name, "textures/m/both.tga");
  EXPECT_EQ(images[both.base].encoding, ImageEncoding::kSrgba);
  EXPECT_EQ(images[both.luma].texels[0], 4);
  EXPECT_EQ(images[both.normal].encoding, ImageEncoding::kLinearRgba);
  EXPECT_EQ(images[both.gloss].texels[0], 99);
  EXPECT_GT(by_name.at("both")->specular, 0.0f);
  EXPECT_EQ(images[by_name.at("general")->frames[0].base].texels[0], 5);
  EXPECT_EQ(images[by_name.at("*lava")->frames[0].base].texels[0], 6);
  EXPECT_EQ(by_name.at("*lava")->emission_kind, EmissionKind::kLava);
  const TextureSet& lamp = by_name.at("lamp")->frames[0];
  EXPECT_EQ(images[lamp.base].texels[0], 7);
  ASSERT_NE(lamp.luma, kNone) << "the original's glowing texels stay";
  EXPECT_EQ(images[lamp.luma].texels[0], 255);
  EXPECT_EQ(images[by_name.at("none")->frames[0].base].encoding, ImageEncoding::kPalette);
}

TEST(MapMaterials, SurfaceLightsGlow) {
  MapBuilder map;
  map.add_square(0, 0, 0, 64, map.add_texture(texture("Panel", 200)));
  map.add_square(0, 0, 64, 64, map.add_texture(texture("*lava1", 200)));
  const auto built = build(map, {}, {}, {{"panel", {vec3(2, 1, 0)}}, {"*lava1", {vec3(9)}}});
  for (const Material& material : built->builder->assets().materials) {
    if (material.name == "*lava1") {
      EXPECT_EQ(material.emission_kind, EmissionKind::kLava);
      EXPECT_EQ(material.emission, vec3(1.0f));
    } else {
      EXPECT_EQ(material.emission_kind, EmissionKind::kFullbright);
      EXPECT_EQ(material.frames[0].luma, material.frames[0].base) << "all texels glow";
      // Factor times the texel's colour is the radiance.
      EXPECT_NEAR(material.emission.x * linear_from_srgb(std::uint8_t{200}), 2.0f, 1e-4f);
      EXPECT_EQ(material.emission.z, 0.0f);
    }
  }
}

TEST(SurfaceNames, Looks) {
  EXPECT_GT(surface_look("MET_brn_flat").specular, 0.0f);
  EXPECT_LT(surface_look("*water0").roughness, 0.5f);
  EXPECT_EQ(surface_look("rock12").specular, 0.0f);
  EXPECT_EQ(animated_name("+9x")->frame, 9);
  EXPECT_EQ(animated_name("+Jx")->frame, 9);
  EXPECT_FALSE(animated_name("+kx"));
  EXPECT_FALSE(animated_name("+"));
}

}  // namespace
}  // namespace fb::scene
