// .md5mesh and .md3 in the place of .mdl: which counts, poses, skins of surfaces, frames, colours of players, and what
// is said of those that are wrong.
#include "scene/library/enhanced_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/log.h"
#include "formats/test_files.h"
#include "formats/test_models.h"
#include "formats/test_posed_models.h"
#include "scene/library/test_maps.h"
#include "scene/shapes.h"

namespace fb::scene {
namespace {

using formats::testing::small_md3;
using formats::testing::small_md5anim;
using formats::testing::small_md5mesh;
using testing::HasSubstr;

class Said {
 public:
  Said() {
    handle_ = add_log_listener([this](LogLevel, std::string_view line) { lines.emplace_back(line); });
  }
  ~Said() { remove_log_listener(handle_); }
  std::vector<std::string> lines;

 private:
  int handle_;
};

Bytes text_bytes(const std::string& text) { return Bytes(text.begin(), text.end()); }
Bytes plain_picture(std::uint8_t index) {
  return formats::testing::write_lmp({2, 2, std::vector<std::uint8_t>(4, index)});
}

// Of three poses in two frames.
formats::Mdl thing() {
  formats::Mdl mdl = formats::testing::tetrahedron();
  for (std::size_t i = 0; i < mdl.vertices.size(); ++i) {
    const auto at = [&](std::size_t corner) {
      return static_cast<std::uint8_t>(i % mdl.vertex_count == corner ? 9 : 0);
    };
    mdl.vertices[i] = {at(1), at(2), at(3), 0};
  }
  return mdl;
}

struct Enhanced : testing::Test {
  Enhanced() {
    files.add_palette();
    files.files["progs/thing.mdl"] = formats::testing::write_mdl(thing());
  }
  void add_md5() {
    files.files["progs/thing.md5mesh"] = text_bytes(small_md5mesh());
    files.files["progs/thing.md5anim"] = text_bytes(small_md5anim());
    files.files["progs/thing_00_00.lmp"] = plain_picture(20);
  }
  vec3 position(const ModelLibrary& library, const Model& model, std::uint32_t pose, std::uint32_t vertex) const {
    return vertex_position(library.assets()->meshes[model.mesh], vertex, pose);
  }
  // What is shown of a model.
  static Mesh mesh_of(ModelLibrary& library, std::string_view name) {
    const std::uint32_t mesh = library.model(name).mesh;
    return mesh == kNone ? Mesh() : library.assets()->meshes[mesh];
  }
  test::TestFiles files;
};

TEST_F(Enhanced, AnMd5StandsInTheMdlsPlace) {
  add_md5();
  ModelLibrary library(files.loader());
  const Model& model = library.model("progs/thing.mdl");
  ASSERT_EQ(model.kind, ModelKind::kAlias);
  EXPECT_EQ(model.name, "progs/thing.mdl");
  EXPECT_EQ(model.flags, thing().flags);
  const Mesh& mesh = library.assets()->meshes[model.mesh];
  EXPECT_EQ(mesh.pose_count, 3u);
  EXPECT_GT(mesh_volume(mesh, 0), 0.0) << "it faces outward";
  // Within half a step of what the joints say.
  EXPECT_NEAR(glm::distance(position(library, model, 1, 3), vec3(0, 5, 15)), 0.0f, 0.03f);
  EXPECT_NEAR(glm::distance(position(library, model, 2, 3), vec3(1, 2, 23)), 0.0f, 0.03f);
  ASSERT_EQ(model.skin_materials.size(), 1u);
  const Material& skin = library.assets()->materials[model.skin_materials[0]];
  EXPECT_EQ(library.assets()->images[skin.frames.at(0).base].name, "progs/thing_00_00.lmp");
  EXPECT_EQ(skin.emission_kind, EmissionKind::kNone);
  EXPECT_FALSE(model.glows);
}

TEST_F(Enhanced, NotWhereItIsOffOrRanksLower) {
  add_md5();
  ModelLibrary off(files.loader());
  off.set_enhanced_models(false);
  EXPECT_EQ(mesh_of(off, "progs/thing.mdl").name, "progs/thing.mdl");
  off.clear();
  EXPECT_EQ(mesh_of(off, "progs/thing.mdl").name, "progs/thing.mdl") << "still off";
  // A mod's own .mdl is not replaced by the base game's .md5mesh.
  ModelLibrary mod(files.loader(), [](std::string_view path) { return path.ends_with(".mdl") ? 1 : 0; });
  EXPECT_EQ(mesh_of(mod, "progs/thing.mdl").name, "progs/thing.mdl");
  ModelLibrary other(files.loader(), [](std::string_view path) { return path.ends_with(".mdl") ? 0 : 1; });
  EXPECT_EQ(mesh_of(other, "progs/thing.mdl").name, "progs/thing.md5mesh");
}

TEST_F(Enhanced, SkinsAreNumbered) {
  add_md5();
  files.files["progs/thing_01_00.lmp"] = plain_picture(30);
  files.files["progs/thing_01_01.lmp"] = plain_picture(230);
  files.add_tga("progs/thing_02_00.tga", 2, 2, {9, 9, 9});
  files.add_tga("progs/thing_02_00_glow.tga", 2, 2, {200, 9, 9});
  ModelLibrary library(files.loader());
  const Model& model = library.model("progs/thing.mdl");
  ASSERT_EQ(model.skin_materials.size(), 3u);
  const Assets& assets = *library.assets();
  const Material &second = assets.materials[model.skin_materials[1]],
                 &third = assets.materials[model.skin_materials[2]];
  ASSERT_EQ(second.frames.size(), 2u);
  EXPECT_EQ(assets.images[texture_at(second, 0.15, false).base].name, "progs/thing_01_01.lmp");
  EXPECT_EQ(second.emission_kind, EmissionKind::kFullbright) << "an index of its second image glows";
  EXPECT_EQ(assets.images[third.frames.at(0).luma].name, "progs/thing_02_00_glow.tga");
  EXPECT_TRUE(model.glows);
}

TEST_F(Enhanced, SurfacesOfAnMd3HaveMaterialsOfTheirOwn) {
  files.files["progs/thing.md3"] = small_md3({"body", "head"});
  files.files["progs/body.lmp"] = plain_picture(16 + 3);
  files.add_tga("textures/head_0.tga", 2, 2, {9, 9, 9});
  files.add_tga("progs/head_1.tga", 2, 2, {8, 8, 8});
  ModelLibrary library(files.loader());
  const Model& model = library.model("progs/thing.mdl");
  const Mesh& mesh = library.assets()->meshes[model.mesh];
  ASSERT_EQ(mesh.triangles.size(), 8u);
  EXPECT_EQ(mesh.triangles.front().material, 0u);
  EXPECT_EQ(mesh.triangles.back().material, 1u);
  EXPECT_NEAR(mesh_volume(mesh, 0), 2.0 * 12.0 * 14.0 / 2.0 * 20.0 / 3.0, 5.0);
  ASSERT_EQ(model.surface_count, 2u);
  ASSERT_EQ(model.skin_materials.size(), 2u);
  const auto image = [&](std::uint32_t skin, std::uint32_t surface) {
    const Assets& assets = *library.assets();
    return assets.images[assets.materials[model.skin_materials[skin] + surface].frames.at(0).base].name;
  };
  EXPECT_EQ(image(0, 0), "progs/body.lmp");
  EXPECT_EQ(image(0, 1), "textures/head_0.tga");
  EXPECT_EQ(image(1, 0), "progs/body.lmp") << "a surface without the skin keeps its first";
  EXPECT_EQ(image(1, 1), "progs/head_1.tga");
  // A player's colours change what is paletted, of both surfaces' materials.
  const std::uint32_t colored = library.translated_skin(model, 0, 4, 6);
  const Assets& assets = *library.assets();
  EXPECT_EQ(assets.images[assets.materials[colored].frames.at(0).base].texels[0], 4 * 16 + 3);
  EXPECT_EQ(assets.images[assets.materials[colored + 1].frames.at(0).base].name, "textures/head_0.tga");
}

TEST_F(Enhanced, ATextMayNameTheImages) {
  files.files["progs/thing.md3"] = small_md3({"body", "head"});
  files.files["progs/body.lmp"] = plain_picture(20);
  files.add_tga("progs/head.tga", 2, 2, {8, 8, 8});
  files.add_tga("skins/red.tga", 2, 2, {8, 8, 8});
  files.add_tga("skins/green.tga", 2, 2, {8, 8, 8});
  files.files["progs/thing.md3_0.skin"] = text_bytes("head, skins/red.tga\r\nhead,skins/green\nno comma\nbody,\n");
  ModelLibrary library(files.loader());
  const Model& model = library.model("progs/thing.mdl");
  ASSERT_EQ(model.skin_materials.size(), 1u);
  const Assets& assets = *library.assets();
  const Material &body = assets.materials[model.skin_materials[0]],
                 &head = assets.materials[model.skin_materials[0] + 1];
  EXPECT_EQ(assets.images[body.frames.at(0).base].name, "progs/body.lmp");
  ASSERT_EQ(head.frames.size(), 2u);
  EXPECT_EQ(assets.images[head.frames[0].base].name, "skins/red.tga");
  EXPECT_EQ(assets.images[head.frames[1].base].name, "skins/green.tga");
}

TEST_F(Enhanced, FramesAreTheMdlsWhereTheirNumberIs) {
  add_md5();  // of three poses, as the .mdl of two frames has
  ModelLibrary library(files.loader());
  const formats::Mdl mdl = thing();
  ASSERT_EQ(mdl.pose_count, 3u);
  const Model& model = library.model("progs/thing.mdl");
  ASSERT_EQ(model.frames.size(), mdl.frames.size());
  EXPECT_EQ(model.frames[1].pose_count, mdl.frames[1].pose_count);
  EXPECT_EQ(model.frames[1].name, mdl.frames[1].name);
  files.files["progs/thing.md3"] = small_md3({"body"}, 5);
  files.files["progs/body.lmp"] = plain_picture(20);
  files.files.erase("progs/thing.md5mesh");
  ModelLibrary other(files.loader());
  const Model& longer = other.model("progs/thing.mdl");
  ASSERT_EQ(longer.frames.size(), 5u);
  EXPECT_EQ(longer.frames[4].name, "frame4");
  EXPECT_EQ(pose_at(longer, 4, 0.0), 4u);
}

TEST_F(Enhanced, WhatIsWrongIsSaidAndTheMdlShown) {
  add_md5();
  files.files["progs/thing.md5anim"] = text_bytes("MD5Version 9");
  {
    Said said;
    ModelLibrary library(files.loader());
    EXPECT_EQ(mesh_of(library, "progs/thing.mdl").name, "progs/thing.mdl");
    EXPECT_THAT(said.lines, testing::ElementsAre(testing::AllOf(HasSubstr("progs/thing.md5anim: offset"),
                                                                HasSubstr("progs/thing.mdl is shown"))));
  }
  add_md5();
  files.files.erase("progs/thing_00_00.lmp");
  Said said;
  ModelLibrary library(files.loader());
  EXPECT_EQ(mesh_of(library, "progs/thing.mdl").name, "progs/thing.mdl");
  EXPECT_THAT(said.lines, testing::ElementsAre(HasSubstr("progs/thing_00_00.png, .tga, .pcx or .lmp is wanted")));
}

TEST_F(Enhanced, AModMayNameThemItself) {
  add_md5();
  files.files["progs/body.lmp"] = plain_picture(20);
  files.files["progs/thing.md3"] = small_md3();
  ModelLibrary library(files.loader());
  EXPECT_EQ(mesh_of(library, "progs/thing.md3").pose_count, 2u);
  EXPECT_EQ(mesh_of(library, "progs/thing.md5mesh").pose_count, 3u);
}

}  // namespace
}  // namespace fb::scene
