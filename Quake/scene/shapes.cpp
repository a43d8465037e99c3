#include "scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace fb::scene {
namespace {

std::uint32_t add_vertex(Mesh& mesh, const vec3& position) {
  mesh.positions.push_back(position);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh.triangles.push_back({{a, b, c}, 0, {vec2(0, 0), vec2(1, 0), vec2(0, 1)}});
}

glm::dvec3 position64(const Mesh& mesh, const MeshTriangle& triangle, std::size_t corner, std::uint32_t pose) {
  return glm::dvec3(vertex_position(mesh, triangle.vertices[corner], pose));
}

}  // namespace

void add_quad(Mesh& mesh, const vec3& corner, const vec3& edge_u, const vec3& edge_v, std::uint32_t material,
              vec2 repeats) {
  const std::uint32_t a = add_vertex(mesh, corner), b = add_vertex(mesh, corner + edge_u);
  const std::uint32_t c = add_vertex(mesh, corner + edge_u + edge_v), d = add_vertex(mesh, corner + edge_v);
  const vec2 ua(0, 0), ub(repeats.x, 0), uc = repeats, ud(0, repeats.y);
  mesh.triangles.push_back({{a, b, c}, material, {ua, ub, uc}});
  mesh.triangles.push_back({{a, c, d}, material, {ua, uc, ud}});
}

void add_box(Mesh& mesh, const vec3& min, const vec3& max, std::uint32_t material, bool inward) {
  const vec3 size = max - min;
  for (int axis = 0; axis < 3; ++axis) {
    vec3 u(0.0f), v(0.0f), w(0.0f);
    u[(axis + 1) % 3] = size[(axis + 1) % 3];
    v[(axis + 2) % 3] = size[(axis + 2) % 3];
    w[axis] = size[axis];
    if (inward) std::swap(u, v);
    add_quad(mesh, min + w, u, v, material);  // cross(u, v) is along +axis
    add_quad(mesh, min, v, u, material);
  }
}

void add_mesh(Mesh& mesh, const Mesh& other, const mat4x3& transform, std::uint32_t material) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const vec3& p : other.positions) mesh.positions.push_back(transform_point(transform, p));
  for (MeshTriangle triangle : other.triangles) {
    for (std::uint32_t& v : triangle.vertices) v += first;
    triangle.material = material;
    mesh.triangles.push_back(triangle);
  }
}

void finish_mesh(Mesh& mesh) {
  if (!mesh.posed()) mesh.vertex_count = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.bounds = Bounds();
  for (std::uint32_t pose = 0; pose < (mesh.posed() ? mesh.pose_count : 1u); ++pose)
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) mesh.bounds.add(vertex_position(mesh, v, pose));
}

Mesh make_sphere() {
  Mesh mesh;
  mesh.name = "sphere";
  const float phi = 0.5f * (1.0f + std::sqrt(5.0f));
  // Corners of three golden rectangles.
  for (int axis = 0; axis < 3; ++axis)
    for (float s : {-1.0f, 1.0f})
      for (float t : {-phi, phi}) {
        vec3 p(0.0f);
        p[axis] = s;
        p[(axis + 1) % 3] = t;
        add_vertex(mesh, glm::normalize(p));
      }
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, added] = middles.try_emplace(std::minmax(a, b), 0u);
    if (added) at->second = add_vertex(mesh, glm::normalize(mesh.positions[a] + mesh.positions[b]));
    return at->second;
  };
  // The icosahedron's faces are the triples of corners at its edge's length from each other.
  const float edge = 2.0f / std::sqrt(1.0f + phi * phi), limit = edge * 1.1f;
  const auto near_each_other = [&](std::uint32_t a, std::uint32_t b) {
    return glm::length(mesh.positions[a] - mesh.positions[b]) < limit;
  };
  for (std::uint32_t a = 0; a < 12; ++a)
    for (std::uint32_t b = a + 1; b < 12; ++b)
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!near_each_other(a, b) || !near_each_other(b, c) || !near_each_other(c, a)) continue;
        std::uint32_t p = b, q = c;
        const vec3 normal = glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
        if (glm::dot(normal, mesh.positions[a]) < 0.0f) std::swap(p, q);
        const std::uint32_t ap = middle(a, p), pq = middle(p, q), qa = middle(q, a);
        add_triangle(mesh, a, ap, qa);
        add_triangle(mesh, ap, p, pq);
        add_triangle(mesh, qa, pq, q);
        add_triangle(mesh, ap, pq, qa);
      }
  const auto scale = static_cast<float>(std::sqrt(4.0 * 3.14159265358979323846 / mesh_area(mesh)));
  for (vec3& p : mesh.positions) p *= scale;
  finish_mesh(mesh);
  return mesh;
}

Mesh make_tetrahedron() {
  Mesh mesh;
  mesh.name = "tetrahedron";
  const float k = 1.0f / std::sqrt(3.0f);
  for (const vec3& corner : {vec3(1, 1, 1), vec3(1, -1, -1), vec3(-1, 1, -1), vec3(-1, -1, 1)})
    add_vertex(mesh, corner * k);
  add_triangle(mesh, 0, 1, 2);
  add_triangle(mesh, 0, 2, 3);
  add_triangle(mesh, 0, 3, 1);
  add_triangle(mesh, 1, 3, 2);
  finish_mesh(mesh);
  return mesh;
}

vec3 vertex_position(const Mesh& mesh, std::uint32_t vertex, std::uint32_t pose) {
  if (!mesh.posed()) return mesh.positions[vertex];
  return pose_numbers(mesh.poses[static_cast<std::size_t>(pose) * mesh.vertex_count + vertex]) * mesh.pose_scale +
         mesh.pose_origin;
}

double mesh_area(const Mesh& mesh, std::uint32_t pose) {
  double area = 0.0;
  for (const MeshTriangle& t : mesh.triangles) {
    const glm::dvec3 a = position64(mesh, t, 0, pose);
    area += 0.5 * glm::length(glm::cross(position64(mesh, t, 1, pose) - a, position64(mesh, t, 2, pose) - a));
  }
  return area;
}

double mesh_volume(const Mesh& mesh, std::uint32_t pose) {
  double volume = 0.0;
  for (const MeshTriangle& t : mesh.triangles)
    volume +=
        glm::dot(position64(mesh, t, 0, pose), glm::cross(position64(mesh, t, 1, pose), position64(mesh, t, 2, pose))) /
        6.0;
  return volume;
}

}  // namespace fb::scene
