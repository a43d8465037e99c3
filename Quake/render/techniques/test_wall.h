// A scene of tests: a wall across the whole picture and one lamp.
#pragma once

#include <cstdint>
#include <utility>

#include "scene/in_code/code_scene_parts.h"
#include "scene/shapes.h"

namespace fb::render {

// The wall is 100 units away; where no place is told the lamp is behind the camera.
inline scene::FrameSnapshot wall_under_a_lamp(const vec3& position = vec3(-20, 0, 0), float radius = 16,
                                              float radiance = 300) {
  auto assets = scene::new_code_assets();
  const std::uint32_t wall = scene::add_material(*assets, "wall", vec3(0.6f));
  const std::uint32_t light = scene::add_material(*assets, "light", vec3(0.0f), vec3(1.0f));
  scene::Mesh mesh;
  scene::add_box(mesh, vec3(100, -400, -400), vec3(110, 400, 400), wall);
  const std::uint32_t wall_mesh = scene::add_finished(*assets, std::move(mesh), "wall");
  const std::uint32_t sphere = scene::add_sphere_mesh(*assets);
  scene::FrameSnapshot snapshot = scene::still(assets, scene::camera_at(vec3(0.0f), vec3(0.0f), 90.0f));
  snapshot.instances.push_back(scene::make_instance(scene::kIdWorld, wall_mesh));
  snapshot.instances.push_back(
      scene::glowing(scene::kIdEntityLight, sphere, light, position, vec3(radius), vec3(radiance)));
  return snapshot;
}

}  // namespace fb::render
