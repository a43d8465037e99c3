// For tests of GpuScene: scenes of random triangles, a brute-force intersector in double precision, and the comparison
// of all the device's intersectors with it.
#pragma once

#include <algorithm>
#include <gtest/gtest.h>
#include <cmath>

#include "base/rng.h"
#include "gpu/bvh.h"
#include "render/scene/gpu_scene.h"
#include "render/scene/ray_list.h"
#include "render/test_device.h"
#include "scene/assets.h"
#include "scene/shapes.h"
#include "scene/snapshot.h"
#include "shared/scene_gpu.h"

namespace fb::render {

using dvec3 = glm::dvec3;
using scene::Instance;
using scene::Mesh;
using shared::ListHit;
using shared::ListRay;

inline vec3 random_direction(Rng& rng) {
  for (;;) {
    vec3 v{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    float length = glm::length(v);
    if (length > 0.05f && length < 1.0f) return v / length;
  }
}

// Triangles whose vertices are their own: triangle i has vertices 3i, 3i+1, 3i+2.
inline Mesh soup(std::uint32_t triangles, float extent, float size, std::uint64_t seed) {
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

inline Mesh posed_soup(std::uint32_t triangles, std::uint32_t poses, std::uint64_t seed) {
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

inline mat4x3 random_transform(Rng& rng, float extent) {
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

inline dvec3 corner(const Case& c, const Instance& instance, std::uint32_t vertex) {
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

inline std::vector<FlatTriangle> flatten(const Case& c, bool candidates) {
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

inline BruteHit brute_force(const std::vector<FlatTriangle>& triangles, const ListRay& ray, double edge) {
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
inline Agreement expect_agreement(const Case& c, const std::vector<ListRay>& rays, const std::vector<ListHit>& hits,
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

inline std::vector<ListRay> random_rays(std::size_t count, float extent, std::uint64_t seed,
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

}  // namespace fb::render
