// Normals of a model's vertices in each pose, made from its triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "base/maths.h"
#include "scene/assets.h"

namespace fb::scene {

// A vertex' normal is the mean of its triangles' weighted by their corners' angles. Vertices at the same place in every
// pose are smoothed together unless they face away from each other.
class PoseNormals {
 public:
  // `positions`: units, pose-major, kept. `triangles` face the side from which they run counter-clockwise; kept.
  PoseNormals(const std::vector<vec3>& positions, std::uint32_t vertex_count,
              const std::vector<MeshTriangle>& triangles);

  // Unit normals of all vertices in a pose; up for a vertex of no triangle.
  std::vector<vec3> normals(std::uint32_t pose) const;

 private:
  const std::vector<vec3>& positions_;
  std::uint32_t vertex_count_;
  const std::vector<MeshTriangle>& triangles_;
  std::vector<std::vector<std::uint32_t>> groups_;
  std::vector<std::uint32_t> first_;
};

}  // namespace fb::scene
