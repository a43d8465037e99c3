#include "render/scene/gpu_scene_copies.h"

#include <algorithm>

#include "base/check.h"

namespace fb::render {
namespace {

shared::GpuTriangle in_world(const shared::GpuTriangle& t, const InstanceCopy& copy) {
  const vec3 v0(t.v0), e1(t.e1), e2(t.e2);
  const vec3 a = transform_point(copy.transform, v0);
  const vec3 b = e1 == vec3(0.0f) ? a : transform_point(copy.transform, v0 + e1);
  const vec3 c = e2 == vec3(0.0f) ? a : transform_point(copy.transform, v0 + e2);
  const bool asks = (shared::floatBitsToUint(t.v0.w) & shared::kTriangleAsks) != 0;
  const std::uint32_t owner = copy.owner | (asks ? shared::kTriangleAsks : 0u);
  return {vec4(a, shared::uintBitsToFloat(owner)), vec4(b - a, 0), vec4(c - a, 0)};
}

}  // namespace

scene::PoseBlend InstanceCopies::canonical(const MeshRecord& mesh, scene::PoseBlend blend) {
  if (!mesh.posed) return {};
  blend.a = std::min(blend.a, mesh.pose_count - 1);
  blend.b = std::min(blend.b, mesh.pose_count - 1);
  if (!(blend.t > 0.0f) || blend.a == blend.b) return {blend.a, blend.a, 0.0f};
  if (blend.t >= 1.0f) return {blend.b, blend.b, 0.0f};
  return blend;
}

Bounds InstanceCopies::bounds(const MeshRecord& mesh, const scene::PoseBlend& blend) {
  if (!mesh.posed) return mesh.bounds;
  const Bounds& a = mesh.pose_bounds[blend.a];
  const Bounds& b = mesh.pose_bounds[blend.b];
  // Each vertex stays between its two places, so the box between the two boxes holds it, but for rounding.
  Bounds box{glm::mix(a.min, b.min, blend.t), glm::mix(a.max, b.max, blend.t)};
  vec3 pad = glm::max(glm::abs(box.min), glm::abs(box.max)) * 1e-6f;
  return {box.min - pad, box.max + pad};
}

// As add() and finish() place them, and GpuScene makes room: a leaf's triangles for each copy on the host, and a node
// of the tree above.
SceneRoom InstanceCopies::needs(const MeshRecord& mesh) const {
  SceneRoom room{.copies = on_host(mesh) ? 0u : 1u};
  if (mesh.posed) room.triangles += mesh.triangle_count;
  if (ray_query_) {
    room.vertices = 3 * std::uint64_t{mesh.triangle_count};
    return room;
  }
  room.triangles += shared::kMaxLeafTriangles;
  room.nodes = 1;
  if (!on_host(mesh)) {
    room.triangles += mesh.triangle_count;
    room.nodes += mesh.node_count;
  }
  return room;
}

SceneRoom InstanceCopies::room(SceneAssets& assets) const {
  const auto left = [](std::uint64_t most, std::uint64_t taken) { return most - std::min(most, taken); };
  SceneRoom room;
  room.instances = shared::kNoIndex >> shared::kTriangleInstanceShift;
  room.copies = room.instances;
  room.triangles = left(assets.triangles().most(), assets.triangles().kept() + shared::kMaxLeafTriangles);
  room.nodes = left(assets.nodes().most(), assets.nodes().kept() + kSubtrees + 1);
  room.vertices = left(assets.vertices().most(), assets.vertices().kept());
  return room;
}

void InstanceCopies::begin(SceneAssets& assets) {
  std::swap(copies_, before_);
  copies_.clear();
  host_triangles_.clear();
  // The assets hold the fronts of the arrays.
  next_triangle_ = assets.triangles().kept();
  next_node_ = assets.nodes().kept();
  next_vertex_ = assets.vertices().kept();
}

std::uint32_t InstanceCopies::add(const SceneAssets& assets, const scene::Instance& instance, std::uint32_t index,
                                  bool asks) {
  const MeshRecord& mesh = assets.meshes()[instance.mesh];
  InstanceCopy copy;
  copy.mesh = instance.mesh;
  copy.blend = canonical(mesh, instance.pose);
  copy.asks = asks || mesh.asks;
  if (mesh.posed) {
    copy.object_triangle = next_triangle_;
    next_triangle_ += mesh.triangle_count;
  } else {
    copy.object_triangle = mesh.first_triangle;
  }
  if (ray_query_) {
    copy.first_vertex = next_vertex_;
    next_vertex_ += 3 * mesh.triangle_count;
  } else {
    copy.transform = instance.transform;
    copy.owner = (asks ? shared::kTriangleAsks : 0u) |
                 (instance.visibility & scene::kSeenByAll) << shared::kTriangleVisibilityShift |
                 index << shared::kTriangleInstanceShift;
    if (!on_host(mesh)) {
      copy.world_triangle = next_triangle_;
      copy.first_node = next_node_;
      copy.root = mesh.root < shared::kRefLeaf ? mesh.root - mesh.first_node + next_node_
                                               : mesh.root - mesh.first_triangle + next_triangle_;
      next_triangle_ += mesh.triangle_count;
      next_node_ += mesh.node_count;
    }
  }
  copies_.push_back(copy);
  return static_cast<std::uint32_t>(copies_.size()) - 1;
}

void InstanceCopies::finish(const SceneAssets& assets, bool forget) {
  for (std::size_t i = 0; i < copies_.size() && i < before_.size() && !forget; ++i) {
    before_[i].as_before = false;
    copies_[i].as_before = copies_[i] == before_[i];
  }
  for (InstanceCopy& copy : copies_) {
    const MeshRecord& mesh = assets.meshes()[copy.mesh];
    if (!on_host(mesh)) continue;
    copy.world_triangle = next_triangle_ + static_cast<std::uint32_t>(host_triangles_.size());
    copy.root = mesh.root - mesh.first_triangle + copy.world_triangle;
    for (const shared::GpuTriangle& t : mesh.small) host_triangles_.push_back(in_world(t, copy));
  }
}

std::vector<shared::GpuCopyJob> InstanceCopies::jobs(const SceneAssets& assets) const {
  std::vector<shared::GpuCopyJob> jobs;
  for (const InstanceCopy& copy : copies_) {
    const MeshRecord& mesh = assets.meshes()[copy.mesh];
    if (copy.as_before || on_host(mesh)) continue;
    shared::GpuCopyJob job{};
    for (int i = 0; i < 3; ++i) {
      const mat4x3& m = copy.transform;
      job.to_world[i] = vec4(m[0][i], m[1][i], m[2][i], m[3][i]);
    }
    job.scale = vec4(mesh.pose_scale, 0);
    job.origin = vec4(mesh.pose_origin, 0);
    job.pose_a = job.pose_b = shared::kNoIndex;
    if (mesh.posed) {
      job.pose_a = mesh.first_pose_vertex + copy.blend.a * mesh.vertex_count;
      job.pose_b = mesh.first_pose_vertex + copy.blend.b * mesh.vertex_count;
    }
    job.pose_t = copy.blend.t;
    job.triangle_count = mesh.triangle_count;
    job.first_attribute = mesh.first_attribute;
    job.object_triangle = copy.object_triangle;
    job.world_triangle = copy.world_triangle;
    job.first_vertex = copy.first_vertex;
    job.owner = copy.owner;
    job.mesh_node = mesh.first_node;
    job.mesh_triangle = mesh.first_triangle;
    job.first_node = copy.first_node;
    job.first_level_entry = mesh.first_level_entry;
    FB_CHECK_LT(mesh.level_first.size(), std::size_t{shared::kCopyLevels});
    job.level_count = static_cast<std::uint32_t>(mesh.level_first.size()) - 1;
    std::copy(mesh.level_first.begin(), mesh.level_first.end(), job.level_first);
    jobs.push_back(job);
  }
  return jobs;
}

}  // namespace fb::render
