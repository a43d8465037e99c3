// Both intersectors against a brute-force one on the host (double precision): soups of triangles under transforms,
// posed meshes between poses, masks, alpha tests, far coordinates, trees of no, one and two thousand instances.
#include "render/gpu_scene.h"

#include <algorithm>
#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"
#include "gpu/bvh.h"
#include "render/ray_list.h"
#include "render/test_device.h"
#include "scene/assets.h"
#include "scene/shapes.h"
#include "scene/snapshot.h"
#include "shared/scene_gpu.h"

namespace fb::render {
namespace {

using dvec3 = glm::dvec3;
using scene::Instance;
using scene::Mesh;
using shared::ListHit;
using shared::ListRay;

vec3 random_direction(Rng& rng) {
  for (;;) {
    vec3 v{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    float length = glm::length(v);
    if (length > 0.05f && length < 1.0f) return v / length;
  }
}

// Triangles whose vertices are their own: triangle i has vertices 3i, 3i+1, 3i+2.
Mesh soup(std::uint32_t triangles, float extent, float size, std::uint64_t seed) {
  Rng rng(seed);
  Mesh mesh;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    vec3 at = vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)) * extent;
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(at + random_direction(rng) * size);
    mesh.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, 0, {}});
  }
  scene::finish_mesh(mesh);
  return mesh;
}

Mesh posed_soup(std::uint32_t triangles, std::uint32_t poses, std::uint64_t seed) {
  Rng rng(seed);
  Mesh mesh;
  mesh.pose_count = poses;
  mesh.vertex_count = 3 * triangles;
  mesh.pose_scale = vec3(0.25f, 0.3f, 0.2f);
  mesh.pose_origin = vec3(-30, -35, -25);
  for (std::uint32_t i = 0; i < triangles; ++i) mesh.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, 0, {}});
  std::vector<vec3> rest;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    vec3 at{rng.uniform(30, 220), rng.uniform(30, 220), rng.uniform(30, 220)};
    for (int k = 0; k < 3; ++k) rest.push_back(at + random_direction(rng) * 14.0f);
  }
  for (std::uint32_t pose = 0; pose < poses; ++pose) {
    for (const vec3& p : rest) {
      vec3 q = p + random_direction(rng) * 12.0f;
      mesh.poses.push_back(scene::make_pose_vertex(static_cast<std::uint8_t>(q.x), static_cast<std::uint8_t>(q.y),
                                                   static_cast<std::uint8_t>(q.z), random_direction(rng)));
    }
  }
  scene::finish_mesh(mesh);
  return mesh;
}

mat4x3 random_transform(Rng& rng, float extent) {
  vec3 at = vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)) * extent;
  mat4x3 m = entity_transform(at, {rng.uniform(-180, 180), rng.uniform(-180, 180), rng.uniform(-180, 180)});
  vec3 scale{rng.uniform(0.4f, 2.5f), rng.uniform(0.4f, 2.5f), rng.uniform(0.4f, 2.5f)};
  for (int axis = 0; axis < 3; ++axis) m[axis] *= scale[axis];
  return m;
}

struct Case {
  std::shared_ptr<scene::Assets> assets = std::make_shared<scene::Assets>();
  scene::FrameSnapshot snapshot;
  Case() {
    assets->generation = scene::next_generation();
    assets->materials.resize(1);
    snapshot.assets = assets;
  }
  std::uint32_t add_mesh(Mesh mesh) {
    assets->meshes.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(assets->meshes.size()) - 1;
  }
  Instance& add(std::uint32_t mesh, const mat4x3& transform = mat4x3(1.0f)) {
    Instance instance;
    instance.id = static_cast<std::uint32_t>(snapshot.instances.size());
    instance.mesh = mesh;
    instance.transform = instance.prev_transform = transform;
    snapshot.instances.push_back(instance);
    return snapshot.instances.back();
  }
};

struct BruteHit {
  double t = 0;
  std::uint32_t id = shared::kNoIndex, vertex0 = 0;
  double u = 0, v = 0;
  double grazing = 1;      // sine of the angle at which the triangle was met, times that of its corner
  bool ambiguous = false;  // some edge or the ray's end was met so closely that single precision may decide otherwise
};

dvec3 corner(const Case& c, const Instance& instance, std::uint32_t vertex) {
  const Mesh& mesh = c.assets->meshes[instance.mesh];
  dvec3 p;
  if (mesh.posed()) {
    p = glm::mix(dvec3(scene::vertex_position(mesh, vertex, instance.pose.a)),
                 dvec3(scene::vertex_position(mesh, vertex, instance.pose.b)), static_cast<double>(instance.pose.t));
  } else {
    p = dvec3(mesh.positions[vertex]);
  }
  const mat4x3& m = instance.transform;
  return dvec3(m[0]) * p.x + dvec3(m[1]) * p.y + dvec3(m[2]) * p.z + dvec3(m[3]);
}

struct FlatTriangle {
  dvec3 v0, e1, e2;
  std::uint32_t id, vertex0, visibility;
  bool counts;  // false: asked, and refused
};

std::vector<FlatTriangle> flatten(const Case& c, bool candidates) {
  std::vector<FlatTriangle> list;
  for (const Instance& instance : c.snapshot.instances) {
    for (const scene::MeshTriangle& t : c.assets->meshes[instance.mesh].triangles) {
      const scene::Material& m = c.assets->materials[t.material + instance.material_base];
      bool asks = (m.flags & scene::kMaterialAlphaTest) != 0 || m.alpha < 1 || instance.alpha < 1;
      dvec3 v0 = corner(c, instance, t.vertices[0]);
      list.push_back({v0, corner(c, instance, t.vertices[1]) - v0, corner(c, instance, t.vertices[2]) - v0, instance.id,
                      t.vertices[0], instance.visibility, !(candidates && asks && t.vertices[0] % 2 != 0)});
    }
  }
  return list;
}

BruteHit brute_force(const std::vector<FlatTriangle>& triangles, const ListRay& ray, double edge) {
  BruteHit best;
  best.t = ray.t_max;
  dvec3 o(ray.origin), d(ray.direction);
  for (const FlatTriangle& f : triangles) {
    if ((f.visibility & ray.mask) == 0 || !f.counts) continue;
    dvec3 p = glm::cross(d, f.e2), s = o - f.v0, q = glm::cross(s, f.e1);
    double det = glm::dot(f.e1, p);
    if (det == 0) continue;
    double u = glm::dot(s, p) / det, v = glm::dot(d, q) / det, t = glm::dot(f.e2, q) / det;
    if (!(t > ray.t_min * (1 - 1e-6) - 1e-6) || t > ray.t_max * (1 + 1e-6)) continue;
    double inside = std::min({u, v, 1 - u - v});
    // Grazing rays lose precision in proportion.
    double grazing = std::abs(det) / (glm::length(d) * glm::length(f.e1) * glm::length(f.e2));
    double doubt = edge / std::max(grazing, 1e-6);
    if (std::abs(inside) < doubt && t < best.t * (1 + 1e-4)) best.ambiguous = true;
    if (inside < 0 || t >= best.t || t <= ray.t_min) continue;
    if (t > best.t * (1 - 1e-5)) best.ambiguous = true;
    best = {t, f.id, f.vertex0, u, v, grazing, best.ambiguous};
  }
  return best;
}

struct Agreement {
  std::size_t hits = 0, ambiguous = 0;
};

// Every ray agrees, but for those that the host calls too close; these are counted.
Agreement expect_agreement(const Case& c, const std::vector<ListRay>& rays, const std::vector<ListHit>& hits,
                           bool candidates, double edge = 2e-4, double t_tolerance = 2e-4) {
  Agreement result;
  const std::vector<FlatTriangle> triangles = flatten(c, candidates);
  std::size_t failures = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    BruteHit want = brute_force(triangles, rays[i], edge);
    const ListHit& got = hits[i];
    result.hits += want.id != shared::kNoIndex;
    if (want.ambiguous) {
      ++result.ambiguous;
      continue;
    }
    bool same = (got.instance == shared::kNoIndex) == (want.id == shared::kNoIndex);
    if (same && want.id != shared::kNoIndex) {
      // At the same distance it may be another triangle: they coincide.
      same = std::abs(got.t - want.t) <= t_tolerance * std::max(1.0, want.t) * (1 + 0.05 / want.grazing);
      if (got.id == want.id && got.vertex0 == want.vertex0) {
        same = same && std::abs(got.u - want.u) < 20 * edge && std::abs(got.v - want.v) < 20 * edge;
      }
    }
    if (!same && ++failures < 5) {
      ADD_FAILURE() << "ray " << i << ": instance " << static_cast<int>(got.id) << " triangle at vertex " << got.vertex0
                    << " t " << got.t << " u " << got.u << " v " << got.v << ", wanted " << static_cast<int>(want.id)
                    << " at " << want.vertex0 << " t " << want.t << " u " << want.u << " v " << want.v;
    }
  }
  EXPECT_EQ(failures, 0u);
  return result;
}

std::vector<ListRay> random_rays(std::size_t count, float extent, std::uint64_t seed,
                                 std::uint32_t mask = scene::kSeenByAll) {
  Rng rng(seed);
  std::vector<ListRay> rays(count);
  for (ListRay& ray : rays) {
    ray.origin = vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)) * extent;
    ray.direction = random_direction(rng) * rng.uniform(0.5f, 3.0f);
    ray.t_min = 0;
    ray.t_max = 1e6f;
    ray.mask = mask;
  }
  return rays;
}

class GpuSceneTest : public DeviceTest {
 protected:
  // All ways to trace that this device has.
  static std::vector<GpuSceneOptions> ways() {
    std::vector<GpuSceneOptions> list{{}};
    if (device_->has_ray_query()) {
      list.push_back({true, gpu::BuildPreference::kFastTrace});
      list.push_back({true, gpu::BuildPreference::kFastBuild});
    }
    return list;
  }
  static std::vector<ListHit> trace(const Case& c, const std::vector<ListRay>& rays, const GpuSceneOptions& way,
                                    bool candidates = false) {
    RayList list(*device_, way, candidates);
    list.load(c.snapshot, rays);
    list.trace();
    return list.hits();
  }
  // Traces in all ways; the share of hits and of doubtful rays must make the comparison worth something.
  static void expect_all_agree(const Case& c, const std::vector<ListRay>& rays, bool candidates = false,
                               double edge = 2e-4, double t_tolerance = 2e-4, double query_t_tolerance = 2e-4) {
    for (const GpuSceneOptions& way : ways()) {
      SCOPED_TRACE(way.ray_query
                       ? (way.build == gpu::BuildPreference::kFastTrace ? "query, fast trace" : "query, fast build")
                       : "bvh");
      Agreement a = expect_agreement(c, rays, trace(c, rays, way, candidates), candidates, edge,
                                     way.ray_query ? query_t_tolerance : t_tolerance);
      EXPECT_GT(a.hits, rays.size() / 10);
      EXPECT_LT(a.ambiguous, rays.size() / 10);
    }
  }
};

TEST_F(GpuSceneTest, FindsTheWorldsTriangles) {
  Case c;
  c.add(c.add_mesh(soup(3000, 500, 60, 1)));
  expect_all_agree(c, random_rays(3000, 500, 2));
}

TEST_F(GpuSceneTest, FindsTransformedInstancesBesideTheWorld) {
  Case c;
  Rng rng(3);
  c.add(c.add_mesh(soup(400, 600, 60, 4)));
  std::uint32_t mesh = c.add_mesh(soup(40, 50, 20, 5)), tiny = c.add_mesh(soup(1, 1, 20, 6));
  for (int i = 0; i < 40; ++i) c.add(i % 4 == 0 ? tiny : mesh, random_transform(rng, 500));
  expect_all_agree(c, random_rays(3000, 600, 7));
}

TEST_F(GpuSceneTest, FindsNothingInNothing) {
  Case c;
  for (const GpuSceneOptions& way : ways()) {
    for (const ListHit& hit : trace(c, random_rays(100, 10, 1), way)) EXPECT_EQ(hit.instance, shared::kNoIndex);
  }
}

TEST_F(GpuSceneTest, FindsOneInstanceAlone) {
  Case c;
  Rng rng(8);
  c.add(c.add_mesh(soup(60, 50, 40, 9)), random_transform(rng, 10));
  expect_all_agree(c, random_rays(1000, 60, 10));
}

TEST_F(GpuSceneTest, FindsTwoThousandInstances) {
  Case c;
  Rng rng(11);
  std::uint32_t mesh = c.add_mesh(soup(4, 6, 12, 12));
  for (int i = 0; i < 2000; ++i) c.add(mesh, random_transform(rng, 400));
  expect_all_agree(c, random_rays(1000, 400, 13));
}

TEST_F(GpuSceneTest, SeesByMaskAlone) {
  Case c;
  Rng rng(14);
  std::uint32_t mesh = c.add_mesh(soup(60, 100, 60, 15));
  const std::uint32_t seen[]{scene::kSeenByAll, scene::kSeenByCamera, scene::kSeenByIndirect};
  for (int i = 0; i < 12; ++i) c.add(mesh, i < 3 ? mat4x3(1.0f) : random_transform(rng, 80)).visibility = seen[i % 3];
  for (std::uint32_t mask : seen) expect_all_agree(c, random_rays(500, 150, 16, mask));
}

TEST_F(GpuSceneTest, AsksOnlyAlphaTestedAndTranslucent) {
  Case c;
  c.assets->materials.resize(3);
  c.assets->materials[1].flags = scene::kMaterialAlphaTest;
  c.assets->materials[2].alpha = 0.5f;
  Mesh world = soup(1500, 300, 60, 17);
  for (std::size_t i = 0; i < world.triangles.size(); ++i)
    world.triangles[i].material = i % 5 == 0 ? 1 : i % 7 == 0 ? 2 : 0;
  c.add(c.add_mesh(std::move(world)));
  Rng rng(18);
  std::uint32_t mesh = c.add_mesh(soup(60, 60, 30, 19)), posed = c.add_mesh(posed_soup(60, 3, 20));
  c.add(mesh, random_transform(rng, 200));                    // opaque
  c.add(mesh, random_transform(rng, 200)).alpha = 0.5f;       // translucent as a whole
  c.add(mesh, random_transform(rng, 200)).material_base = 1;  // alpha-tested by its base
  c.add(posed, random_transform(rng, 200)).material_base = 1;
  c.add(posed, random_transform(rng, 200)).pose = {0, 1, 0.5f};
  expect_all_agree(c, random_rays(3000, 300, 21), true);

  Case opaque;
  opaque.add(opaque.add_mesh(soup(10, 10, 5, 1)));
  gpu::BindingTable table(*device_);
  GpuScene scene(*device_, table, {});
  scene.prepare(c.snapshot, {});
  EXPECT_TRUE(scene.features().alpha_test);
  EXPECT_TRUE(scene.features().translucent);
  EXPECT_FALSE(scene.features().specular);
  scene.prepare(opaque.snapshot, {});
  EXPECT_FALSE(scene.features().alpha_test);
  EXPECT_FALSE(scene.features().translucent);
}

TEST_F(GpuSceneTest, PosesAndRefits) {
  Rng rng(22);
  Case c;
  c.add(c.add_mesh(soup(50, 300, 50, 23)));
  std::uint32_t large = c.add_mesh(posed_soup(500, 5, 24)), small = c.add_mesh(posed_soup(2, 3, 25));
  const float blends[]{0, 0.25f, 0.5f, 0.9f, 1};
  for (int i = 0; i < 12; ++i) {
    Instance& instance = c.add(i % 4 == 3 ? small : large, random_transform(rng, 150));
    instance.pose = {static_cast<std::uint32_t>(i) % 3, static_cast<std::uint32_t>(i / 2) % 3, blends[i % 5]};
  }
  c.add(large, random_transform(rng, 150)).pose = c.snapshot.instances[1].pose;  // shares the copy
  expect_all_agree(c, random_rays(2000, 250, 26));
}

// A scene that changes from frame to frame: poses, counts, new meshes, new assets.
TEST_F(GpuSceneTest, FollowsTheFrames) {
  for (const GpuSceneOptions& way : ways()) {
    SCOPED_TRACE(way.ray_query ? "query" : "bvh");
    RayList list(*device_, way, false);
    Rng rng(27);
    Case c;
    c.add(c.add_mesh(soup(50, 300, 50, 28)));
    std::uint32_t posed = c.add_mesh(posed_soup(80, 4, 29));
    for (int frame = 0; frame < 6; ++frame) {
      if (frame == 3) {
        std::uint32_t more = c.add_mesh(posed_soup(120, 4, 30)), rigid = c.add_mesh(soup(400, 50, 20, 31));
        for (int i = 0; i < 30; ++i) c.add(i % 2 == 0 ? more : rigid, random_transform(rng, 200));
      } else if (frame == 5) {
        Case other;
        other.add(other.add_mesh(soup(300, 200, 50, 32)));
        other.add(other.add_mesh(posed_soup(30, 4, 33)), random_transform(rng, 100));
        c = other;
      } else if (frame != 2) {  // the third frame repeats the second
        c.add(posed, random_transform(rng, 200));
        for (Instance& instance : c.snapshot.instances) {
          instance.pose = {rng.below(4), rng.below(4), instance.id % 2 == 0 ? rng.uniform() : 0.5f};
        }
      }
      std::vector<ListRay> rays = random_rays(600, 300, 100 + static_cast<std::uint64_t>(frame));
      list.load(c.snapshot, rays);
      list.trace();
      expect_agreement(c, rays, list.hits(), false);
    }
  }
}

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
  EXPECT_EQ(scene.statistics().instances, 1u);
}

// The frame's whole tree: every box holds what is below it, every triangle hangs in it once and says whose it is.
TEST_F(GpuSceneTest, RefittedBoxesHoldTheirTriangles) {
  Case c;
  Rng rng(46);
  c.add(c.add_mesh(soup(1500, 300, 40, 48)));
  std::uint32_t posed = c.add_mesh(posed_soup(700, 4, 47)), rigid = c.add_mesh(soup(90, 40, 20, 49)),
                tiny = c.add_mesh(soup(3, 10, 20, 50));
  c.add(posed, random_transform(rng, 100)).pose = {0, 3, 0.3f};
  c.add(rigid, random_transform(rng, 100));
  c.add(tiny, random_transform(rng, 100));
  c.add(posed, random_transform(rng, 100)).pose = {2, 1, 0.7f};
  RayList list(*device_, {}, false);
  list.load(c.snapshot, random_rays(1, 1, 1));
  const SceneBuffers buffers = list.scene().buffers();
  const auto nodes =
      gpu::read_now<shared::BvhNode>(*device_, *buffers.nodes, buffers.nodes->size() / sizeof(shared::BvhNode));
  const auto triangles = gpu::read_now<shared::GpuTriangle>(*device_, *buffers.triangles,
                                                            buffers.triangles->size() / sizeof(shared::GpuTriangle));
  const auto instances = gpu::read_now<shared::GpuInstance>(*device_, *buffers.instances, c.snapshot.instances.size());
  struct Visit {
    std::uint32_t ref;
    Bounds box;
  };
  std::vector<Visit> stack{{0, {vec3(-1e9f), vec3(1e9f)}}};
  std::vector<std::vector<int>> seen(instances.size());
  for (std::size_t i = 0; i < instances.size(); ++i) seen[i].resize(instances[i].triangle_count);
  std::size_t outside = 0;
  const auto expect_inside = [&](const Bounds& box, const vec3& p) {
    const vec3 rounding(300 * 2.4e-7f);  // of putting corners together, on the host as here
    outside += glm::any(glm::lessThan(p, box.min - rounding)) || glm::any(glm::greaterThan(p, box.max + rounding));
  };
  while (!stack.empty()) {
    const Visit at = stack.back();
    stack.pop_back();
    if (at.ref < shared::kRefLeaf) {
      const shared::BvhNode& node = nodes.at(at.ref);
      stack.push_back({node.child0, {node.min0, node.max0}});
      stack.push_back({node.child1, {node.min1, node.max1}});
      continue;
    }
    const std::uint32_t first = at.ref & shared::kRefFirstMask;
    const std::uint32_t count = (at.ref >> shared::kRefCountShift & shared::kRefCountMask) + 1;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const shared::GpuTriangle& t = triangles.at(i);
      const std::uint32_t owner = shared::floatBitsToUint(t.v0.w) >> shared::kTriangleInstanceShift;
      ++seen.at(owner).at(i - instances[owner].world_triangle);
      for (const vec3& p : {vec3(t.v0), vec3(t.v0) + vec3(t.e1), vec3(t.v0) + vec3(t.e2)}) expect_inside(at.box, p);
    }
  }
  EXPECT_EQ(outside, 0u);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].size(), c.assets->meshes[c.snapshot.instances[instances[i].id].mesh].triangles.size());
    for (int times : seen[i]) EXPECT_EQ(times, 1);
  }
}

}  // namespace
}  // namespace fb::render
