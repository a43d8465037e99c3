// Alias models and sprites built in code: winding, normals, seams, skins, quads.
#include "scene/library/alias_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/library/sprite_mesh.h"
#include "scene/library/test_maps.h"
#include "scene/shapes.h"
#include "shared/packing.h"

namespace fb::scene {
namespace {

// A box from 0 to 100 in bytes (scale 0.5, so 50 units), its triangles clockwise from outside as files have them. Every
// corner is there twice, on and off the seam. The second pose is twice as high.
formats::Mdl box_model() {
  formats::Mdl mdl;
  mdl.scale = vec3(0.5f);
  mdl.origin = vec3(-25.0f);
  mdl.skin_width = 64;
  mdl.skin_height = 32;
  mdl.pose_count = 2;
  mdl.vertex_count = 16;
  for (int pose = 0; pose < 2; ++pose)
    for (int i = 0; i < 16; ++i) {
      const auto at = [&](int bit, int size) { return static_cast<std::uint8_t>((i >> bit) & 1 ? size : 0); };
      mdl.vertices.push_back({at(0, 100), at(1, 100), at(2, pose == 0 ? 100 : 200), 0});
    }
  for (int i = 0; i < 16; ++i) mdl.tex_coords.push_back({i >= 8, 4 * (i % 8), 2 * (i % 8)});
  // For each axis two faces; u x v is along the axis.
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3, w = 1u << axis;
    const std::uint32_t second = axis == 0 ? 8 : 0;
    mdl.triangles.push_back({true, {w + second, w + u + v + second, w + u + second}});
    mdl.triangles.push_back({true, {w, w + v, w + u + v}});
    mdl.triangles.push_back({false, {0 + second, u + second, u + v + second}});
    mdl.triangles.push_back({false, {0, u + v, v}});
  }
  mdl.triangles.push_back({true, {1, 1, 2}});
  mdl.triangles.push_back({true, {1, 9, 2}});
  mdl.frames = {{"a", 0, 1, {}}, {"b", 1, 1, {}}};
  mdl.skins = {{{{64, 32, std::vector<std::uint8_t>(64 * 32, 10)}}, {}}};
  return mdl;
}

vec3 normal_at(const Mesh& mesh, std::uint32_t pose, std::uint32_t vertex) {
  const PoseVertex& v = mesh.poses[pose * mesh.vertex_count + vertex];
  return shared::unpack_direction(static_cast<std::uint16_t>(v.normal_u) |
                                  static_cast<std::uint32_t>(static_cast<std::uint16_t>(v.normal_v)) << 16u);
}

TEST(AliasMesh, FacesOutward) {
  const Mesh mesh = make_alias_mesh(box_model(), "box");
  EXPECT_EQ(mesh.triangles.size(), 12u) << "triangles that are lines are left out";
  EXPECT_EQ(mesh.pose_count, 2u);
  EXPECT_NEAR(mesh_volume(mesh, 0), 50.0 * 50.0 * 50.0, 1.0);
  EXPECT_NEAR(mesh_volume(mesh, 1), 50.0 * 50.0 * 100.0, 1.0);
  EXPECT_EQ(mesh.bounds.min, vec3(-25));
  EXPECT_EQ(mesh.bounds.max, vec3(25, 25, 75));
}

TEST(AliasMesh, NormalsAreSmoothAndOutward) {
  const Mesh mesh = make_alias_mesh(box_model(), "box");
  for (std::uint32_t pose = 0; pose < 2; ++pose)
    for (std::uint32_t v = 0; v < 8; ++v) {
      const vec3 expected = glm::normalize(vec3(v & 1 ? 1 : -1, v & 2 ? 1 : -1, v & 4 ? 1 : -1));
      // Three right angles at every corner, whatever the box's height; the twins on the seam share them only where
      // they do not face away from each other.
      EXPECT_GT(glm::dot(normal_at(mesh, pose, v), expected), 0.75f) << pose << " " << v;
    }
}

TEST(AliasMesh, NormalsAreDirectionsWhateverTheScale) {
  for (const float scale : {1e-30f, 1e10f, 1e20f, 3e36f}) {
    formats::Mdl mdl = box_model();
    mdl.scale = vec3(scale);
    const Mesh mesh = make_alias_mesh(mdl, "box");
    for (std::uint32_t v = 0; v < 8; ++v) EXPECT_NEAR(glm::length(normal_at(mesh, 0, v)), 1.0f, 1e-3f) << scale;
  }
}

TEST(AliasMesh, SeamMovesBackFacingCorners) {
  const formats::Mdl mdl = box_model();
  const Mesh mesh = make_alias_mesh(mdl, "box");
  int moved = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[i].vertices[k];
      const formats::MdlTexCoord& t = mdl.tex_coords[v];
      const bool shifted = t.on_seam && !mdl.triangles[i].faces_front;
      moved += shifted;
      EXPECT_NEAR(mesh.triangles[i].uv[k].x, (static_cast<float>(t.s) + 0.5f) / 64.0f + (shifted ? 0.5f : 0.0f), 1e-6f);
      EXPECT_NEAR(mesh.triangles[i].uv[k].y, (static_cast<float>(t.t) + 0.5f) / 32.0f, 1e-6f);
    }
  EXPECT_EQ(moved, 3);
}

TEST(AliasMesh, Sheets) {
  // Two triangles back to back on the same vertices: normals cancel, and are still unit vectors.
  formats::Mdl mdl;
  mdl.scale = vec3(1.0f);
  mdl.origin = vec3(0.0f);
  mdl.skin_width = mdl.skin_height = 8;
  mdl.pose_count = 1;
  mdl.vertex_count = 3;
  mdl.vertices = {{0, 0, 0, 0}, {10, 0, 0, 0}, {0, 10, 0, 0}};
  mdl.tex_coords.resize(3);
  mdl.triangles = {{true, {0, 1, 2}}, {true, {0, 2, 1}}};
  const Mesh mesh = make_alias_mesh(mdl, "sheet");
  for (std::uint32_t v = 0; v < 3; ++v) EXPECT_NEAR(std::fabs(normal_at(mesh, 0, v).z), 1.0f, 1e-4f);
}

TEST(Skins, GroupsHolesAndReplacements) {
  test::TestFiles files;
  files.add_palette();
  files.add_tga("progs/box.mdl_1.tga", 4, 4, {9, 9, 9});
  AssetBuilder builder(files.loader());
  formats::Mdl mdl = box_model();
  const formats::IndexedImage dark{64, 32, std::vector<std::uint8_t>(64 * 32, 10)};
  const formats::IndexedImage bright{64, 32, std::vector<std::uint8_t>(64 * 32, 240)};
  mdl.skins = {{{dark, bright}, {0.2f, 0.5f}}, {{dark}, {}}, {{dark}, {}}};
  mdl.flags = formats::kMdlHoley;
  const std::vector<std::uint32_t> skins = make_skin_materials(builder, mdl, "progs/box.mdl");
  ASSERT_EQ(skins.size(), 3u);
  const Material& group = builder.assets().materials[skins[0]];
  EXPECT_EQ(group.emission_kind, EmissionKind::kFullbright);
  EXPECT_EQ(group.flags, kMaterialClampTexture | kMaterialAlphaTest);
  EXPECT_EQ(builder.assets().images[texture_at(group, 0.3, false).base].texels[0], 240);
  EXPECT_EQ(builder.assets().images[texture_at(group, 0.6, false).base].texels[0], 10);
  const Material& replaced = builder.assets().materials[skins[1]];
  EXPECT_EQ(builder.assets().images[replaced.frames[0].base].texels[0], 9);
  EXPECT_EQ(replaced.emission_kind, EmissionKind::kNone);
}

TEST(Skins, GlossAndReliefGoWithTheSkinsOwnColours) {
  test::TestFiles files;
  files.add_palette();
  files.add_tga("progs/box.mdl_0_gloss.tga", 4, 4, {200, 200, 200});
  files.add_tga("progs/box.mdl_0_norm.tga", 4, 4, {128, 128, 255});
  files.add_tga("progs/box.mdl_0_luma.tga", 4, 4, {255, 255, 255});  // belongs to an image that is not there
  AssetBuilder builder(files.loader());
  formats::Mdl mdl = box_model();
  mdl.skins.push_back(mdl.skins[0]);
  const std::vector<std::uint32_t> skins = make_skin_materials(builder, mdl, "progs/box.mdl");
  const Material& coated = builder.assets().materials[skins[0]];
  const TextureSet& set = coated.frames[0];
  EXPECT_EQ(builder.assets().images[set.base].encoding, ImageEncoding::kPalette);
  ASSERT_NE(set.gloss, kNone);
  ASSERT_NE(set.normal, kNone);
  EXPECT_EQ(set.luma, kNone);
  EXPECT_THAT(builder.assets().images[set.gloss].texels, testing::Each(200));
  EXPECT_EQ(builder.assets().images[set.gloss].texels.size(), 16u) << "red alone is kept";
  EXPECT_FLOAT_EQ(coated.specular, 0.04f);
  const Material& plain = builder.assets().materials[skins[1]];
  EXPECT_EQ(plain.frames[0].gloss, kNone);
  EXPECT_FLOAT_EQ(plain.specular, 0.0f);
}

TEST(Skins, ATextNamesGlass) {
  test::TestFiles files;
  files.add_palette();
  const std::string_view text = "index 1.7";
  files.files["progs/box.mdl_1.mat"] = Bytes(text.begin(), text.end());
  AssetBuilder builder(files.loader());
  formats::Mdl mdl = box_model();
  mdl.skins.push_back(mdl.skins[0]);
  const std::vector<std::uint32_t> skins = make_skin_materials(builder, mdl, "progs/box.mdl");
  EXPECT_EQ(builder.assets().materials[skins[0]].flags & kMaterialDielectric, 0u);
  EXPECT_EQ(builder.assets().materials[skins[1]].flags & kMaterialDielectric, kMaterialDielectric);
  EXPECT_FLOAT_EQ(builder.assets().materials[skins[1]].index, 1.7f);
}

TEST(Sprites, ReadRightlyFromTheFront) {
  test::TestFiles files;
  files.add_palette();
  AssetBuilder builder(files.loader());
  formats::Spr spr;
  const formats::SprImage image{-8, 12, {16, 24, std::vector<std::uint8_t>(16 * 24, 7)}};
  spr.frames = {{{image}, {}}, {{image, image}, {0.1f, 0.2f}}};
  const auto frames = make_sprite_frames(builder, spr, "progs/s.spr");
  ASSERT_EQ(frames.size(), 2u);
  ASSERT_EQ(frames[1].meshes.size(), 2u);
  EXPECT_EQ(builder.assets().materials[frames[1].material + 1].name, "progs/s.spr_1_1");
  const Mesh& mesh = builder.assets().meshes[frames[0].meshes[0]];
  EXPECT_EQ(mesh.bounds.min, vec3(0, -8, -12));
  EXPECT_EQ(mesh.bounds.max, vec3(0, 8, 12));
  for (const MeshTriangle& t : mesh.triangles) {
    const vec3 a = mesh.positions[t.vertices[0]];
    EXPECT_GT(glm::cross(mesh.positions[t.vertices[1]] - a, mesh.positions[t.vertices[2]] - a).x, 0.0f);
    for (std::size_t k = 0; k < 3; ++k) {
      const vec3 p = mesh.positions[t.vertices[k]];
      EXPECT_FLOAT_EQ(t.uv[k].x, (p.y + 8) / 16);
      EXPECT_FLOAT_EQ(t.uv[k].y, (12 - p.z) / 24);
    }
  }
}

}  // namespace
}  // namespace fb::scene
