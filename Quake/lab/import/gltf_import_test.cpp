// glTF scenes that are read: what is exported comes back, what others write is understood, what is damaged is refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/test_directory.h"
#include "lab/gltf/gltf_export.h"
#include "lab/import/imported_scene.h"
#include "lab/import/test_import.h"
#include "lab/json.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_of_glass.h"

namespace fb::lab {
namespace {

// A triangle of one square metre (two metres by one) that looks along z, with a camera before it.
Json one_triangle() {
  return Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
    "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 5]}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 1.0, "aspectRatio": 1.0}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "materials": [{"name": "it", "pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.4, 0.6, 1]}}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "three.bin"}]})");
}

class GltfImportTest : public testing::Test {
 protected:
  GltfImportTest() {
    const float corners[9] = {0, 0, 0, 2, 0, 0, 0, 1, 0};
    Bytes bytes(sizeof corners);
    std::memcpy(bytes.data(), corners, sizeof corners);
    directory_.put("three.bin", bytes);
  }
  Result<ImportedScene> import(const Json& json) {
    directory_.put("scene.gltf", json_text(json));
    return import_scene(directory_.file("scene.gltf"));
  }
  ImportedScene imported(const Json& json) {
    auto scene = import(json);
    EXPECT_TRUE(scene.ok()) << scene.error().message;
    return scene ? std::move(*scene) : ImportedScene();
  }
  void expect_refused(const Json& json, const std::string& why) {
    const auto scene = import(json);
    ASSERT_FALSE(scene.ok()) << why;
    EXPECT_THAT(scene.error().message, testing::HasSubstr(why));
    EXPECT_THAT(scene.error().message, testing::StartsWith(directory_.file("scene.gltf") + ": "));
  }
  const TestDirectory directory_;
};

TEST_F(GltfImportTest, WhatIsExportedComesBack) {
  const render::RenderSettings settings;
  for (const char* name : {"scene.gltf", "scene.glb"}) {
    for (const scene::FrameSnapshot& snapshot :
         {scene::cornell_box(), scene::cornell_box(scene::CornellVariant::kGlossy), scene::alpha_panel(),
          scene::furnace(0.5f, 1.0f, true), scene::many_lights(3)}) {
      const std::string file = directory_.file(name);
      ASSERT_TRUE(export_gltf(snapshot, settings, {96, 54}, file, "a test"));
      const auto back = import_scene(file);
      ASSERT_TRUE(back.ok()) << back.error().message;
      const auto before = parts_of(snapshot), after = parts_of(back->snapshot);
      double area_before = 0, area_after = 0, light_before = 0, light_after = 0;
      for (const auto& [part, was] : before) {
        area_before += was.area;
        light_before += was.area * static_cast<double>(was.material.emission.y);
      }
      for (const auto& [part, is] : after) {
        area_after += is.area;
        light_after += is.area * static_cast<double>(is.material.emission.y);
        if (!before.contains(part)) continue;  // instances of one material with colours of their own
        const scene::Material &was = before.at(part).material, &now = is.material;
        EXPECT_NEAR(glm::distance(was.base_color, now.base_color), 0, 1e-5) << part;
        EXPECT_NEAR(was.roughness, now.roughness, 1e-5) << part;
        EXPECT_NEAR(was.specular, now.specular, 1e-5) << part;
        EXPECT_NEAR(was.metalness, now.metalness, 1e-5) << part;
        EXPECT_EQ(was.flags & scene::kMaterialAlphaTest, now.flags & scene::kMaterialAlphaTest) << part;
      }
      EXPECT_NEAR(area_after, area_before, 1e-4 * area_before);
      if (snapshot.instances.size() < 4) {
        EXPECT_NEAR(light_after, light_before, 1e-4 * light_before);
      }
      const scene::Camera &was = snapshot.camera, &now = back->snapshot.camera;
      EXPECT_NEAR(glm::distance(was.position, now.position), 0, 1e-2);
      EXPECT_NEAR(glm::distance(angle_vectors(was.angles).right, angle_vectors(now.angles).right), 0, 1e-4);
      EXPECT_NEAR(glm::distance(angle_vectors(was.angles).up, angle_vectors(now.angles).up), 0, 1e-4);
      EXPECT_NEAR(was.fov_x, now.fov_x, 1e-3);
      EXPECT_EQ(snapshot.sky.beyond_everything, back->snapshot.sky.beyond_everything);
    }
  }
}

TEST_F(GltfImportTest, NodesHaveTheirParents) {
  Json json = one_triangle();
  // 90 degrees about x: what looked along z looks along -y, down; then doubled, then moved.
  json["nodes"][0]["rotation"] = {0.70710678, 0, 0, 0.70710678};
  json["nodes"].push_back({{"children", Json::array({0})}, {"scale", {2, 2, 2}}, {"translation", {0, 3, 0}}});
  json["scenes"][0]["nodes"] = {1, 2};
  const ImportedScene scene = imported(json);
  const scene::Mesh& mesh = scene.snapshot.assets->meshes[0];
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_NEAR(scene::mesh_area(mesh), 4.0 * 39.3701 * 39.3701, 1.0);
  for (const vec3& p : mesh.positions) EXPECT_NEAR(p.z, 3 * 39.3701f, 1e-2f) << "y is up, and z here";
  EXPECT_NEAR(glm::distance(mesh.normals[0], vec3(0, 0, -1)), 0, 1e-5);
  // A mirror turns the front with it.
  json["nodes"][2]["scale"] = {2, -2, 2};
  const ImportedScene mirrored = imported(json);
  EXPECT_NEAR(glm::distance(mirrored.snapshot.assets->meshes[0].normals[0], vec3(0, 0, 1)), 0, 1e-5);
  const auto& t = mirrored.snapshot.assets->meshes[0];
  const vec3 a = t.positions[t.triangles[0].vertices[0]], b = t.positions[t.triangles[0].vertices[1]],
             c = t.positions[t.triangles[0].vertices[2]];
  EXPECT_GT(glm::cross(b - a, c - a).z, 0) << "corners run about the normal";
}

TEST_F(GltfImportTest, LightsAndGlass) {
  Json json = one_triangle();
  json["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([
    {"type": "directional", "color": [1, 0.5, 0.25], "intensity": 1366},
    {"type": "point", "intensity": 683}])");
  json["nodes"].push_back(Json::parse(R"({"extensions": {"KHR_lights_punctual": {"light": 0}}})"));
  json["nodes"].push_back(
      Json::parse(R"({"translation": [1, 2, 3], "extensions": {"KHR_lights_punctual": {"light": 1}}})"));
  json["scenes"][0]["nodes"] = {0, 1, 2, 3};
  json["materials"][0]["extensions"] = Json::parse(R"({"KHR_materials_transmission": {"transmissionFactor": 1},
    "KHR_materials_ior": {"ior": 1.7},
    "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 2, "attenuationColor": [0.5, 1, 1]}})");
  const ImportedScene scene = imported(json);
  ASSERT_EQ(scene.snapshot.sky.suns.size(), 1u);
  const scene::Sun& sun = scene.snapshot.sky.suns[0];
  EXPECT_NEAR(glm::distance(sun.irradiance, vec3(2, 1, 0.5)), 0, 1e-5);
  EXPECT_NEAR(glm::distance(sun.direction, vec3(0, -1, 0)), 0, 1e-5) << "it shines along -z, to the north";
  EXPECT_TRUE(scene.snapshot.sky.beyond_everything);
  ASSERT_EQ(scene.snapshot.instances.size(), 2u);
  const scene::Instance& lamp = scene.snapshot.instances[1];
  EXPECT_NEAR(glm::distance(lamp.transform[3], vec3(1, -3, 2) * 39.3701f), 0, 1e-2);
  // One watt a steradian: radiance times the disk that is seen of it, in square metres.
  EXPECT_NEAR(lamp.emission.x * kPi * 0.0254f * 0.0254f, 1.0f, 1e-3f);
  const scene::Material& glass = scene.snapshot.assets->materials[0];
  EXPECT_NE(glass.flags & scene::kMaterialDielectric, 0u);
  EXPECT_FLOAT_EQ(glass.index, 1.7f);
  EXPECT_NEAR(std::exp(-glass.absorption.x * 2 * 39.3701f), 0.5f, 1e-4f);
  EXPECT_EQ(glass.absorption.y, 0.0f);
}

TEST_F(GltfImportTest, StripsFansAndSmallIndices) {
  Json json = one_triangle();
  Bytes bytes(4 * 12 + 4);
  const float corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  std::memcpy(bytes.data(), corners, sizeof corners);
  for (std::uint8_t i = 0; i < 4; ++i) bytes[48 + i] = i;
  directory_.put("three.bin", bytes);
  json["buffers"][0]["byteLength"] = 52;
  json["bufferViews"] =
      Json::parse(R"([{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 4}])");
  json["accessors"][0]["count"] = 4;
  json["accessors"].push_back(Json::parse(R"({"bufferView": 1, "componentType": 5121, "count": 4, "type": "SCALAR"})"));
  Json& primitive = json["meshes"][0]["primitives"][0];
  primitive["indices"] = 1;
  primitive["mode"] = 5;
  const ImportedScene strip = imported(json);
  EXPECT_NEAR(scene::mesh_area(strip.snapshot.assets->meshes[0]), 39.3701 * 39.3701, 0.1);
  for (const vec3& n : strip.snapshot.assets->meshes[0].normals) EXPECT_NEAR(n.y, -1, 1e-5) << "all of one side";
  primitive["mode"] = 1;
  EXPECT_FALSE(import(json).ok()) << "lines alone are no triangles";
}

TEST_F(GltfImportTest, WhatIsLeftOutIsNamed) {
  Json json = one_triangle();
  json["animations"] = Json::array({Json::object()});
  json["nodes"].push_back(json["nodes"][1]);
  json["scenes"][0]["nodes"] = {0, 1, 2};
  json["materials"][0]["extensions"]["KHR_materials_clearcoat"] = Json::object();
  json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  json["textures"] = Json::parse(R"([{"source": 0}])");
  json["images"] = Json::array({Json{{"uri", "data:image/jpeg;base64,/9j/4AAQ"}}});
  const ImportedScene scene = imported(json);
  EXPECT_THAT(scene.left_out,
              testing::UnorderedElementsAre(testing::HasSubstr("animations"), testing::HasSubstr("cameras"),
                                            testing::HasSubstr("clearcoat"), testing::HasSubstr("JPEG")));
}

TEST_F(GltfImportTest, AMaskOfNothingIsAHole) {
  Json json = one_triangle();
  json["materials"][0]["alphaMode"] = "MASK";
  EXPECT_EQ(imported(json).snapshot.assets->materials[0].alpha, 1.0f);
  json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.25};
  EXPECT_EQ(imported(json).snapshot.assets->materials[0].alpha, 0.0f);
}

TEST_F(GltfImportTest, DamagedFilesAreRefused) {
  const Json good = one_triangle();
  ASSERT_TRUE(import(good).ok());
  const auto with = [&](const char* pointer, Json value) {
    Json json = good;
    json[Json::json_pointer(pointer)] = std::move(value);
    return json;
  };
  expect_refused(with("/accessors/0/count", 4), "has 4 elements, its view 3");
  expect_refused(with("/accessors/0/count", 18446744073709551615u), "elements");
  expect_refused(with("/accessors/0/byteOffset", 18446744073709551615u), "elements");
  expect_refused(with("/accessors/0/count", -1), "a whole number is wanted");
  expect_refused(with("/accessors/0/type", "MAT4"), "type that is not read");
  expect_refused(with("/accessors/0/sparse", Json::object()), "sparse");
  expect_refused(with("/bufferViews/0/byteLength", 40), "leaves its buffer");
  expect_refused(with("/bufferViews/0/byteOffset", 18446744073709551615u), "leaves its buffer");
  expect_refused(with("/bufferViews/0/byteStride", 1), "elements");
  expect_refused(with("/buffers/0/uri", "no.bin"), "cannot be read");
  expect_refused(with("/buffers/0/uri", "/etc/hostname"), "only files beside it");
  expect_refused(with("/buffers", 3), "buffer 0 of 0");
  expect_refused(with("/nodes/0/children", Json::array({0})), "deep");
  expect_refused(with("/nodes/0/mesh", 7), "there are no meshes with number 7");
  expect_refused(with("/scene", 3), "scenes");
  expect_refused(with("/extensionsRequired", Json::array({"KHR_draco_mesh_compression"})),
                 "KHR_draco_mesh_compression");
  expect_refused(with("/asset", nullptr), "no glTF");
}

TEST_F(GltfImportTest, AnyBytesAreTakenOrRefused) {
  const std::string file = directory_.file("scene.glb");
  ASSERT_TRUE(export_gltf(scene::alpha_panel(), {}, {96, 54}, file, "a test"));
  std::ifstream in(file, std::ios::binary);
  const Bytes good{std::istreambuf_iterator<char>(in), {}};
  int refused = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    directory_.put("scene.glb", damaged(good, i));
    const auto scene = import_scene(file);
    if (scene) continue;
    ++refused;
    EXPECT_FALSE(scene.error().message.empty());
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace fb::lab
