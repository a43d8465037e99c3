#include "scene/library/pose_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace fb::scene {
namespace {

// For each vertex the smallest index of those that share its place in every pose.
std::vector<std::uint32_t> welded(const std::vector<vec3>& positions, std::uint32_t vertices) {
  const std::size_t poses = vertices == 0 ? 0 : positions.size() / vertices;
  // -1, 0, 1 as the places of a in all poses come before, are, or come behind those of b.
  const auto compare = [&](std::uint32_t a, std::uint32_t b) {
    for (std::size_t pose = 0; pose < poses; ++pose) {
      const vec3 &p = positions[pose * vertices + a], &q = positions[pose * vertices + b];
      for (int axis = 0; axis < 3; ++axis)
        if (p[axis] != q[axis]) return p[axis] < q[axis] ? -1 : 1;
    }
    return 0;
  };
  std::vector<std::uint32_t> order(vertices);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return compare(a, b) < 0; });
  std::vector<std::uint32_t> first(vertices);
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && compare(order[i - 1], order[i]) == 0 ? first[order[i - 1]] : order[i];
  return first;
}

// Scales of a broken file may be such that products of lengths are none.
bool is_size(float length) { return length > 0.0f && std::isfinite(length); }

float corner_angle(const vec3& at, const vec3& b, const vec3& c) {
  const vec3 u = b - at, v = c - at;
  const float lengths = glm::length(u) * glm::length(v);
  return is_size(lengths) ? std::acos(glm::clamp(glm::dot(u, v) / lengths, -1.0f, 1.0f)) : 0.0f;
}

}  // namespace

PoseNormals::PoseNormals(const std::vector<vec3>& positions, std::uint32_t vertex_count,
                         const std::vector<MeshTriangle>& triangles)
    : positions_(positions),
      vertex_count_(vertex_count),
      triangles_(triangles),
      groups_(vertex_count),
      first_(welded(positions, vertex_count)) {
  for (std::uint32_t v = 0; v < vertex_count; ++v) groups_[first_[v]].push_back(v);
}

std::vector<vec3> PoseNormals::normals(std::uint32_t pose) const {
  const vec3* const at = positions_.data() + std::size_t{pose} * vertex_count_;
  std::vector<vec3> own(vertex_count_, vec3(0.0f)), any(vertex_count_, vec3(0, 0, 1));
  for (const MeshTriangle& triangle : triangles_) {
    std::array<vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = at[triangle.vertices[k]];
    const vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    const float length = glm::length(cross);
    if (!is_size(length)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      own[triangle.vertices[k]] += cross / length * corner_angle(p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
      any[triangle.vertices[k]] = cross / length;
    }
  }
  std::vector<vec3> result(vertex_count_);
  for (std::uint32_t v = 0; v < vertex_count_; ++v) {
    vec3 sum(0.0f);
    for (const std::uint32_t other : groups_[first_[v]])
      if (other == v || glm::dot(own[other], own[v]) > 0.0f) sum += own[other];
    const float length = glm::length(sum);
    // Both sides of a sheet on one vertex cancel: then any side's will do.
    result[v] = length > 1e-4f ? sum / length : any[v];
  }
  return result;
}

}  // namespace fb::scene
