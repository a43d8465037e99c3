#include "scene/in_code/scenes_of_fog.h"

#include <cmath>
#include <utility>

#include "scene/in_code/code_scene_parts.h"

namespace fb::scene {

FrameSnapshot slab(float extinction, float g) {
  auto assets = new_code_assets();
  const std::uint32_t lamp = add_material(*assets, "lamp", vec3(0.0f), vec3(1.0f));
  const std::uint32_t sphere = add_sphere_mesh(*assets);
  FrameSnapshot snapshot = still(assets, camera_at(vec3(0.0f), vec3(0.0f), 60.0f));
  snapshot.instances.push_back(glowing(kIdEntityLight, sphere, lamp, kSlabLamp, vec3(kSlabRadius), kSlabRadiance));
  snapshot.medium.extinction = extinction;
  snapshot.medium.albedo = vec3(0.9f, 0.8f, 0.6f);
  snapshot.medium.g = g;
  return snapshot;
}

FrameSnapshot window() {
  auto assets = new_code_assets();
  const std::uint32_t walls = add_material(*assets, "walls", vec3(0.45f, 0.42f, 0.4f));
  const std::uint32_t sky = add_material(*assets, "sky", vec3(0.0f), vec3(1.0f));
  assets->materials[sky].emission_kind = EmissionKind::kSky;
  // The window is from x = 160 to 352; its two bars are 24 wide, and the wall that they stand in 16 thick.
  const float outside = kWindowWall + 16.0f;
  BlockGrid grid;
  grid.x = {0, 80, 160, 208, 232, 280, 304, 352, 432, 512};
  grid.y = {-kWindowWall, -64, 64, kWindowWall, outside};
  grid.z = {0, 96, 160, 224, 256};
  grid.air = [=](const vec3& p) {
    const bool bar = (p.x > 208 && p.x < 232) || (p.x > 280 && p.x < 304);
    return p.y < kWindowWall || (p.x > 160 && p.x < 352 && p.z > 96 && p.z < 224 && !bar);
  };
  grid.material = [=](const vec3& p, const vec3&) { return p.y == outside ? sky : walls; };
  Mesh hall;
  add_carved(hall, grid);
  FrameSnapshot snapshot = still(assets, camera_at({390, -180, 60}, {-10, 112, 0}, 80.0f));
  snapshot.instances.push_back(make_instance(kIdWorld, add_finished(*assets, std::move(hall), "hall")));
  snapshot.sky.mode = SkyMode::kConstant;
  snapshot.sky.color = vec3(0.0f);
  snapshot.sky.suns = {{glm::normalize(vec3(-0.15f, 0.8f, 0.55f)), vec3(24, 21, 16), 6.0f}};
  snapshot.medium.extinction = 0.003f;
  snapshot.medium.albedo = vec3(0.9f);
  snapshot.medium.g = 0.4f;
  return snapshot;
}

}  // namespace fb::scene
