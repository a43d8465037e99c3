#include "scene/in_code/scenes_of_glass.h"

#include <cmath>

#include "scene/in_code/code_scene_parts.h"
#include "scene/shapes.h"

namespace fb::scene {
namespace {

std::uint32_t add_glass(Assets& assets, std::string name, const vec3& absorption) {
  const std::uint32_t glass = add_material(assets, std::move(name), vec3(0.8f));
  assets.materials[glass].flags = kMaterialDielectric;
  assets.materials[glass].index = 1.5f;
  assets.materials[glass].absorption = absorption;
  return glass;
}

mat4x3 turned_about_x(float degrees, const vec3& origin) {
  const float c = std::cos(radians(degrees)), s = std::sin(radians(degrees));
  return mat4x3(vec3(1, 0, 0), vec3(0, c, s), vec3(0, -s, c), origin);
}

}  // namespace

void add_torus(Mesh& mesh, float radius, float tube, std::uint32_t material, int sides, int facets) {
  for (int side = 0; side < sides; ++side)
    for (int facet = 0; facet < facets; ++facet) {
      const float a = 2.0f * kPi * static_cast<float>(side) / static_cast<float>(sides);
      const float b = 2.0f * kPi * static_cast<float>(facet) / static_cast<float>(facets);
      const vec3 outward(std::cos(a), std::sin(a), 0), normal = outward * std::cos(b) + vec3(0, 0, std::sin(b));
      mesh.positions.push_back(outward * radius + normal * tube);
      mesh.normals.push_back(normal);
    }
  const auto at = [&](int side, int facet) {
    return static_cast<std::uint32_t>(side % sides * facets + facet % facets);
  };
  for (int side = 0; side < sides; ++side)
    for (int facet = 0; facet < facets; ++facet) {
      const std::uint32_t here = at(side, facet), along = at(side + 1, facet), both = at(side + 1, facet + 1);
      mesh.triangles.push_back({{here, along, both}, material, {}});
      mesh.triangles.push_back({{here, both, at(side, facet + 1)}, material, {}});
    }
}

FrameSnapshot torus(float lamp_radius) {
  auto assets = new_code_assets();
  const std::uint32_t wall = add_material(*assets, "wall", vec3(0.6f, 0.55f, 0.5f));
  const std::uint32_t floor = add_material(*assets, "floor", vec3(0.7f));
  const std::uint32_t red = add_material(*assets, "red", vec3(0.7f, 0.12f, 0.1f));
  const std::uint32_t yellow = add_material(*assets, "yellow", vec3(0.75f, 0.6f, 0.1f));
  const std::uint32_t lamp = add_material(*assets, "lamp", vec3(0.0f), vec3(1.0f));
  const std::uint32_t teal = add_glass(*assets, "teal glass", vec3(0.006f, 0.0015f, 0.002f));
  const std::uint32_t clear = add_glass(*assets, "clear glass", vec3(0.0f));

  Mesh room, block, flat_ring, upright_ring, glass_ring;
  add_box(room, {-256, -256, 0}, {256, 256, 256}, wall, true);
  for (MeshTriangle& t : room.triangles) {
    bool below = true;
    for (const std::uint32_t vertex : t.vertices) below &= room.positions[vertex].z == 0.0f;
    if (below) t.material = floor;
  }
  add_box(block, {-64, -52, 1}, {64, 52, 97}, teal);
  add_torus(flat_ring, 30, 9, yellow);
  add_torus(upright_ring, 30, 9, red);
  add_torus(glass_ring, 40, 14, clear);

  FrameSnapshot snapshot = still(assets, camera_at({215, -235, 125}, {22, 129, 0}, 66.0f));
  const auto place = [&](Mesh mesh, const char* name, const mat4x3& transform = mat4x3(1.0f)) {
    const auto id = kIdWorld + static_cast<std::uint32_t>(snapshot.instances.size());
    snapshot.instances.push_back(make_instance(id, add_finished(*assets, std::move(mesh), name), transform));
  };
  place(std::move(room), "room");
  place(std::move(block), "block");
  place(std::move(flat_ring), "ring", turned_about_x(0, {-16, 0, 49}));
  place(std::move(upright_ring), "upright ring", turned_about_x(90, {16, 0, 49}));
  place(std::move(glass_ring), "ring of glass", turned_about_x(12, {70, -115, 24}));
  snapshot.instances.push_back(glowing(kIdEntityLight, add_sphere_mesh(*assets), lamp, {-60, -150, 190},
                                       vec3(lamp_radius), vec3(9000, 8000, 6500) / (lamp_radius * lamp_radius)));
  return snapshot;
}

}  // namespace fb::scene
