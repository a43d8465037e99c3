// LibreQuake's maps, models and sprites through the library. Skipped where the data is absent.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <iterator>
#include <system_error>

#include "base/librequake.h"
#include "formats/bsp.h"
#include "scene/library/library.h"
#include "scene/library/test_sound.h"
#include "scene/shapes.h"
#include "world/bsp_query.h"

namespace fb::scene {
namespace {

namespace stdfs = std::filesystem;

Bytes read_file(const stdfs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(in), {});
}

// The files of pak0 and pak1, and loose maps; no search order, just what these tests need.
class LibreQuake : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const stdfs::path root = librequake_folder() / "id1";
    for (const char* pak : {"pak0.pak", "pak1.pak"}) {
      const Bytes data = read_file(root / pak);
      ByteReader reader(data, pak);
      reader.skip(4);
      const std::uint32_t offset = reader.u32(), size = reader.u32();
      reader.seek(offset);
      for (std::uint32_t i = 0; i < size / 64 && !reader.failed(); ++i) {
        const std::string name = reader.fixed_string(56);
        const std::uint32_t at = reader.u32(), length = reader.u32();
        if (at + length <= data.size()) files_[name] = Bytes(data.begin() + at, data.begin() + at + length);
      }
    }
    std::error_code none;
    for (const auto& entry : stdfs::directory_iterator(root / "maps", none))
      files_["maps/" + entry.path().filename().string()] = read_file(entry.path());
  }
  void SetUp() override {
    if (const std::string lacks = librequake_lacks(); !lacks.empty()) GTEST_SKIP() << lacks;
  }
  static std::optional<Bytes> load(std::string_view path) {
    const auto found = files_.find(path);
    if (found == files_.end()) return std::nullopt;
    return found->second;
  }
  static std::map<std::string, Bytes, std::less<>> files_;
};
std::map<std::string, Bytes, std::less<>> LibreQuake::files_;

void expect_sound(const Assets& assets) { EXPECT_EQ(test::broken(assets), ""); }

// The area of triangles that have open space behind and solid in front: they would face the wrong way. (Faces with
// solid on both sides exist: detail brushes inside of others.)
double share_of_wrong_sides(const formats::Bsp& bsp, const Mesh& mesh, const Assets& assets) {
  double wrong = 0.0, all = 0.0;
  for (const MeshTriangle& t : mesh.triangles) {
    if (assets.materials[t.material].flags & kMaterialLiquid) continue;
    const vec3 a = mesh.positions[t.vertices[0]], b = mesh.positions[t.vertices[1]], c = mesh.positions[t.vertices[2]];
    const vec3 middle = (a + b + c) / 3.0f, cross = glm::cross(b - a, c - a), step = glm::normalize(cross) * 0.1f;
    const double area = 0.5 * static_cast<double>(glm::length(cross));
    all += area;
    if (world::point_contents(bsp, middle + step) == formats::kContentsSolid &&
        world::point_contents(bsp, middle - step) != formats::kContentsSolid)
      wrong += area;
  }
  return wrong / all;
}

TEST_F(LibreQuake, MapsLoad) {
  for (const auto& [path, bytes] : files_) {
    if (!path.ends_with(".bsp") || path.find("/b_") != std::string::npos) continue;
    SCOPED_TRACE(path);
    ModelLibrary library(load);
    const Status status = library.load_map(path);
    ASSERT_TRUE(status.ok()) << status.error().message;
    const Assets& assets = *library.assets();
    expect_sound(assets);
    const Model& world = library.model(path);
    ASSERT_EQ(world.kind, ModelKind::kBrush);
    ASSERT_NE(world.mesh, kNone);
    const Mesh& mesh = assets.meshes[world.mesh];
    EXPECT_GT(mesh.triangles.size(), 1000u);
    EXPECT_LT(share_of_wrong_sides(*library.map(), mesh, assets), 0.001);
    EXPECT_FALSE(library.entity_lights().empty());
    EXPECT_EQ(library.map_sky().mode, SkyMode::kLayers);
    for (const EntityLight& light : library.entity_lights()) {
      EXPECT_NE(world::point_contents(*library.map(), light.position), formats::kContentsSolid);
      EXPECT_GE(light.radius, 1.0f);
      EXPECT_LE(light.radius, 8.0f);
    }
    for (std::uint32_t i = 1; i < library.map()->models.size(); ++i)
      EXPECT_EQ(library.model(fmt::format("*{}", i)).kind, ModelKind::kBrush);
  }
}

TEST_F(LibreQuake, MapsInAllVersionsAreTheSame) {
  ModelLibrary library(load);
  ASSERT_TRUE(library.load_map("maps/lq_e0m1.bsp").ok());
  const std::size_t triangles = library.assets()->meshes[0].triangles.size();
  for (const char* other : {"maps/lq_e0m1_bsp2.bsp", "maps/lq_e0m1_2psb.bsp", "maps/lq_e0m1_bspx.bsp"}) {
    const std::uint64_t generation = library.assets()->generation;
    ASSERT_TRUE(library.load_map(other).ok()) << other;
    EXPECT_NE(library.assets()->generation, generation);
    EXPECT_NEAR(static_cast<double>(library.assets()->meshes[0].triangles.size()), static_cast<double>(triangles),
                0.1 * static_cast<double>(triangles));
  }
}

TEST_F(LibreQuake, ModelsFaceOutward) {
  ModelLibrary library(load);
  std::size_t models = 0, outward = 0;
  for (const auto& [path, bytes] : files_) {
    if (!path.ends_with(".mdl")) continue;
    SCOPED_TRACE(path);
    const Model& model = library.model(path);
    ASSERT_EQ(model.kind, ModelKind::kAlias);
    ASSERT_NE(model.mesh, kNone);
    ASSERT_FALSE(model.skin_materials.empty());
    ASSERT_FALSE(model.frames.empty());
    const Mesh& mesh = library.assets()->meshes[model.mesh];
    ++models;
    const bool positive = mesh_volume(mesh, 0) > 0.0;
    outward += positive;
    if (!positive) std::cout << path << " has volume " << mesh_volume(mesh, 0) << "\n";
  }
  expect_sound(*library.assets());
  EXPECT_GT(models, 70u);
  // Flat or open models (a sheet, a hand cut off at the screen's edge) have volumes of any sign.
  EXPECT_GT(static_cast<double>(outward), 0.9 * static_cast<double>(models));
}

TEST_F(LibreQuake, SpritesAndItemBoxesLoad) {
  ModelLibrary library(load);
  for (const auto& [path, bytes] : files_) {
    if (path.ends_with(".spr")) {
      const Model& model = library.model(path);
      ASSERT_EQ(model.kind, ModelKind::kSprite) << path;
      for (const Model::SpriteFrame& frame : model.sprite_frames) {
        ASSERT_FALSE(frame.meshes.empty());
        EXPECT_EQ(library.assets()->materials[frame.material].emission_kind, EmissionKind::kSprite);
      }
    }
    if (path.find("maps/b_") == 0) {
      const Model& model = library.model(path);
      ASSERT_EQ(model.kind, ModelKind::kBrush) << path;
      ASSERT_NE(model.mesh, kNone) << path;
      EXPECT_GE(library.assets()->meshes[model.mesh].triangles.size(), 12u) << path;
      EXPECT_GT(mesh_volume(library.assets()->meshes[model.mesh]), 0.0) << path;
    }
  }
  expect_sound(*library.assets());
}

}  // namespace
}  // namespace fb::scene
