// Meshes that need no file, and measures of meshes. The parts of a mesh go in with the add_ functions; finish_mesh()
// then sets what follows from them.
#pragma once

#include <cstdint>

#include "base/maths.h"
#include "scene/assets.h"

namespace fb::scene {

// A parallelogram seen from the side of cross(edge_u, edge_v); texture coordinates 0..repeats along the two edges.
void add_quad(Mesh& mesh, const vec3& corner, const vec3& edge_u, const vec3& edge_v, std::uint32_t material,
              vec2 repeats = vec2(1.0f));
// An axis-aligned box; `inward`: a room, seen from within.
void add_box(Mesh& mesh, const vec3& min, const vec3& max, std::uint32_t material, bool inward = false);
// The triangles of another rigid mesh, moved by `transform`.
void add_mesh(Mesh& mesh, const Mesh& other, const mat4x3& transform, std::uint32_t material);
// vertex_count and bounds (of all poses).
void finish_mesh(Mesh& mesh);

// 80 triangles, an icosahedron divided once. Its corners lie a little outside the unit sphere (at 1.038), so that its
// area is exactly 4 pi: a convex body of one radiance throws light in proportion to its area (Cauchy), so the mesh
// lights a distant surface as the true sphere does, on average over its orientations, and needs no factor.
Mesh make_sphere();
// Regular, circumradius 1.
Mesh make_tetrahedron();

// The position of a vertex of a rigid mesh, or of a posed one in `pose`.
vec3 vertex_position(const Mesh& mesh, std::uint32_t vertex, std::uint32_t pose = 0);
// Area, and volume within (positive if triangles face outward), in units^2 and units^3.
double mesh_area(const Mesh& mesh, std::uint32_t pose = 0);
double mesh_volume(const Mesh& mesh, std::uint32_t pose = 0);

}  // namespace fb::scene
