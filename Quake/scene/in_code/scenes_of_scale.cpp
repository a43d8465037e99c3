#include "scene/in_code/scenes_of_scale.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/rng.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/shapes.h"

namespace fb::scene {
namespace {

constexpr float kHalf = 512.0f, kHeight = 256.0f;
constexpr std::uint32_t kRoomTriangles = 12 + 2;  // walls, lamp
enum Part : std::uint32_t { kHall, kBox };

void add_hall(Mesh& room, std::uint32_t walls, std::uint32_t lamp) {
  add_box(room, {-kHalf, -kHalf, 0}, {kHalf, kHalf, kHeight}, walls, true);
  add_quad(room, {-64, -64, kHeight - 1}, {0, 128, 0}, {128, 0, 0}, lamp);
}

Camera hall_camera() { return camera_at({-480, -400, 160}, {15, 40, 0}, 90.0f); }

void add_triangle(Mesh& mesh, const vec3& a, const vec3& b, const vec3& c, std::uint32_t material) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const vec3& corner : {a, b, c}) mesh.positions.push_back(corner);
  mesh.triangles.push_back({{first, first + 1, first + 2}, material, {}});
}

float wave(float x, float y) { return 6.0f + 3.0f * std::sin(0.05f * x) + 3.0f * std::sin(0.07f * y); }

}  // namespace

FrameSnapshot many_triangles(std::uint32_t count) {
  auto assets = new_code_assets();
  const std::uint32_t walls = add_material(*assets, "walls", vec3(0.6f));
  const std::uint32_t lamp = add_material(*assets, "lamp", vec3(0.0f), vec3(20.0f));
  Mesh room;
  add_hall(room, walls, lamp);
  const std::uint32_t wanted = std::max(count, 100u) - kRoomTriangles;
  const auto columns = static_cast<std::uint32_t>(std::sqrt(0.5 * wanted));
  const std::uint32_t rows = (wanted / 2 + columns - 1) / columns;
  const float dx = 2.0f * kHalf / static_cast<float>(columns), dy = 2.0f * kHalf / static_cast<float>(rows);
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const float x = -kHalf + dx * static_cast<float>(column), y = -kHalf + dy * static_cast<float>(row);
      const vec3 a(x, y, wave(x, y)), b(x + dx, y, wave(x + dx, y)), c(x, y + dy, wave(x, y + dy));
      const vec3 d(x + dx, y + dy, wave(x + dx, y + dy));
      add_triangle(room, a, b, d, walls);
      add_triangle(room, a, d, c, walls);
    }
  }
  const std::uint32_t mesh = add_finished(*assets, std::move(room), "hall");
  FrameSnapshot snapshot = still(assets, hall_camera());
  snapshot.instances.push_back(make_instance(kIdWorld, mesh));
  return snapshot;
}

std::shared_ptr<const Assets> many_movers_assets() {
  auto assets = new_code_assets();
  const std::uint32_t walls = add_material(*assets, "walls", vec3(0.6f));
  const std::uint32_t lamp = add_material(*assets, "lamp", vec3(0.0f), vec3(20.0f));
  Mesh room, box;
  add_hall(room, walls, lamp);
  add_box(box, vec3(-6.0f), vec3(6.0f), walls);
  add_finished(*assets, std::move(room), "hall");
  add_finished(*assets, std::move(box), "box");
  return assets;
}

FrameSnapshot many_movers(const std::shared_ptr<const Assets>& assets, std::uint32_t count, double time,
                          double prev_time) {
  FrameSnapshot snapshot = still(assets, hall_camera());
  snapshot.time = time;
  snapshot.prev_time = prev_time;
  snapshot.instances.push_back(make_instance(kIdWorld, kHall));
  Rng rng(5);
  for (std::uint32_t i = 0; i < count; ++i) {
    const float radius = rng.uniform(40, 480), height = rng.uniform(20, 230);
    const float phase = rng.uniform(0, 6.2831853f), speed = rng.uniform(-1, 1);
    const auto at = [&](double t) {
      const float angle = phase + speed * static_cast<float>(t);
      return entity_transform({radius * std::cos(angle), radius * std::sin(angle), height}, {0, degrees(angle), 0});
    };
    Instance instance = make_instance(kIdEntity + i, kBox, at(time));
    instance.prev_transform = at(prev_time);
    snapshot.instances.push_back(instance);
  }
  return snapshot;
}

}  // namespace fb::scene
