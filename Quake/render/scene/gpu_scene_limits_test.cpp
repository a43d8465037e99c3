// Both intersectors at the limits of precision: far coordinates, rays along axes, the ends of rays, cracks, triangles
// without area.
#include <gtest/gtest.h>

#include "render/scene/test_gpu_scene.h"

namespace fb::render {
namespace {

TEST_F(GpuSceneTest, KeepsItsPrecisionFarOut) {
  Case c;
  Mesh mesh = soup(400, 300, 60, 34);
  const vec3 far(30000, -30000, 29000);
  for (vec3& p : mesh.positions) p += far;
  scene::finish_mesh(mesh);
  c.add(c.add_mesh(std::move(mesh)));
  Rng rng(35);
  std::uint32_t other = c.add_mesh(soup(40, 50, 30, 36));
  for (int i = 0; i < 10; ++i) {
    mat4x3 m = random_transform(rng, 200);
    m[3] += far;
    c.add(other, m);
  }
  std::vector<ListRay> rays = random_rays(2000, 300, 37);
  for (ListRay& ray : rays) ray.origin += far;
  // Out there floats are 1/512 apart: a triangle and a ray's origin are each up to sqrt(3)/1024 from where they should
  // be. How a driver takes rays into instances is its own business.
  expect_all_agree(c, rays, false, 2e-3, 4e-3, 2e-2);
}

TEST_F(GpuSceneTest, TakesRaysAlongAxes) {
  Case c;
  Mesh room;
  scene::add_box(room, vec3(-64), vec3(64), 0, true);
  for (int i = 0; i < 20; ++i) scene::add_box(room, vec3(-60 + 6 * i, -32, -64), vec3(-57 + 6 * i, 32, -60 + 2 * i), 0);
  scene::finish_mesh(room);
  c.add(c.add_mesh(room));
  mat4x3 turned = entity_transform(vec3(3, 5, 20), vec3(0, 90, 0));
  Mesh box;
  scene::add_box(box, vec3(-8), vec3(8), 0);
  scene::finish_mesh(box);
  c.add(c.add_mesh(box), turned);
  std::vector<ListRay> rays;
  Rng rng(38);
  for (int i = 0; i < 3000; ++i) {
    ListRay ray{};
    // Half of the origins lie in planes of the boxes.
    ray.origin = vec3(rng.uniform(-63, 63), rng.uniform(-63, 63), rng.uniform(-63, 63));
    if (i % 2 == 0) ray.origin[i / 2 % 3] = std::round(ray.origin[i / 2 % 3]);
    ray.direction = vec3(0.0f);
    ray.direction[i % 3] = i % 2 == 0 ? 1.0f : -1.0f;
    if (i % 5 == 0) ray.direction[(i + 1) % 3] = -0.0f;
    if (i % 7 == 0) ray.direction[(i + 1) % 3] = 0.5f;
    ray.t_max = 1e6f;
    ray.mask = scene::kSeenByAll;
    rays.push_back(ray);
  }
  for (const GpuSceneOptions& way : ways()) {
    std::vector<ListHit> hits = trace(c, rays, way);
    expect_agreement(c, rays, hits, false);
    std::size_t misses = 0;
    for (const ListHit& hit : hits) misses += hit.instance == shared::kNoIndex;
    EXPECT_EQ(misses, 0u) << "the room is closed";
  }
}

TEST_F(GpuSceneTest, KeepsToTheRaysEnds) {
  Case c;
  c.add(c.add_mesh(soup(400, 100, 60, 39)));
  Rng rng(40);
  c.add(c.add_mesh(soup(100, 60, 30, 41)), random_transform(rng, 20));
  std::vector<ListRay> rays = random_rays(2000, 120, 42);
  for (ListRay& ray : rays) {
    ray.t_min = rng.uniform(0, 30);
    ray.t_max = ray.t_min + rng.uniform(0, 60);
  }
  expect_all_agree(c, rays);
}

// Rays from within a finely divided ball must not slip through between its triangles, near or far from the origin.
TEST_F(GpuSceneTest, LeavesNoCracks) {
  for (const vec3& center : {vec3(0.0f), vec3(30000, 30000, -30000)}) {
    Case c;
    Mesh ball;
    const std::uint32_t rings = 48, sides = 96;
    for (std::uint32_t r = 0; r <= rings; ++r) {
      for (std::uint32_t s = 0; s < sides; ++s) {
        float theta = kPi * static_cast<float>(r) / rings, phi = 2 * kPi * static_cast<float>(s) / sides;
        ball.positions.push_back(
            center + 700.0f * vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)));
      }
    }
    for (std::uint32_t r = 0; r < rings; ++r) {
      for (std::uint32_t s = 0; s < sides; ++s) {
        std::uint32_t next = (s + 1) % sides, a = r * sides + s, b = r * sides + next, d = a + sides, e = b + sides;
        ball.triangles.push_back({{a, b, d}, 0, {}});
        ball.triangles.push_back({{b, e, d}, 0, {}});
      }
    }
    scene::finish_mesh(ball);
    c.add(c.add_mesh(std::move(ball)));
    std::vector<ListRay> rays = random_rays(400000, 300, 43);
    for (ListRay& ray : rays) ray.origin += center;
    std::size_t misses = 0;
    for (const ListHit& hit : trace(c, rays, {})) misses += hit.instance == shared::kNoIndex;
    EXPECT_LE(misses, rays.size() / 100000) << "about " << center.x;
  }
}

TEST_F(GpuSceneTest, NeverHitsWhatHasNoArea) {
  Case c;
  Mesh mesh;
  Rng rng(44);
  for (std::uint32_t i = 0; i < 300; ++i) {
    vec3 a = random_direction(rng) * 50.0f, b = random_direction(rng) * 50.0f;
    mesh.positions.insert(mesh.positions.end(), {a, b, i % 2 == 0 ? a : glm::mix(a, b, rng.uniform())});
    mesh.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, 0, {}});
  }
  scene::finish_mesh(mesh);
  std::vector<ListRay> rays;
  for (const vec3& p : mesh.positions) {  // straight at the lines
    ListRay ray{};
    ray.origin = vec3(80, 0, 0);
    ray.direction = p - ray.origin;
    ray.t_max = 1e6f;
    ray.mask = scene::kSeenByAll;
    rays.push_back(ray);
  }
  c.add(c.add_mesh(std::move(mesh)));
  for (const ListHit& hit : trace(c, rays, {})) EXPECT_EQ(hit.instance, shared::kNoIndex);
}

TEST_F(GpuSceneTest, SkipsWhatCannotBeDrawn) {
  Case c;
  std::uint32_t mesh = c.add_mesh(soup(20, 50, 30, 45)), empty = c.add_mesh(Mesh{});
  c.add(empty);
  c.add(mesh).transform = mat4x3(0.0f);
  c.add(mesh).transform[3].x = std::nanf("");
  c.add(mesh).material_base = 7;
  c.add(99);
  c.add(mesh);
  gpu::BindingTable table(*device_);
  GpuScene scene(*device_, table, {});
  scene.prepare(c.snapshot, {});
  scene.stage();
  EXPECT_EQ(scene.statistics().instances, 1u);
}

}  // namespace
}  // namespace fb::render
