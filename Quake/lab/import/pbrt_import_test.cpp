// Scenes of pbrt-v4 that are read: transforms and handedness, shapes, materials, lights, files in files, damage.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/test_directory.h"
#include "lab/import/imported_scene.h"
#include "lab/import/test_import.h"

namespace fb::lab {
namespace {

constexpr float kInch = 39.3700787f;

// A room of a few things, with all that a file may have.
constexpr const char* kRoom = R"(# a room
LookAt 0 1 -5  0 1 0  0 1 0
Camera "perspective" "float fov" [ 40 ]
Film "rgb" "integer xresolution" [ 640 ] "integer yresolution" 320
Sampler "independent" "integer pixelsamples" [ 16 ]
Integrator "volpath" "integer maxdepth" 5
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 17 12 4 ] "bool twosided" true
  Material "diffuse" "rgb reflectance" [ 0 0 0 ]
  Translate 0 2 0
  Rotate 90 1 0 0
  Shape "disk" "float radius" 0.5
AttributeEnd
MakeNamedMaterial "old gold" "string type" "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k"
  "float roughness" 0.0625
NamedMaterial "old gold"
ObjectBegin "ball"
  Shape "sphere" "float radius" 0.25
ObjectEnd
AttributeBegin
  Translate 1 0 0
  ObjectInstance "ball"
  Scale 2 2 2
  ObjectInstance "ball"
AttributeEnd
Material "coateddiffuse" "rgb reflectance" [ 0.2 0.3 0.4 ] "float roughness" [ 0.09 ] "float eta" 1.5
Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ] "point3 P" [ -1 0 -1  1 0 -1  1 0 1  -1 0 1 ]
  "point2 uv" [ 0 0 1 0 1 1 0 1 ]
LightSource "distant" "point3 from" [ 0 3 0 ] "point3 to" [ 0 0 0 ] "rgb L" [ 1 2 3 ] "float scale" 2
LightSource "infinite" "rgb L" [ 0.1 0.2 0.3 ]
)";

class PbrtImportTest : public testing::Test {
 protected:
  Result<ImportedScene> import(const std::string& text) {
    directory_.put("scene.pbrt", text);
    return import_scene(directory_.file("scene.pbrt"));
  }
  ImportedScene imported(const std::string& text) {
    auto scene = import(text);
    EXPECT_TRUE(scene.ok()) << scene.error().message;
    return scene ? std::move(*scene) : ImportedScene();
  }
  static std::string with(const std::string& from, const std::string& to) {
    std::string text = kRoom;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }
  const TestDirectory directory_;
};

TEST_F(PbrtImportTest, ARoomIsAsItsFileSays) {
  const ImportedScene room = imported(kRoom);
  const scene::FrameSnapshot& s = room.snapshot;
  const auto parts = parts_of(s);
  const double inch2 = static_cast<double>(kInch) * static_cast<double>(kInch);
  const auto& lamp = parts.at("diffuse");
  EXPECT_NEAR(lamp.area / inch2, 3.14159 / 4, 0.01);
  EXPECT_EQ(lamp.material.emission, vec3(17, 12, 4));
  EXPECT_EQ(lamp.material.emission_kind, scene::EmissionKind::kConstant);
  const auto& gold = parts.at("old gold");
  EXPECT_NEAR(gold.area / inch2, 4 * 3.14159 * (0.0625 + 0.25), 0.02) << "two balls";
  EXPECT_EQ(gold.material.metalness, 1.0f);
  EXPECT_GT(gold.material.base_color.x, gold.material.base_color.z);
  EXPECT_NEAR(gold.material.roughness, 0.5f, 1e-5f) << "alpha is its square, and the root of the file's";
  const auto& floor = parts.at("coateddiffuse");
  EXPECT_NEAR(floor.area / inch2, 4, 1e-3);
  EXPECT_NEAR(floor.material.specular, 0.04f, 1e-5f);
  EXPECT_NEAR(floor.material.roughness * floor.material.roughness, 0.3f, 1e-5f);
  EXPECT_EQ(floor.material.base_color, vec3(0.2f, 0.3f, 0.4f));
  EXPECT_EQ(s.sky.mode, scene::SkyMode::kConstant);
  EXPECT_EQ(s.sky.color, vec3(0.1f, 0.2f, 0.3f));
  ASSERT_EQ(s.sky.suns.size(), 1u);
  EXPECT_NEAR(glm::distance(s.sky.suns[0].direction, vec3(0, 0, 1)), 0, 1e-6) << "up";
  EXPECT_EQ(s.sky.suns[0].irradiance, vec3(2, 4, 6));
  // 40 degrees are of the shorter side.
  EXPECT_NEAR(std::tan(radians(s.camera.fov_x) / 2) / std::tan(radians(20.0f)), 2.0f, 1e-4f);
  EXPECT_NEAR(glm::distance(s.camera.position, vec3(0, -5, 1) * kInch), 0, 1e-2);
  EXPECT_THAT(room.left_out, testing::ElementsAre(testing::HasSubstr("coat")));
}

TEST_F(PbrtImportTest, WhatIsNotReadIsNamed) {
  const ImportedScene scene = imported(
      "\xef\xbb\xbfOption \"disablepixeljitter\" true Option \"integer seed\" 5\n"
      "Camera \"perspective\" \"float lensradius\" 0.1\nWorldBegin\n"
      "Material \"diffuse\" \"float sigma\" 20\nShape \"sphere\" \"float radius\" 10 \"float phi\" 2");
  EXPECT_THAT(scene.left_out, testing::UnorderedElementsAre("Camera perspective: its lensradius is not read",
                                                            "Material diffuse: its sigma is not read",
                                                            "Shape sphere: its phi is not read"));
}

// What is seen at the picture's right stays there, whichever way the axes turn.
TEST_F(PbrtImportTest, TheRightIsTheRight) {
  const auto rightness = [&](const std::string& before_camera) {
    const ImportedScene scene = imported(before_camera + R"(LookAt 0 0 -50  0 0 0  0 1 0
Camera "perspective"
WorldBegin
Shape "trianglemesh" "point3 P" [ 10 10 0  20 10 0  10 20 0 ])");
    const scene::Camera& camera = scene.snapshot.camera;
    const AxisVectors axes = angle_vectors(camera.angles);
    vec3 sum(0);
    for (const vec3& p : scene.snapshot.assets->meshes[0].positions) {
      const vec3 d = (p - camera.position) / 30.0f;
      sum += vec3(glm::dot(d, axes.right), glm::dot(d, axes.up), glm::dot(d, axes.forward)) / kInch;
    }
    return sum;
  };
  const vec3 plain = rightness("");
  EXPECT_NEAR(glm::distance(plain, vec3(4.0f / 3, 4.0f / 3, 5)), 0, 1e-3);
  EXPECT_NEAR(glm::distance(rightness("Scale -1 1 1\n"), plain * vec3(-1, 1, 1)), 0, 1e-3) << "a mirrored picture";
  EXPECT_NEAR(glm::distance(rightness("Rotate 90 0 0 1\n"), vec3(-plain.y, plain.x, 5)), 0, 1e-3) << "rolled";
}

TEST_F(PbrtImportTest, FilesInFilesAndShapesInFiles) {
  directory_.put("parts/inner.pbrt", R"(Shape "plymesh" "string filename" "parts/three.ply" Translate 0 0 1 )");
  directory_.put("parts/three.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                 "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 2 0 0 0 1 0\n3 0 1 2\n");
  const ImportedScene scene = imported(R"(WorldBegin
Include "parts/inner.pbrt" Shape "plymesh" "string filename" [ "parts/three.ply" ])");
  const scene::Mesh& mesh = scene.snapshot.assets->meshes[0];
  EXPECT_NEAR(scene::mesh_area(mesh), 2.0 * 39.3701 * 39.3701, 1.0);
  EXPECT_NEAR(mesh.bounds.max.y - mesh.bounds.min.y, 39.3701f, 1e-2f) << "what was included goes on behind it";
  directory_.put("parts/inner.pbrt", R"(Include "parts/inner.pbrt")");
  const auto circle = import("WorldBegin Include \"parts/inner.pbrt\"");
  ASSERT_FALSE(circle.ok());
  EXPECT_THAT(circle.error().message, testing::HasSubstr("include each other"));
}

TEST_F(PbrtImportTest, GlassFacesOutward) {
  for (const char* turn : {"", "Scale -1 1 1 ", "ReverseOrientation "}) {
    const ImportedScene scene =
        imported(std::string("WorldBegin Material \"dielectric\" \"float eta\" 1.4 ") + turn + "Shape \"sphere\"");
    const scene::Assets& assets = *scene.snapshot.assets;
    EXPECT_NEAR(scene::mesh_volume(assets.meshes[0]), 4.18879 * std::pow(39.3701, 3), 0.01 * 255000);
    EXPECT_FLOAT_EQ(assets.materials.back().index, 1.4f);
    EXPECT_NE(assets.materials.back().flags & scene::kMaterialDielectric, 0u);
  }
}

// A scene in millimetres is as one in metres: radiance does not know lengths, and a point's intensity keeps up.
TEST_F(PbrtImportTest, FarTooSmallIsScaled) {
  const auto lit = [&](const std::string& scale, const std::string& intensity) {
    return imported("Camera \"perspective\" WorldBegin LightSource \"point\" \"rgb I\" [" + intensity + "] Scale " +
                    scale + " Shape \"sphere\"");
  };
  const ImportedScene large = lit("10 10 10", "100 100 100"), small = lit("0.01 0.01 0.01", "0.0001 0.0001 0.0001");
  const auto light = [](const ImportedScene& s) {
    // What the point sends to the ball's surface from its centre.
    const scene::Instance& lamp = s.snapshot.instances.back();
    const double radius = static_cast<double>(lamp.transform[0].x);
    const double distance = static_cast<double>(s.snapshot.assets->meshes[0].bounds.max.z);
    return static_cast<double>(lamp.emission.x) * radius * radius / (distance * distance);
  };
  EXPECT_NEAR(light(small), light(large), 1e-3 * light(large));
  EXPECT_THAT(small.left_out, testing::Contains(testing::HasSubstr("was scaled by")));
  EXPECT_THAT(large.left_out, testing::Not(testing::Contains(testing::HasSubstr("was scaled by"))));
}

TEST_F(PbrtImportTest, ColoursOfLight) {
  const auto emission = [&](const std::string& light) {
    const ImportedScene scene = imported("WorldBegin AreaLightSource \"diffuse\" " + light + " Shape \"sphere\"");
    return scene.snapshot.assets->materials.back().emission;
  };
  const vec3 warm = emission(R"("blackbody L" 2700)"), day = emission(R"("blackbody L" 6504)");
  const vec3 luminance(0.2126f, 0.7152f, 0.0722f);
  EXPECT_NEAR(glm::dot(warm, luminance), 1, 1e-3);
  EXPECT_GT(warm.x, 2 * warm.z);
  EXPECT_NEAR(glm::distance(day, vec3(1)), 0, 0.08) << "D65 is nearly white";
  EXPECT_NEAR(glm::distance(emission(R"("spectrum L" [ 400 1 450 1 550 2 600 4 ])"), vec3(4, 2, 1)), 0, 1e-5);
  EXPECT_EQ(emission(R"("rgb L" [ 1 2 3 ] "float scale" 3)"), vec3(3, 6, 9));
}

TEST_F(PbrtImportTest, DamagedFilesAreRefused) {
  const auto refused = [&](const std::string& text, const std::string& why) {
    const auto scene = import(text);
    ASSERT_FALSE(scene.ok()) << why;
    EXPECT_THAT(scene.error().message, testing::HasSubstr(why));
    EXPECT_THAT(scene.error().message, testing::StartsWith(directory_.file("scene.pbrt")));
  };
  refused("", "no WorldBegin");
  refused("WorldBegin", "no triangles");
  refused("WorldBegin AttributeEnd", "nothing began");
  refused("Cube", "no directive of pbrt-v4");
  refused("WorldBegin \"", "has no end");
  refused("WorldBegin Shape \"sphere\" \"float radius\" [ 1", "a list has no end");
  refused("WorldBegin Shape \"sphere\" \"float radius\"", "has no value");
  refused("WorldBegin Shape \"sphere\" \"radius\" 1", "type and name");
  refused("WorldBegin Shape \"sphere\" \"float radius\" one", "has no value");
  refused("WorldBegin Shape", "its name is missing");
  refused("Translate 1 2", "2 numbers, and 3 are wanted");
  refused("LookAt 0 0 0 0 0 0 0 1 0", "make no transform");
  refused(with("\"integer indices\" [ 0 1 2 0 2 3 ]", "\"integer indices\" [ 0 1 2 0 2 9 ]"), "corner 9 of 4");
  refused(with("\"integer indices\" [ 0 1 2 0 2 3 ]", "\"integer indices\" [ 0 1 2 0 2 ]"), "no faces");
  refused(with("\"integer indices\" [ 0 1 2 0 2 3 ]", "\"integer indices\" [ 0 1 -2 0 2 3 ]"), "no vertex");
  refused(with("NamedMaterial \"old gold\"\nObj", "NamedMaterial \"new gold\"\nObj"), "no material new gold");
  refused(with("\"float fov\" [ 40 ]", "\"float fov\" [ 180 ]"), "180 degrees");
  refused("WorldBegin Shape \"plymesh\" \"string filename\" \"none.ply\"", "none.ply");
  refused("WorldBegin Include \"none.pbrt\"", "none.pbrt");
  const auto line = import(with("Translate 1 0 0", "Translate 1 0 up"));
  ASSERT_FALSE(line.ok());
  EXPECT_THAT(line.error().message, testing::HasSubstr("line 22"));
}

TEST_F(PbrtImportTest, AnyBytesAreTakenOrRefused) {
  const Bytes good(kRoom, kRoom + std::string(kRoom).size());
  int refused = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Bytes bytes = damaged(good, i);
    const auto scene = import(std::string(bytes.begin(), bytes.end()));
    if (!scene) ++refused;
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace fb::lab
