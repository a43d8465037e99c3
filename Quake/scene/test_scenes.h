// What tests ask of meshes and of scenes made in code.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "scene/shapes.h"
#include "scene/snapshot.h"

namespace fb::scene {

// Every edge of a closed surface is run through once each way (corners at the same place are one).
inline bool is_closed(const Mesh& mesh) {
  const auto key = [&](std::uint32_t v) {
    const vec3 p = vertex_position(mesh, v);
    return std::array<float, 3>{p.x, p.y, p.z};
  };
  std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> edges;
  for (const MeshTriangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = key(t.vertices[k]), b = key(t.vertices[(k + 1) % 3]);
      ++edges[{a, b}];
      --edges[{b, a}];
    }
  for (const auto& [edge, balance] : edges)
    if (balance != 0) return false;
  return !edges.empty();
}

// How often the surface of a rigid closed mesh runs around a point: 1 inside of a body, -1 in the air of a room (whose
// triangles face inward), 0 outside. The sum of the triangles' solid angles (Van Oosterom and Strackee 1983).
inline double winding(const Mesh& mesh, const vec3& point) {
  double angle = 0;
  for (const MeshTriangle& t : mesh.triangles) {
    glm::dvec3 v[3];
    double length[3];
    for (std::size_t k = 0; k < 3; ++k) {
      v[k] = glm::dvec3(mesh.positions[t.vertices[k]]) - glm::dvec3(point);
      length[k] = glm::length(v[k]);
    }
    const double volume = glm::dot(v[0], glm::cross(v[1], v[2]));
    const double below = length[0] * length[1] * length[2] + glm::dot(v[0], v[1]) * length[2] +
                         glm::dot(v[1], v[2]) * length[0] + glm::dot(v[2], v[0]) * length[1];
    angle += 2.0 * std::atan2(volume, below);
  }
  return angle / (4.0 * 3.14159265358979323846);
}

// Indices lead somewhere and ids are unique.
inline void expect_sound(const FrameSnapshot& snapshot) {
  ASSERT_TRUE(snapshot.assets);
  const Assets& assets = *snapshot.assets;
  std::set<std::uint32_t> ids;
  for (const Instance& instance : snapshot.instances) {
    EXPECT_TRUE(ids.insert(instance.id).second) << "id " << instance.id << " twice";
    ASSERT_LT(instance.mesh, assets.meshes.size());
    const Mesh& mesh = assets.meshes[instance.mesh];
    EXPECT_FALSE(mesh.bounds.empty());
    for (const MeshTriangle& t : mesh.triangles) {
      EXPECT_LT(t.material + instance.material_base, assets.materials.size());
      for (std::uint32_t v : t.vertices) EXPECT_LT(v, mesh.vertex_count);
    }
  }
  for (const Material& material : assets.materials)
    for (const TextureSet& set : material.frames) EXPECT_LT(set.base, assets.images.size());
}

}  // namespace fb::scene
