#include "scene/in_code/scenes_of_water.h"

#include <cmath>

#include "scene/in_code/code_scene_parts.h"
#include "scene/shapes.h"

namespace fb::scene {

FrameSnapshot ripple(const Ripple& kind) {
  constexpr float kHalf = 256.0f, kReach = 264.0f;  // the surface goes on within the walls
  constexpr int kCells = 264;
  auto assets = new_code_assets();
  const std::uint32_t tiles = add_material(*assets, "tiles", vec3(0.6f, 0.62f, 0.65f));
  const std::uint32_t sky = add_material(*assets, "sky", vec3(0.0f), vec3(1.0f));
  assets->materials[sky].emission_kind = EmissionKind::kSky;
  const std::uint32_t lamp = add_material(*assets, "lamp", vec3(0.0f), vec3(1.0f));
  const std::uint32_t water = add_material(*assets, "water", vec3(0.1f, 0.2f, 0.25f));
  assets->materials[water].flags = kMaterialLiquid | kMaterialDielectric;
  assets->materials[water].absorption = vec3(0.004f, 0.0015f, 0.001f);
  assets->materials[water].scattering = kind.scattering;

  Mesh room;
  add_box(room, {-kHalf, -kHalf, 0}, {kHalf, kHalf, 320}, tiles, true);
  for (MeshTriangle& t : room.triangles) {
    bool top = true;
    for (const std::uint32_t vertex : t.vertices) top &= room.positions[vertex].z == 320.0f;
    if (top) t.material = sky;
  }
  Mesh surface;
  for (int i = 0; i <= kCells; ++i) {
    const float x = kReach * (2.0f * static_cast<float>(i) / kCells - 1.0f), k = 2.0f * kPi / kRippleLength;
    const float z = kRippleDepth + kRippleHeight * std::cos(k * x);
    const vec3 normal = glm::normalize(vec3(kRippleHeight * k * std::sin(k * x), 0, 1));
    for (const float y : {-kReach, kReach}) {
      surface.positions.emplace_back(x, y, z);
      surface.normals.push_back(normal);
    }
    if (i == kCells) break;
    const auto at = static_cast<std::uint32_t>(2 * i);
    surface.triangles.push_back({{at, at + 2, at + 3}, water, {}});
    surface.triangles.push_back({{at, at + 3, at + 1}, water, {}});
  }

  const std::uint32_t sphere = add_sphere_mesh(*assets);
  const Camera camera =
      kind.above ? camera_at({-230, -30, 240}, {35, 8, 0}, 90.0f) : camera_at({-200, -30, 100}, {35, 8, 0}, 90.0f);
  FrameSnapshot snapshot = still(assets, camera);
  snapshot.instances.push_back(make_instance(kIdWorld, add_finished(*assets, std::move(room), "pool")));
  snapshot.instances.push_back(make_instance(kIdEntity + 1, add_finished(*assets, std::move(surface), "surface")));
  if (kind.lamps) {
    snapshot.instances.push_back(glowing(kIdEntityLight, sphere, lamp, {60, 150, 220}, vec3(12.0f), vec3(20, 14, 8)));
    snapshot.instances.push_back(
        glowing(kIdEntityLight + 1, sphere, lamp, {40, -120, 40}, vec3(8.0f), vec3(8, 14, 20)));
  }
  snapshot.camera_liquid = kind.above ? kNone : water;
  snapshot.sky.mode = SkyMode::kConstant;
  snapshot.sky.color = vec3(0.25f, 0.35f, 0.5f);
  snapshot.sky.suns = {{vec3(0, 0, 1), vec3(9, 8, 6), kind.sun_radius}};
  return snapshot;
}

FrameSnapshot lava_bath() {
  constexpr float kDepth = 12.0f, kGround = -24.0f;
  auto assets = new_code_assets();
  const std::uint32_t stone = add_material(*assets, "stone", vec3(0.45f, 0.42f, 0.4f));
  const std::uint32_t lava = add_material(*assets, "lava", vec3(0.1f), vec3(2.4f, 0.5f, 0.06f));
  const std::uint32_t crust = add_material(*assets, "crust", vec3(0.06f));
  const std::uint32_t water = add_material(*assets, "water", vec3(0.1f));
  assets->materials[water].flags = kMaterialLiquid | kMaterialDielectric;
  assets->materials[water].absorption = vec3(0.004f, 0.0015f, 0.001f);

  // The bath is 192 x 128 in a hall of 384 x 320, with two pillars in it and crusts on the lava.
  const auto in_bath = [](const vec3& p) { return std::fabs(p.x) < 96 && std::fabs(p.y) < 64; };
  BlockGrid grid;
  grid.x = planes(-192, 192, 24);
  grid.y = planes(-160, 160, 20);
  grid.z = {kGround, 0, 128};
  grid.air = [&](const vec3& p) {
    const bool pillar = std::fabs(p.x) > 48 && std::fabs(p.x) < 64 && p.y > 32 && p.y < 48;
    return !pillar && (p.z > 0 || in_bath(p));
  };
  grid.material = [&](const vec3& p, const vec3& normal) {
    if (normal.z < 0.5f || p.z > -1) return stone;
    return std::sin(0.083f * p.x + 0.4f) * std::sin(0.071f * p.y + 1.1f) > 0.25f ? crust : lava;
  };
  Mesh hall, surface;
  add_carved(hall, grid);
  add_quad(surface, {-97, -65, kGround + kDepth}, {194, 0, 0}, {0, 130, 0}, water);
  FrameSnapshot snapshot = still(assets, camera_at({-150, -150, 100}, {33, 44, 0}, 75.0f));
  snapshot.instances.push_back(make_instance(kIdWorld, add_finished(*assets, std::move(hall), "hall")));
  snapshot.instances.push_back(make_instance(kIdEntity + 1, add_finished(*assets, std::move(surface), "surface")));
  return snapshot;
}

}  // namespace fb::scene
