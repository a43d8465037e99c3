#include "scene/in_code/scenes_in_motion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/in_code/code_scene_parts.h"
#include "scene/shapes.h"

namespace fb::scene {
namespace {

enum FilmMesh : std::uint32_t { kFilmRoom, kLightMesh, kPanelMesh };
constexpr std::uint32_t kLightMaterial = 1;

// A frame of a film of which nothing but lights changes.
FrameSnapshot film_frame(const std::shared_ptr<const Assets>& assets, const Camera& camera, std::uint64_t frame,
                         double frames_per_second) {
  FrameSnapshot snapshot = still(assets, camera);
  snapshot.frame = frame;
  snapshot.time = static_cast<double>(frame) / frames_per_second;
  snapshot.prev_time = frame == 0 ? 0.0 : static_cast<double>(frame - 1) / frames_per_second;
  return snapshot;
}

// --- rocket ---

constexpr vec3 kRocketStart{24, 0, 64};
constexpr float kRocketRadius = 5.0f, kRocketRadiance = 900.0f;
constexpr float kHalfWidth = 80.0f, kBendX = 688.0f;
static_assert(kRocketStart.x + kRocketCorner == kBendX, "it turns in the middle of the second arm");

float rocket_flown(std::uint64_t frame, double frames_per_second) {
  return static_cast<float>(kRocketSpeed * static_cast<double>(frame - kRocketFirstFrame) / frames_per_second);
}
mat4x3 rocket_transform(std::uint64_t frame, double frames_per_second) {
  const float flown = rocket_flown(frame, frames_per_second);
  const vec3 position =
      kRocketStart + vec3(std::min(flown, kRocketCorner), std::max(flown - kRocketCorner, 0.0f), 0.0f);
  return placed(position, vec3(kRocketRadius));
}

}  // namespace

bool rocket_flies(std::uint64_t frame, double frames_per_second) {
  return frame >= kRocketFirstFrame && rocket_flown(frame, frames_per_second) < kRocketEnd;
}

std::shared_ptr<const Assets> rocket_assets() {
  auto assets = new_code_assets();
  const std::uint32_t walls = add_material(*assets, "walls", vec3(0.5f, 0.48f, 0.45f));
  add_material(*assets, "rocket", vec3(0.0f), vec3(1.0f));
  const std::uint32_t panel = add_material(*assets, "panel", vec3(0.3f), vec3(4.0f, 2.0f, 1.0f));
  Mesh corridor;
  BlockGrid grid;
  grid.x = {-128, 0, 128, 256, 384, 512, kBendX - kHalfWidth, kBendX + kHalfWidth};
  grid.y = {-kHalfWidth, 0, kHalfWidth, 240, 400, 640};
  grid.z = {0, 128};
  grid.air = [](const vec3& p) { return p.y < kHalfWidth || p.x > kBendX - kHalfWidth; };
  grid.material = [=](const vec3&, const vec3&) { return walls; };
  add_carved(corridor, grid);
  const float pillars[][2] = {{100, 44}, {200, -44}, {300, 44},  {400, -44},
                              {500, 44}, {648, 200}, {728, 320}, {648, 440}};
  for (const auto& p : pillars) add_box(corridor, {p[0] - 12, p[1] - 12, 0}, {p[0] + 12, p[1] + 12, 128}, walls);
  Mesh panels;  // just off the walls, near the ceiling
  for (const float x : {-60.0f, 250.0f, 450.0f})
    for (const float side : {-1.0f, 1.0f})
      add_quad(panels, {x - side * 6, side * (kHalfWidth - 0.5f), 100}, {0, 0, 6}, {side * -12.0f, 0, 0}, panel);
  add_finished(*assets, std::move(corridor), "corridor");
  add_sphere_mesh(*assets);
  add_finished(*assets, std::move(panels), "panels");
  return assets;
}

FrameSnapshot rocket(const std::shared_ptr<const Assets>& assets, std::uint64_t frame, double frames_per_second) {
  FrameSnapshot snapshot = film_frame(assets, camera_at({-100, -20, 70}, {2, 2, 0}, 90.0f), frame, frames_per_second);
  snapshot.instances.push_back(make_instance(kIdWorld, kFilmRoom));
  snapshot.instances.push_back(make_instance(kIdEntity + 1, kPanelMesh));
  if (!rocket_flies(frame, frames_per_second)) return snapshot;
  Instance light =
      glowing(kRocket, kLightMesh, kLightMaterial, vec3(0.0f), vec3(1.0f), vec3(1.0f, 0.75f, 0.45f) * kRocketRadiance);
  light.transform = rocket_transform(frame, frames_per_second);
  const bool is_new = !rocket_flies(frame - 1, frames_per_second);
  light.prev_transform = is_new ? light.transform : rocket_transform(frame - 1, frames_per_second);
  if (is_new) light.flags |= kInstanceNew;
  snapshot.instances.push_back(light);
  return snapshot;
}

// --- lights out ---

namespace {

constexpr std::array<vec3, 6> kWeakPlaces{vec3(-150, 170, 40), vec3(120, 200, 60),  vec3(210, -30, 30),
                                          vec3(60, -200, 50),  vec3(-90, -190, 20), vec3(20, 60, 15)};
constexpr float kLampRadius = 10.0f, kWeakRadius = 5.0f, kLampRadiance = 160.0f, kWeakRadiance = 3.0f;

}  // namespace

std::shared_ptr<const Assets> lights_out_assets() {
  auto assets = new_code_assets();
  const std::uint32_t walls = add_material(*assets, "walls", vec3(0.55f));
  add_material(*assets, "light", vec3(0.0f), vec3(1.0f));
  Mesh room;
  add_box(room, {-256, -256, 0}, {256, 256, 192}, walls, true);
  for (const float x : {-100.0f, 100.0f})
    for (const float y : {-110.0f, 110.0f}) add_box(room, {x - 16, y - 16, 0}, {x + 16, y + 16, 192}, walls);
  add_finished(*assets, std::move(room), "room");
  add_sphere_mesh(*assets);
  return assets;
}

FrameSnapshot lights_out(const std::shared_ptr<const Assets>& assets, std::uint64_t frame, double frames_per_second) {
  FrameSnapshot snapshot = film_frame(assets, camera_at({-230, -20, 90}, {6, 3, 0}, 90.0f), frame, frames_per_second);
  snapshot.instances.push_back(make_instance(kIdWorld, kFilmRoom));
  const auto add_light = [&](std::uint32_t id, const vec3& position, float radius, const vec3& radiance) {
    snapshot.instances.push_back(glowing(id, kLightMesh, kLightMaterial, position, vec3(radius), radiance));
  };
  for (std::uint32_t i = 0; i < kWeakPlaces.size(); ++i)
    add_light(kLightsOutWeak + i, kWeakPlaces[i], kWeakRadius, vec3(1.0f, 0.7f, 0.4f) * kWeakRadiance);
  if (frame < kLightsOutFrame) add_light(kLightsOutLamp, {40, 0, 150}, kLampRadius, vec3(kLampRadiance));
  return snapshot;
}

// --- occluder ---

namespace {

constexpr float kPlateHeight = 110.0f, kLampHeight = 176.0f;

mat4x3 plate_transform(double time) {
  return placed({30, static_cast<float>(80 * std::sin(2 * time)), kPlateHeight}, {40, 40, 2});
}

}  // namespace

std::shared_ptr<const Assets> occluder_assets() {
  auto assets = new_code_assets();
  const std::uint32_t walls = add_material(*assets, "walls", vec3(0.5f));
  add_material(*assets, "light", vec3(0.0f), vec3(1.0f));
  Mesh room;
  add_box(room, {-256, -256, 0}, {256, 256, 192}, walls, true);
  Mesh plate;
  add_box(plate, vec3(-1.0f), vec3(1.0f), walls);
  add_finished(*assets, std::move(room), "room");
  add_sphere_mesh(*assets);
  add_finished(*assets, std::move(plate), "plate");
  return assets;
}

FrameSnapshot occluder(const std::shared_ptr<const Assets>& assets, double time, double prev_time) {
  FrameSnapshot snapshot = still(assets, camera_at({-230, 0, 150}, {24, 0, 0}, 90.0f));
  snapshot.time = time;
  snapshot.prev_time = prev_time;
  snapshot.instances.push_back(make_instance(kIdWorld, kFilmRoom));
  Instance plate = make_instance(kOccluder, kPanelMesh, plate_transform(time));
  plate.prev_transform = plate_transform(prev_time);
  snapshot.instances.push_back(plate);
  const auto add_light = [&](std::uint32_t id, const vec3& position, float radius, float radiance) {
    snapshot.instances.push_back(
        glowing(id, kLightMesh, kLightMaterial, position, vec3(radius), vec3(1.0f, 0.9f, 0.7f) * radiance));
  };
  add_light(kOccluderLamp, {30, 0, kLampHeight}, 5.0f, 400.0f);
  add_light(kOccluderLamp + 1, {-150, 190, 60}, 5.0f, 4.0f);
  return snapshot;
}

}  // namespace fb::scene
