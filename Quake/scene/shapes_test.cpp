// Shapes and the scenes made of them: closed, facing the right way, of the area they claim.
#include "scene/shapes.h"

#include <glm/vector_relational.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scene/in_code/scenes_in_code.h"
#include "scene/test_scenes.h"

namespace fb::scene {
namespace {

TEST(Shapes, SphereHasTheAreaOfASphere) {
  const Mesh sphere = make_sphere();
  EXPECT_EQ(sphere.triangles.size(), 80u);
  EXPECT_EQ(sphere.vertex_count, 42u);
  EXPECT_TRUE(is_closed(sphere));
  EXPECT_NEAR(mesh_area(sphere), 4.0 * 3.14159265358979, 1e-4);
  EXPECT_GT(mesh_volume(sphere), 0.9 * 4.18879);
  for (const vec3& p : sphere.positions) EXPECT_NEAR(glm::length(p), 1.0379f, 0.0001f);
}

TEST(Shapes, TetrahedronIsRegular) {
  const Mesh mesh = make_tetrahedron();
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_NEAR(mesh_volume(mesh), 8.0 / (9.0 * std::sqrt(3.0)), 1e-6);
  for (const vec3& p : mesh.positions) EXPECT_NEAR(glm::length(p), 1.0f, 1e-6f);
}

TEST(Shapes, BoxesFaceOutwardOrInward) {
  Mesh box, room;
  add_box(box, {0, 0, 0}, {1, 2, 3}, 0);
  add_box(room, {0, 0, 0}, {1, 2, 3}, 0, true);
  finish_mesh(box);
  EXPECT_TRUE(is_closed(box));
  EXPECT_TRUE(is_closed(room));
  EXPECT_NEAR(mesh_volume(box), 6.0, 1e-5);
  EXPECT_NEAR(mesh_volume(room), -6.0, 1e-5);
  EXPECT_NEAR(mesh_area(box), 22.0, 1e-5);
  EXPECT_EQ(box.bounds.max, vec3(1, 2, 3));
}

TEST(ScenesInCode, AreSound) {
  expect_sound(furnace(0.5f, 1.0f));
  expect_sound(furnace(0.5f, 1.0f, true));
  expect_sound(cornell_box());
  expect_sound(cornell_box(CornellVariant::kGlossy));
  expect_sound(one_light(4.0f, 100.0f, 0.5f));
  expect_sound(many_lights(100));
  expect_sound(moving(moving_assets(), 1.0, 0.9));
  expect_sound(alpha_panel());
  expect_sound(textured_quad());
  EXPECT_NE(furnace(0, 1).assets->generation, furnace(0, 1).assets->generation);
}

TEST(ScenesInCode, FurnaceIsClosedAndFacesInward) {
  const FrameSnapshot snapshot = furnace(0.5f, 1.0f, true);
  const std::vector<Mesh>& meshes = snapshot.assets->meshes;
  EXPECT_TRUE(is_closed(meshes[0]));
  EXPECT_LT(mesh_volume(meshes[0]), 0.0);
  for (std::size_t i = 1; i < snapshot.instances.size(); ++i) {
    const Instance& instance = snapshot.instances[i];
    EXPECT_GT(mesh_volume(meshes[instance.mesh]), 0.0);
    const Bounds bounds = transform_bounds(instance.transform, meshes[instance.mesh].bounds);
    EXPECT_TRUE(glm::all(glm::lessThan(bounds.max, vec3(128))) && glm::all(glm::greaterThan(bounds.min, vec3(-128))));
    EXPECT_GT(bounds.min.x, 0.0f) << "the camera at the origin must be outside";
  }
}

TEST(ScenesInCode, FilmIsContinuous) {
  const auto assets = moving_assets();
  const FrameSnapshot a = moving(assets, 1.0, 0.9), b = moving(assets, 1.1, 1.0);
  ASSERT_EQ(a.instances.size(), b.instances.size());
  bool moved = false;
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].transform, b.instances[i].prev_transform);
    EXPECT_EQ(a.instances[i].pose, b.instances[i].prev_pose);
    moved |= a.instances[i].transform != b.instances[i].transform;
  }
  EXPECT_TRUE(moved);
  EXPECT_GT(mesh_volume(assets->meshes[2], 0), 0.0);
  EXPECT_GT(mesh_volume(assets->meshes[2], 1), 0.0);
}

TEST(ScenesInCode, PicturesFaceTheCamera) {
  for (const FrameSnapshot& snapshot : {alpha_panel(), textured_quad()}) {
    const Mesh& mesh = snapshot.assets->meshes[0];
    for (const MeshTriangle& t : mesh.triangles) {
      const vec3 a = mesh.positions[t.vertices[0]];
      const vec3 normal = glm::cross(mesh.positions[t.vertices[1]] - a, mesh.positions[t.vertices[2]] - a);
      EXPECT_LT(normal.x, 0.0f);
    }
    // The texture's first texel is at the top left of the picture: y left, z up.
    const MeshTriangle& last = mesh.triangles.back();
    for (std::size_t k = 0; k < 3; ++k) {
      const vec3 p = mesh.positions[last.vertices[k]];
      EXPECT_NEAR(last.uv[k].x, (64 - p.y) / 128, 1e-6);
      EXPECT_NEAR(last.uv[k].y, (64 - p.z) / 128, 1e-6);
    }
  }
}

}  // namespace
}  // namespace fb::scene
