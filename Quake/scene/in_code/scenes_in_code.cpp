#include "scene/in_code/scenes_in_code.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/rng.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/shapes.h"

namespace fb::scene {

formats::Palette code_palette() {
  formats::Palette palette;
  for (std::size_t i = 0; i < 256; ++i)
    palette.rgb[i] = {static_cast<std::uint8_t>(17 * (i % 16)), static_cast<std::uint8_t>(17 * (i / 16)),
                      static_cast<std::uint8_t>(255 - i)};
  return palette;
}

FrameSnapshot furnace(float albedo, float emission, bool objects) {
  auto assets = new_code_assets();
  const std::uint32_t walls = add_material(*assets, "furnace", vec3(albedo), vec3(emission));
  Mesh room;
  add_box(room, vec3(-128.0f), vec3(128.0f), walls, true);
  FrameSnapshot snapshot = still(assets, camera_at(vec3(0.0f), vec3(0.0f), 90.0f));
  snapshot.instances.push_back(make_instance(kIdWorld, add_finished(*assets, std::move(room), "furnace")));
  if (objects) {
    Mesh box;
    add_box(box, vec3(-1.0f), vec3(1.0f), walls);
    const std::uint32_t box_mesh = add_finished(*assets, std::move(box), "box");
    const std::uint32_t sphere = add_sphere_mesh(*assets);
    const std::uint32_t tetrahedron = add_finished(*assets, make_tetrahedron(), "tetrahedron");
    snapshot.instances.push_back(
        make_instance(kIdEntity + 1, box_mesh, entity_transform({80, 30, -20}, {20, 30, 40}, 16)));
    snapshot.instances.push_back(make_instance(kIdEntity + 2, sphere, placed({90, -30, 10}, vec3(24, 16, 20))));
    snapshot.instances.push_back(
        make_instance(kIdEntity + 3, tetrahedron, entity_transform({60, 0, 30}, {0, 70, 10}, 20)));
  }
  return snapshot;
}

FrameSnapshot cornell_box(CornellVariant variant) {
  auto assets = new_code_assets();
  const std::uint32_t white = add_material(*assets, "white", vec3(0.73f));
  const std::uint32_t red = add_material(*assets, "red", vec3(0.63f, 0.065f, 0.05f));
  const std::uint32_t green = add_material(*assets, "green", vec3(0.14f, 0.45f, 0.091f));
  const std::uint32_t lamp = add_material(*assets, "lamp", vec3(0.78f), vec3(17, 12, 4));
  const std::uint32_t floor = add_material(*assets, "floor", vec3(0.73f));
  const std::uint32_t tall = add_material(*assets, "tall box", vec3(0.73f));
  if (variant == CornellVariant::kGlossy) {
    assets->materials[floor].specular = 0.04f;
    assets->materials[floor].roughness = 0.3f;
    assets->materials[tall].base_color = vec3(0.91f, 0.78f, 0.34f);
    assets->materials[tall].metalness = 1.0f;
    assets->materials[tall].roughness = 0.4f;
  }
  // x runs away from the camera, y to its left, z up.
  const float side = 560.0f, half = 0.5f * side;
  const vec3 x(side, 0, 0), y(0, side, 0), z(0, 0, side);
  Mesh room;
  add_quad(room, {0, -half, 0}, x, y, floor);
  add_quad(room, {0, -half, side}, y, x, white);
  add_quad(room, {side, -half, 0}, z, y, white);
  add_quad(room, {0, half, 0}, x, z, red);
  add_quad(room, {0, -half, 0}, z, x, green);
  add_quad(room, {227, -65, side - 1}, {0, 130, 0}, {105, 0, 0}, lamp);
  Mesh box;
  add_box(box, vec3(-0.5f, -0.5f, 0.0f), vec3(0.5f, 0.5f, 1.0f), 0);
  const std::uint32_t room_mesh = add_finished(*assets, std::move(room), "cornell box");
  const std::uint32_t box_mesh = add_finished(*assets, std::move(box), "box");

  FrameSnapshot snapshot = still(assets, camera_at({-800, 0, half}, vec3(0.0f), 39.3f));
  snapshot.instances.push_back(make_instance(kIdWorld, room_mesh));
  const auto add_box_instance = [&](std::uint32_t id, const vec3& origin, float yaw, const vec3& size,
                                    std::uint32_t material) {
    mat4x3 transform = entity_transform(origin, {0, yaw, 0});
    for (int axis = 0; axis < 3; ++axis) transform[axis] *= size[axis];
    Instance instance = make_instance(id, box_mesh, transform);
    instance.material_base = material;
    snapshot.instances.push_back(instance);
  };
  add_box_instance(kIdEntity + 1, {350, 90, 0}, 17.0f, {165, 165, 330}, tall);
  add_box_instance(kIdEntity + 2, {170, -95, 0}, -16.5f, {165, 165, 165}, white);
  return snapshot;
}

FrameSnapshot one_light(float radius, float radiance, float albedo) {
  auto assets = new_code_assets();
  const std::uint32_t walls = add_material(*assets, "walls", vec3(albedo));
  const std::uint32_t light = add_material(*assets, "light", vec3(0.0f), vec3(1.0f));
  Mesh room;
  add_box(room, vec3(-128.0f), vec3(128.0f), walls, true);
  const std::uint32_t room_mesh = add_finished(*assets, std::move(room), "room");
  const std::uint32_t sphere = add_sphere_mesh(*assets);
  FrameSnapshot snapshot = still(assets, camera_at({-60, 0, 120}, {60, 0, 0}, 90.0f));
  snapshot.instances.push_back(make_instance(kIdWorld, room_mesh));
  snapshot.instances.push_back(glowing(kIdEntityLight, sphere, light, vec3(0.0f), vec3(radius), vec3(radiance)));
  return snapshot;
}

FrameSnapshot many_lights(std::uint32_t count, std::uint64_t seed) {
  auto assets = new_code_assets();
  const std::uint32_t walls = add_material(*assets, "walls", vec3(0.6f));
  const std::uint32_t light = add_material(*assets, "light", vec3(0.0f), vec3(1.0f));
  Mesh room;
  add_box(room, {-512, -512, 0}, {512, 512, 256}, walls, true);
  // Pillars, so that lights have shadows.
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      const vec3 centre(static_cast<float>(i) * 256.0f, static_cast<float>(j) * 256.0f, 0.0f);
      add_box(room, centre - vec3(16, 16, 0), centre + vec3(16, 16, 256), walls);
    }
  const std::uint32_t room_mesh = add_finished(*assets, std::move(room), "hall");
  const std::uint32_t sphere = add_sphere_mesh(*assets);
  FrameSnapshot snapshot = still(assets, camera_at({-480, -400, 128}, {5, 40, 0}, 90.0f));
  snapshot.instances.push_back(make_instance(kIdWorld, room_mesh));
  Rng rng(seed);
  for (std::uint32_t i = 0; i < count; ++i) {
    // One by one: the order of a call's arguments is the compiler's, and the scene is to be the same by all.
    const float z = rng.uniform(10, 246), y = rng.uniform(-500, 500), x = rng.uniform(-500, 500);
    const float blue = rng.uniform(0.2f, 1.0f), green = rng.uniform(0.2f, 1.0f), red = rng.uniform(0.2f, 1.0f);
    const vec3 position(x, y, z), color(red, green, blue);
    snapshot.instances.push_back(glowing(kIdEntityLight + i, sphere, light, position, vec3(4.0f), color * 100.0f));
  }
  return snapshot;
}

namespace {

enum MovingMesh : std::uint32_t { kRoomMesh, kBoxMesh, kPosedMesh, kViewMesh };

// A pyramid that in its second pose is lower, wider and leans over.
Mesh posed_pyramid(std::uint32_t material) {
  Mesh mesh;
  mesh.vertex_count = 5;
  mesh.pose_count = 2;
  mesh.pose_scale = vec3(0.25f);
  mesh.pose_origin = vec3(-32.0f, -32.0f, 0.0f);
  const std::uint8_t poses[2][5][3] = {{{64, 64, 0}, {192, 64, 0}, {192, 192, 0}, {64, 192, 0}, {128, 128, 240}},
                                       {{32, 32, 0}, {224, 32, 0}, {224, 224, 0}, {32, 224, 0}, {220, 90, 140}}};
  mesh.triangles = {{{0, 1, 4}, material, {}}, {{1, 2, 4}, material, {}}, {{2, 3, 4}, material, {}},
                    {{3, 0, 4}, material, {}}, {{0, 2, 1}, material, {}}, {{0, 3, 2}, material, {}}};
  for (const auto& pose : poses)
    for (const auto& p : pose) {
      const vec3 outward = vec3(p[0], p[1], p[2]) - vec3(128, 128, 60);
      mesh.poses.push_back(make_pose_vertex(p[0], p[1], p[2], glm::normalize(outward)));
    }
  return mesh;
}

Camera moving_camera(double time) {
  const auto t = static_cast<float>(time);
  return camera_at({-180, 20.0f * std::sin(t), 100}, {8, 6.0f * std::sin(0.7f * t), 0}, 90.0f);
}
mat4x3 moving_box(double time) {
  const auto t = static_cast<float>(time);
  return entity_transform({60, 70 + 30 * std::sin(t), 60 + 20 * std::cos(1.3f * t)}, {40 * t, 70 * t, 25 * t});
}
mat4x3 moving_posed(double time) {
  const auto t = static_cast<float>(time);
  return entity_transform({40 + 25 * std::cos(t), -70, 0}, {0, 50 * t, 0});
}
PoseBlend moving_pose(double time) { return {0, 1, static_cast<float>(0.5 - 0.5 * std::cos(2.0 * time))}; }
mat4x3 moving_view_model(double time) {
  const Camera camera = moving_camera(time);
  const AxisVectors axes = angle_vectors(camera.angles);
  return entity_transform(camera.position + axes.forward * 24.0f + axes.right * 8.0f - axes.up * 8.0f, camera.angles);
}

}  // namespace

std::shared_ptr<const Assets> moving_assets() {
  auto assets = new_code_assets();
  Image chequer{"chequer", ImageEncoding::kPalette, 8, 8, {}};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) chequer.texels.push_back((x + y) % 2 == 0 ? 0xdd : 0x55);
  assets->images.push_back(std::move(chequer));
  const std::uint32_t walls = add_material(*assets, "walls", vec3(1.0f));
  assets->materials[walls].frames = {TextureSet{0}};
  assets->materials[walls].flags = kMaterialNoFullbright;
  const std::uint32_t lamp = add_material(*assets, "lamp", vec3(0.5f), vec3(6.0f));
  const std::uint32_t things = add_material(*assets, "things", vec3(0.7f, 0.5f, 0.3f));
  Mesh room;
  add_box(room, {-256, -256, 0}, {256, 256, 256}, walls, true);
  add_quad(room, {-64, -64, 255}, {0, 128, 0}, {128, 0, 0}, lamp);
  Mesh box;
  add_box(box, vec3(-20.0f), vec3(20.0f), things);
  Mesh view;
  add_box(view, {-12, -2, -2}, {12, 2, 2}, things);
  add_finished(*assets, std::move(room), "room");
  add_finished(*assets, std::move(box), "box");
  add_finished(*assets, posed_pyramid(things), "pyramid");
  add_finished(*assets, std::move(view), "view model");
  return assets;
}

FrameSnapshot moving(const std::shared_ptr<const Assets>& assets, double time, double prev_time) {
  FrameSnapshot snapshot = still(assets, moving_camera(time));
  snapshot.prev_camera = moving_camera(prev_time);
  snapshot.time = time;
  snapshot.prev_time = prev_time;
  snapshot.instances.push_back(make_instance(kIdWorld, kRoomMesh));
  const auto add_moving = [&](std::uint32_t id, std::uint32_t mesh, mat4x3 (*transform)(double)) -> Instance& {
    Instance& instance = snapshot.instances.emplace_back(make_instance(id, mesh, transform(time)));
    instance.prev_transform = transform(prev_time);
    return instance;
  };
  add_moving(kMovingBox, kBoxMesh, moving_box);
  Instance& posed = add_moving(kMovingPosed, kPosedMesh, moving_posed);
  posed.pose = moving_pose(time);
  posed.prev_pose = moving_pose(prev_time);
  Instance& view = add_moving(kMovingViewModel, kViewMesh, moving_view_model);
  view.visibility = kSeenByCamera;
  view.flags = kInstanceViewModel;
  return snapshot;
}

namespace {

// A square of side 128 at x = 100, upright before a camera that looks along +x and facing it.
void add_picture(Mesh& mesh, std::uint32_t material) {
  const std::size_t first = mesh.triangles.size();
  add_quad(mesh, {100, 64, 64}, {0, -128, 0}, {0, 0, -128}, material);  // image right is -y, down is -z
  for (std::size_t i = first; i < mesh.triangles.size(); ++i) {
    std::swap(mesh.triangles[i].vertices[1], mesh.triangles[i].vertices[2]);
    std::swap(mesh.triangles[i].uv[1], mesh.triangles[i].uv[2]);
  }
}

}  // namespace

FrameSnapshot alpha_panel() {
  auto assets = new_code_assets();
  Image holes{"{holes", ImageEncoding::kPalette, 8, 8, {}};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) holes.texels.push_back((x + y) % 2 == 0 ? 255 : 0x11);
  assets->images.push_back(std::move(holes));
  const std::uint32_t wall = add_material(*assets, "wall", vec3(0.0f), vec3(1.0f));
  const std::uint32_t panel = add_material(*assets, "panel", vec3(0.0f));
  assets->materials[panel].frames = {TextureSet{0}};
  assets->materials[panel].flags = kMaterialAlphaTest | kMaterialNoFullbright;
  Mesh mesh;
  add_quad(mesh, {200, -400, -400}, {0, 0, 800}, {0, 800, 0}, wall);
  add_picture(mesh, panel);
  FrameSnapshot snapshot = still(assets, camera_at(vec3(0.0f), vec3(0.0f), 60.0f));
  snapshot.instances.push_back(make_instance(kIdWorld, add_finished(*assets, std::move(mesh), "panel and wall")));
  return snapshot;
}

FrameSnapshot textured_quad() {
  auto assets = new_code_assets();
  Image colors{"all colours", ImageEncoding::kPalette, 16, 16, {}};
  for (int i = 0; i < 256; ++i) colors.texels.push_back(static_cast<std::uint8_t>(i));
  assets->images.push_back(std::move(colors));
  const std::uint32_t material = add_material(*assets, "all colours", vec3(1.0f));
  assets->materials[material].frames = {TextureSet{0}};
  assets->materials[material].flags = kMaterialNoFullbright | kMaterialClampTexture;
  Mesh mesh;
  add_picture(mesh, material);
  FrameSnapshot snapshot = still(assets, camera_at(vec3(0.0f), vec3(0.0f), 60.0f));
  snapshot.instances.push_back(make_instance(kIdWorld, add_finished(*assets, std::move(mesh), "quad")));
  snapshot.sky.mode = SkyMode::kConstant;
  snapshot.sky.color = vec3(1.0f);
  snapshot.sky.beyond_everything = true;
  return snapshot;
}

}  // namespace fb::scene
