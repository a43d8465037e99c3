// The laboratory's scenes made in code are what they claim: closed, lit by what they say, moving as they say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/rng.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scene_of_kinds.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_in_motion.h"
#include "scene/in_code/scenes_of_fog.h"
#include "scene/in_code/scenes_of_light.h"
#include "scene/in_code/scenes_of_rooms.h"
#include "scene/shapes.h"
#include "scene/test_scenes.h"
#include "world/bsp_query.h"

namespace fb::scene {
namespace {

const Instance* find(const FrameSnapshot& snapshot, std::uint32_t id) {
  const auto at =
      std::find_if(snapshot.instances.begin(), snapshot.instances.end(), [&](const Instance& i) { return i.id == id; });
  return at == snapshot.instances.end() ? nullptr : &*at;
}

std::vector<const Instance*> lights(const FrameSnapshot& snapshot) {
  std::vector<const Instance*> list;
  for (const Instance& i : snapshot.instances)
    if ((i.flags & kInstanceColor) != 0 && i.emission != vec3(0.0f)) list.push_back(&i);
  return list;
}

// A closed space, with the camera and every light in its air.
void expect_closed_space(const FrameSnapshot& snapshot) {
  expect_sound(snapshot);
  const Mesh& world = snapshot.assets->meshes[snapshot.instances.front().mesh];
  EXPECT_TRUE(is_closed(world));
  EXPECT_LT(mesh_volume(world), 0.0) << "it faces inward";
  EXPECT_NEAR(winding(world, snapshot.camera.position), -1.0, 1e-3) << "the camera is in the air";
  for (const Instance* light : lights(snapshot))
    EXPECT_NEAR(winding(world, light->transform[3]), -1.0, 1e-3) << "light " << light->id;
}

double power(const Instance& sphere) {  // of a sphere, but for a common factor
  const vec3 luminance(0.2126f, 0.7152f, 0.0722f);
  return glm::dot(luminance, sphere.emission) * sphere.transform[0].x * sphere.transform[0].x;
}

// Their trees divide their space as their walls do.
TEST(Rooms, AreClosedAndHaveTheirTrees) {
  Rng rng(3);
  for (const FrameSnapshot& scene : {thin_wall(), split_room(), split_room(true), red_ball()}) {
    expect_closed_space(scene);
    const Mesh& world = scene.assets->meshes[scene.instances.front().mesh];
    for (int i = 0; i < 200; ++i) {
      const vec3 point(rng.uniform(-260, 260), rng.uniform(-170, 170), rng.uniform(-20, 270));
      const bool air = winding(world, point) < -0.5;
      EXPECT_EQ(world::point_contents(*scene.assets->map, point),
                air ? formats::kContentsEmpty : formats::kContentsSolid);
    }
    EXPECT_EQ(world::point_contents(*scene.assets->map, scene.camera.position), formats::kContentsEmpty);
  }
  EXPECT_EQ(world::point_contents(*thin_wall().assets->map, {0.5f, 0, 80}), formats::kContentsSolid);
}

TEST(CarvedRooms, AreClosedAndHaveTheAirsVolume) {
  BlockGrid grid;
  grid.x = grid.y = grid.z = {0, 1, 3, 7};
  // Air but for the middle block: a hollow with a core.
  grid.air = [](const vec3& p) { return !(p.x > 1 && p.x < 3 && p.y > 1 && p.y < 3 && p.z > 1 && p.z < 3); };
  grid.material = [](const vec3& p, const vec3& normal) { return normal.z > 0 && p.z == 0 ? 1u : 0u; };
  Mesh mesh;
  add_carved(mesh, grid);
  finish_mesh(mesh);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_NEAR(mesh_volume(mesh), -(7.0 * 7 * 7 - 8), 1e-3);
  EXPECT_NEAR(mesh_area(mesh), 6 * 49 + 6 * 4, 1e-3);
  const auto floor_faces =
      std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [](const auto& t) { return t.material == 1; });
  EXPECT_EQ(floor_faces, 18);
  EXPECT_NEAR(winding(mesh, {0.5f, 0.5f, 0.5f}), -1.0, 1e-4);
  EXPECT_NEAR(winding(mesh, {2, 2, 2}), 0.0, 1e-4);
  EXPECT_NEAR(winding(mesh, {-1, 2, 2}), 0.0, 1e-4);
}

TEST(LightScenes, ManyIsHundredsOfEqualSpheres) {
  const FrameSnapshot snapshot = many_lights(400);
  expect_sound(snapshot);
  const auto list = lights(snapshot);
  EXPECT_EQ(list.size(), 400u);
  for (const Instance* light : list) EXPECT_EQ(light->transform[0].x, 4.0f);
}

TEST(LightScenes, CandlesAreUnequalAndFlickerInPlace) {
  const auto assets = candle_assets();
  const FrameSnapshot a = candles(assets, 0.5, 0.4), b = candles(assets, 0.6, 0.5);
  expect_closed_space(a);
  ASSERT_EQ(lights(a).size(), kCandles);
  float weakest = 1e30f, strongest = 0;
  for (std::uint32_t i = 0; i < kCandles; ++i) {
    const Instance &now = *find(a, kCandleFlame + i), &next = *find(b, kCandleFlame + i);
    EXPECT_EQ(now.transform, next.prev_transform);
    EXPECT_NE(now.emission, next.emission);
    EXPECT_NEAR(now.transform[3].z, next.transform[3].z, 3.0f);
    EXPECT_EQ(now.transform[3].x, next.transform[3].x);
    weakest = std::min(weakest, now.emission.x);
    strongest = std::max(strongest, now.emission.x);
  }
  EXPECT_GT(strongest / weakest, 15.0f);
  EXPECT_LT(strongest / weakest, 60.0f);
}

// Whether a segment between two points meets a triangle (Moeller and Trumbore 1997).
bool crosses(const vec3& from, const vec3& to, const vec3& a, const vec3& b, const vec3& c) {
  const vec3 d = to - from, e1 = b - a, e2 = c - a, p = glm::cross(d, e2);
  const float determinant = glm::dot(e1, p);
  if (std::abs(determinant) < 1e-6f) return false;
  const vec3 s = (from - a) / determinant, q = glm::cross(s, e1);
  const float u = glm::dot(s, p), v = glm::dot(d, q), t = glm::dot(e2, q);
  return u >= 0 && v >= 0 && u + v <= 1 && t > 1e-4f && t < 0.9999f;
}

TEST(LightScenes, NoPointOfTheRoomSeesAStrip) {
  const FrameSnapshot snapshot = strips();
  expect_closed_space(snapshot);
  const Mesh& room = snapshot.assets->meshes[0];
  Rng rng(3);
  int glowing_triangles = 0, seen_from_recess = 0;
  for (const MeshTriangle& strip : room.triangles) {
    if (snapshot.assets->materials[strip.material].emission == vec3(0.0f)) continue;
    ++glowing_triangles;
    for (int i = 0; i < 24; ++i) {
      float u = rng.uniform(), v = rng.uniform();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const vec3& origin = room.positions[strip.vertices[0]];
      const vec3 target = origin + u * (room.positions[strip.vertices[1]] - origin) +
                          v * (room.positions[strip.vertices[2]] - origin) + vec3(0.01f, 0, 0);
      const bool recess = i % 2 == 1;
      const vec3 from = recess ? vec3(kStripsRecess + 62, rng.uniform(-140, 140), rng.uniform(36, 268))
                               : vec3(rng.uniform(-380, 0), rng.uniform(-310, 310), rng.uniform(4, 316));
      const bool blocked = std::any_of(room.triangles.begin(), room.triangles.end(), [&](const MeshTriangle& t) {
        return crosses(from, target, room.positions[t.vertices[0]], room.positions[t.vertices[1]],
                       room.positions[t.vertices[2]]);
      });
      if (recess)
        seen_from_recess += !blocked;
      else
        EXPECT_TRUE(blocked) << from.x << ' ' << from.y << ' ' << from.z;
    }
  }
  EXPECT_GT(glowing_triangles, 20);
  EXPECT_EQ(seen_from_recess, 12 * glowing_triangles) << "the recess's back sees all of every strip";
}

TEST(LightScenes, KindsHasThemAll) {
  const FrameSnapshot snapshot = light_of_every_kind();
  expect_closed_space(snapshot);
  std::set<EmissionKind> kinds;
  for (const Material& m : snapshot.assets->materials) kinds.insert(m.emission_kind);
  for (const EmissionKind kind : {EmissionKind::kConstant, EmissionKind::kFullbright, EmissionKind::kLava,
                                  EmissionKind::kTeleport, EmissionKind::kSky, EmissionKind::kSprite})
    EXPECT_TRUE(kinds.contains(kind)) << static_cast<int>(kind);
  const auto& suns = snapshot.sky.suns;
  ASSERT_EQ(suns.size(), 2u);
  const float apart = degrees(std::acos(glm::dot(suns[0].direction, suns[1].direction)));
  EXPECT_GT(apart, 0.5f);
  EXPECT_LT(apart, suns[0].angular_radius + suns[1].angular_radius) << "their discs overlap";
}

TEST(LightScenes, LavaIsAPoolAndNothingElse) {
  const FrameSnapshot snapshot = lava_cave();
  expect_closed_space(snapshot);
  EXPECT_TRUE(lights(snapshot).empty());
  const Mesh& cave = snapshot.assets->meshes[0];
  double pool = 0;
  for (const MeshTriangle& t : cave.triangles) {
    if (snapshot.assets->materials[t.material].emission == vec3(0.0f)) continue;
    vec3 area2 = glm::cross(cave.positions[t.vertices[1]] - cave.positions[t.vertices[0]],
                            cave.positions[t.vertices[2]] - cave.positions[t.vertices[0]]);
    EXPECT_GT(area2.z, 0.0f);
    EXPECT_EQ(cave.positions[t.vertices[0]].z, 0.0f);
    pool += 0.5 * area2.z;
  }
  EXPECT_GT(pool, 0.5 * 640 * 640) << "more than half of what lies within the rim";
}

TEST(FogScenes, SlabIsALampInSightAndNothingElse) {
  const FrameSnapshot snapshot = slab(0.004f, 0.4f);
  ASSERT_EQ(snapshot.instances.size(), 1u);
  EXPECT_EQ(lights(snapshot).size(), 1u);
  EXPECT_TRUE(is_closed(snapshot.assets->meshes[snapshot.instances[0].mesh]));
  EXPECT_FALSE(snapshot.sky.beyond_everything);
  EXPECT_TRUE(snapshot.medium.scatters());
  EXPECT_LT(glm::length(vec2(kSlabLamp.y, kSlabLamp.z)), 0.5f * kSlabLamp.x) << "within the picture";
}

TEST(FogScenes, WindowIsClosedAndItsSunFallsIn) {
  const FrameSnapshot snapshot = window();
  expect_closed_space(snapshot);
  EXPECT_TRUE(snapshot.medium.scatters());
  ASSERT_EQ(snapshot.sky.suns.size(), 1u);
  const vec3 sun = snapshot.sky.suns[0].direction;
  EXPECT_GT(sun.y, 0.5f) << "through the left wall";
  EXPECT_GT(sun.z, 0.0f);
  const Mesh& hall = snapshot.assets->meshes[0];
  double sky = 0;
  for (const MeshTriangle& t : hall.triangles) {
    if (snapshot.assets->materials[t.material].emission_kind != EmissionKind::kSky) continue;
    for (const std::uint32_t v : t.vertices) EXPECT_GT(hall.positions[v].y, kWindowWall);
    sky += 0.5 * glm::length(glm::cross(hall.positions[t.vertices[1]] - hall.positions[t.vertices[0]],
                                        hall.positions[t.vertices[2]] - hall.positions[t.vertices[0]]));
  }
  EXPECT_NEAR(sky, 3 * 48 * 128, 1e-2) << "between two bars";
}

TEST(LightScenes, ThreeLampsDifferInColourAlone) {
  const FrameSnapshot snapshot = three_lamps();
  expect_closed_space(snapshot);
  const auto list = lights(snapshot);
  ASSERT_EQ(list.size(), 3u);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Instance& lamp = *find(snapshot, kThreeLamps + i);
    EXPECT_EQ(lamp.emission[static_cast<int>(i)], 200.0f);
    EXPECT_EQ(lamp.emission.x + lamp.emission.y + lamp.emission.z, 208.0f);
    EXPECT_EQ(lamp.transform[0].x, list[0]->transform[0].x);
  }
}

// The plate's shadow, from the lamp through its middle, crosses the floor, and no frame has it where the last one had.
TEST(Films, TheOccluderSwingsUnderItsLamp) {
  const auto assets = occluder_assets();
  float least = 1e9f, most = -1e9f, fastest = 0;
  for (int frame = 1; frame < 240; ++frame) {
    const FrameSnapshot now = occluder(assets, frame / 60.0, (frame - 1) / 60.0);
    if (frame % 40 == 1) expect_closed_space(now);
    ASSERT_EQ(lights(now).size(), 2u);
    const Instance &plate = *find(now, kOccluder), &lamp = *find(now, kOccluderLamp);
    EXPECT_NEAR(power(*find(now, kOccluderLamp + 1)) / power(lamp), 0.01, 1e-5);
    const auto shadow_of = [&](const vec3& middle) {
      const vec3& from = lamp.transform[3];
      return from.y + (middle.y - from.y) * from.z / (from.z - middle.z);
    };
    const float shadow = shadow_of(plate.transform[3]), before = shadow_of(plate.prev_transform[3]);
    least = std::min(least, shadow);
    most = std::max(most, shadow);
    fastest = std::max(fastest, std::abs(shadow - before) * 60);
  }
  EXPECT_LT(least, -200);
  EXPECT_GT(most, 200);
  EXPECT_GT(fastest, 350);
  EXPECT_LT(fastest, 450);
}

TEST(Films, RocketFliesAtItsSpeedFromFrameOneOn) {
  const auto assets = rocket_assets();
  EXPECT_EQ(find(rocket(assets, 0, 60), kRocket), nullptr);
  expect_closed_space(rocket(assets, 0, 60));
  std::uint64_t frames = 0;
  for (const double fps : {60.0, 20.0}) {
    std::uint64_t last = 0;
    for (std::uint64_t frame = 1; frame < 90; ++frame) {
      const FrameSnapshot now = rocket(assets, frame, fps), before = rocket(assets, frame - 1, fps);
      EXPECT_EQ(now.frame, frame);
      EXPECT_EQ(now.prev_time, before.time);
      const Instance* r = find(now, kRocket);
      ASSERT_EQ(r != nullptr, rocket_flies(frame, fps));
      if (r == nullptr) continue;
      last = frame;
      expect_closed_space(now);
      const Instance* r_prev = find(before, kRocket);
      EXPECT_EQ((r->flags & kInstanceNew) != 0, frame == 1);
      if (r_prev == nullptr) {
        EXPECT_EQ(frame, 1u);
        continue;
      }
      EXPECT_EQ(r->prev_transform, r_prev->transform);
      const vec3 step = r->transform[3] - r->prev_transform[3];
      EXPECT_NEAR(step.x + step.y, 1000.0 / fps, 1e-2) << "along one arm or the other, or round the corner";
      EXPECT_TRUE(step.x >= 0 && step.y >= 0 && step.z == 0);
    }
    EXPECT_EQ(last, 1 + static_cast<std::uint64_t>(std::ceil(1.224 * fps) - 1));
    frames += last;
  }
  EXPECT_GT(frames, 90u);
}

TEST(Films, TheLampGoesOutAtItsFrameAndTheWeakStay) {
  const auto assets = lights_out_assets();
  const FrameSnapshot before = lights_out(assets, kLightsOutFrame - 1, 60),
                      after = lights_out(assets, kLightsOutFrame, 60);
  expect_closed_space(before);
  expect_closed_space(after);
  EXPECT_NE(find(lights_out(assets, 0, 60), kLightsOutLamp), nullptr);
  const Instance* lamp = find(before, kLightsOutLamp);
  ASSERT_NE(lamp, nullptr);
  EXPECT_EQ(find(after, kLightsOutLamp), nullptr);
  EXPECT_EQ(find(lights_out(assets, kLightsOutFrame + 500, 60), kLightsOutLamp), nullptr);
  ASSERT_EQ(lights(after).size(), 6u);
  double weak = 0;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const Instance &a = *find(before, kLightsOutWeak + i), &b = *find(after, kLightsOutWeak + i);
    EXPECT_EQ(a.emission, b.emission);
    EXPECT_EQ(a.transform, b.prev_transform);
    weak += power(b);
  }
  EXPECT_NEAR(weak / power(*lamp), 1.0 / 50, 0.003);
}

}  // namespace
}  // namespace fb::scene
