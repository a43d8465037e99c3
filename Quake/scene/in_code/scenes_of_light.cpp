#include "scene/in_code/scenes_of_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/rng.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/shapes.h"

namespace fb::scene {
namespace {

// --- candles ---

enum CandleMesh : std::uint32_t { kHallMesh, kStickMesh, kFlameMesh };
enum CandleMaterial : std::uint32_t { kHallStone, kWax, kFlame };

constexpr float kPillarHalf = 14.0f;
constexpr float kPillarX[] = {-240, -80, 80, 240}, kPillarY[] = {-110, 110};

struct Candle {
  vec3 foot;
  float height;        // of its wax
  float strength;      // mean radiance of the flame
  float speed, phase;  // of its flicker
};

// Half of the candles stand on the floor, half on brackets at the pillars' sides.
std::array<Candle, kCandles> candle_places() {
  std::array<Candle, kCandles> list;
  Rng rng(11);
  for (std::uint32_t i = 0; i < kCandles; ++i) {
    const vec3 pillar(kPillarX[i % 4], kPillarY[(i / 4) % 2], 0.0f);
    const float angle = rng.uniform(0.0f, 2.0f * kPi);
    const vec3 away(std::cos(angle), std::sin(angle), 0.0f);
    Candle& c = list[i];
    c.foot = pillar + away * rng.uniform(30.0f, 70.0f);
    c.height = rng.uniform(6.0f, 16.0f);
    if (i % 2 == 1) {
      const float side = i % 4 == 1 ? 1.0f : -1.0f;
      const float up = rng.uniform(50, 120), along = rng.uniform(-10, 10);
      c.foot = pillar + vec3(along, side * (kPillarHalf + 4.0f), up);
    }
    c.strength = 12.0f * std::pow(30.0f, rng.uniform());
    c.speed = rng.uniform(5.0f, 11.0f);
    c.phase = rng.uniform(0.0f, 2.0f * kPi);
  }
  return list;
}

// Between 0.55 and 1.
float flicker(const Candle& c, double time) {
  const double t = time * c.speed + c.phase;
  return static_cast<float>(0.775 + 0.15 * std::sin(t) + 0.075 * std::sin(2.7 * t + 1.0));
}

mat4x3 flame_transform(const Candle& c, double time) {
  const float half_height = 6.0f * flicker(c, time);
  return placed(c.foot + vec3(0, 0, c.height + 0.5f + 1.04f * half_height), vec3(2.4f, 2.4f, half_height));
}

}  // namespace

std::shared_ptr<const Assets> candle_assets() {
  auto assets = new_code_assets();
  add_material(*assets, "stone", vec3(0.5f, 0.47f, 0.43f));
  add_material(*assets, "wax", vec3(0.75f, 0.7f, 0.6f));
  add_material(*assets, "flame", vec3(0.0f), vec3(1.0f));
  Mesh hall;
  add_box(hall, {-384, -256, 0}, {384, 256, 224}, kHallStone, true);
  for (const float x : kPillarX)
    for (const float y : kPillarY)
      add_box(hall, {x - kPillarHalf, y - kPillarHalf, 0}, {x + kPillarHalf, y + kPillarHalf, 224}, kHallStone);
  Mesh stick;
  add_box(stick, {-1.5f, -1.5f, 0.0f}, {1.5f, 1.5f, 1.0f}, kWax);
  add_finished(*assets, std::move(hall), "hall");
  add_finished(*assets, std::move(stick), "candle");
  add_sphere_mesh(*assets);
  return assets;
}

FrameSnapshot candles(const std::shared_ptr<const Assets>& assets, double time, double prev_time) {
  FrameSnapshot snapshot = still(assets, camera_at({-350, -30, 70}, {4, 8, 0}, 90.0f));
  snapshot.time = time;
  snapshot.prev_time = prev_time;
  snapshot.instances.push_back(make_instance(kIdWorld, kHallMesh));
  const auto places = candle_places();
  for (std::uint32_t i = 0; i < kCandles; ++i) {
    const Candle& c = places[i];
    snapshot.instances.push_back(make_instance(kIdEntity + i, kStickMesh, placed(c.foot, vec3(1, 1, c.height))));
    Instance flame = glowing(kCandleFlame + i, kFlameMesh, kFlame, vec3(0.0f), vec3(1.0f),
                             vec3(1.0f, 0.55f, 0.2f) * (c.strength * flicker(c, time)));
    flame.transform = flame_transform(c, time);
    flame.prev_transform = flame_transform(c, prev_time);
    snapshot.instances.push_back(flame);
  }
  return snapshot;
}

// --- strips ---

FrameSnapshot strips() {
  auto assets = new_code_assets();
  const std::uint32_t walls = add_material(*assets, "walls", vec3(0.7f));
  const std::uint32_t portal = add_material(*assets, "portal", vec3(0.45f, 0.6f, 0.8f));
  const std::uint32_t strip = add_material(*assets, "strip", vec3(0.0f), vec3(45, 49, 54));
  // Room, ledge, recess one behind the other along x. The ledge is `lip` narrower than the recess on every side, and
  // the strip, `width` wide, runs along the recess's edge on the ledge's back.
  const float ledge = kStripsRecess - 16, back = kStripsRecess + 64, half = 144, low = 32, high = 272, lip = 28,
              width = 3;
  BlockGrid grid;
  grid.x = {-384, -256, -128, 0, 64, 160, 256, ledge, kStripsRecess, back};
  grid.y = {-320, -240, -180, -half, -half + width, -half + lip, 0, half - lip, half - width, half, 320};
  grid.z = {0, low, low + width, low + lip, 152, high - lip, high - width, high, 320};
  grid.air = [=](const vec3& p) {
    const bool pillar = p.x > 0 && p.x < 64 && p.y > -240 && p.y < -180;  // something to throw a shadow
    if (p.x < ledge) return !pillar;
    const float inset = p.x < kStripsRecess ? lip : 0.0f;
    return std::abs(p.y) < half - inset && p.z > low + inset && p.z < high - inset;
  };
  grid.material = [=](const vec3& p, const vec3& normal) {
    const bool edge = std::abs(p.y) > half - width || p.z < low + width || p.z > high - width;
    if (p.x == kStripsRecess && normal.x > 0 && edge) return strip;
    return p.x > ledge ? portal : walls;
  };
  Mesh room;
  add_carved(room, grid);
  Mesh box;
  add_box(box, {-40, -40, 0}, {40, 40, 90}, walls);
  FrameSnapshot snapshot = still(assets, camera_at({-340, -150, 150}, {4, 12, 0}, 90.0f));
  snapshot.instances.push_back(make_instance(kIdWorld, add_finished(*assets, std::move(room), "portal room")));
  snapshot.instances.push_back(make_instance(kIdEntity + 1, add_finished(*assets, std::move(box), "box"),
                                             entity_transform({140, 120, 0}, {0, 30, 0})));
  return snapshot;
}

// --- lava ---

FrameSnapshot lava_cave() {
  auto assets = new_code_assets();
  const std::uint32_t rock = add_material(*assets, "rock", vec3(0.32f, 0.27f, 0.24f));
  const std::uint32_t lava = add_material(*assets, "lava", vec3(0.1f), vec3(4.0f, 1.1f, 0.15f));
  const int cells = 12;
  const float side = 64, half = 0.5f * side * static_cast<float>(cells);
  BlockGrid grid;
  grid.x = grid.y = planes(-half, half, cells);
  grid.z = planes(0, 384, 12);
  // Columns of air from the pool, or the causeway's top, to an uneven ceiling; the rim is uneven rock.
  struct Column {
    float floor, ceiling;
  };
  std::vector<Column> columns;
  Rng rng(5);
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const bool rim = i == 0 || j == 0 || i == cells - 1 || j == cells - 1;
      const bool causeway = j == cells / 2 || (i == 8 && j > 2);
      Column c{0.0f, 224.0f + 32.0f * static_cast<float>(rng.below(5))};
      if (causeway) c.floor = 96.0f;
      if (rim && !causeway) c.floor = 32.0f * static_cast<float>(2 + rng.below(5));
      if (!rim && !causeway && rng.below(12) == 0) c.floor = 384.0f;  // a pillar
      columns.push_back(c);
    }
  grid.air = [=](const vec3& p) {
    const int i = static_cast<int>((p.x + half) / side), j = static_cast<int>((p.y + half) / side);
    const Column& c = columns[static_cast<std::size_t>(i * cells + j)];
    return p.z > c.floor && p.z < c.ceiling;
  };
  grid.material = [=](const vec3& p, const vec3& normal) { return normal.z > 0 && p.z == 0 ? lava : rock; };
  Mesh cave;
  add_carved(cave, grid);
  FrameSnapshot snapshot = still(assets, camera_at({-270, 40, 160}, {8, -9, 0}, 90.0f));
  snapshot.instances.push_back(make_instance(kIdWorld, add_finished(*assets, std::move(cave), "cave")));
  return snapshot;
}

// --- three lamps ---

FrameSnapshot three_lamps() {
  auto assets = new_code_assets();
  const std::uint32_t walls = add_material(*assets, "walls", vec3(0.6f));
  const std::uint32_t light = add_material(*assets, "light", vec3(0.0f), vec3(1.0f));
  Mesh room;
  add_box(room, {-256, -256, 0}, {256, 256, 192}, walls, true);
  const std::uint32_t room_mesh = add_finished(*assets, std::move(room), "room");
  const std::uint32_t sphere = add_sphere_mesh(*assets);
  FrameSnapshot snapshot = still(assets, camera_at({-230, 0, 150}, {24, 0, 0}, 90.0f));
  snapshot.instances.push_back(make_instance(kIdWorld, room_mesh));
  for (std::uint32_t i = 0; i < 3; ++i) {
    vec3 radiance(4.0f);
    radiance[static_cast<int>(i)] = 200.0f;
    const vec3 position(20, 130.0f - 130.0f * static_cast<float>(i), 48);
    snapshot.instances.push_back(glowing(kThreeLamps + i, sphere, light, position, vec3(5.0f), radiance));
  }
  return snapshot;
}

}  // namespace fb::scene
