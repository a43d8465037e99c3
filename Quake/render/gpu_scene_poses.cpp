#include "render/gpu_scene_poses.h"

#include <algorithm>

#include "base/check.h"

namespace fb::render {

scene::PoseBlend PosedCopies::canonical(const MeshRecord& mesh, scene::PoseBlend blend) {
  blend.a = std::min(blend.a, mesh.pose_count - 1);
  blend.b = std::min(blend.b, mesh.pose_count - 1);
  if (!(blend.t > 0.0f) || blend.a == blend.b) return {blend.a, blend.a, 0.0f};
  if (blend.t >= 1.0f) return {blend.b, blend.b, 0.0f};
  return blend;
}

Bounds PosedCopies::bounds(const MeshRecord& mesh, const scene::PoseBlend& blend) {
  const Bounds& a = mesh.pose_bounds[blend.a];
  const Bounds& b = mesh.pose_bounds[blend.b];
  // Each vertex stays between its two places, so the box between the two boxes holds it, but for rounding.
  Bounds box{glm::mix(a.min, b.min, blend.t), glm::mix(a.max, b.max, blend.t)};
  vec3 pad = glm::max(glm::abs(box.min), glm::abs(box.max)) * 1e-6f;
  return {box.min - pad, box.max + pad};
}

void PosedCopies::begin(SceneAssets& assets) {
  std::swap(copies_, before_);
  copies_.clear();
  index_.clear();
  // The assets hold the fronts of the arrays.
  next_triangle_ = assets.triangles().kept();
  next_node_ = assets.nodes().kept();
  next_vertex_ = assets.vertices().kept();
}

std::uint32_t PosedCopies::get(const SceneAssets& assets, std::uint32_t mesh_index, const scene::PoseBlend& blend,
                               bool asks) {
  const MeshRecord& mesh = assets.meshes()[mesh_index];
  auto [found, is_new] =
      index_.try_emplace(Key{mesh_index, blend.a, blend.b, blend.t}, static_cast<std::uint32_t>(copies_.size()));
  if (!is_new) {
    copies_[found->second].asks |= asks;
    return found->second;
  }
  PosedCopy copy;
  copy.mesh = mesh_index;
  copy.blend = blend;
  copy.first_triangle = next_triangle_;
  copy.first_node = next_node_;
  copy.first_vertex = next_vertex_;
  copy.root = mesh.root < shared::kRefLeaf ? mesh.root + next_node_ : mesh.root + next_triangle_;
  copy.asks = asks || mesh.asks;
  next_triangle_ += mesh.triangle_count;
  next_node_ += mesh.node_count;
  next_vertex_ += 3 * mesh.triangle_count;
  copies_.push_back(copy);
  return found->second;
}

void PosedCopies::finish(bool forget) {
  for (std::size_t i = 0; i < copies_.size() && i < before_.size() && !forget; ++i) {
    before_[i].same_place_as_before = false;
    copies_[i].same_place_as_before = copies_[i] == before_[i];
  }
}

std::vector<shared::GpuPoseJob> PosedCopies::jobs(const SceneAssets& assets) const {
  std::vector<shared::GpuPoseJob> jobs;
  for (const PosedCopy& copy : copies_) {
    if (copy.same_place_as_before) continue;
    const MeshRecord& mesh = assets.meshes()[copy.mesh];
    shared::GpuPoseJob job{};
    job.scale = vec4(mesh.pose_scale, 0);
    job.origin = vec4(mesh.pose_origin, 0);
    job.pose_a = mesh.first_pose_vertex + copy.blend.a * mesh.vertex_count;
    job.pose_b = mesh.first_pose_vertex + copy.blend.b * mesh.vertex_count;
    job.pose_t = copy.blend.t;
    job.triangle_count = mesh.triangle_count;
    job.first_attribute = mesh.first_attribute;
    job.first_triangle = copy.first_triangle;
    job.first_vertex = copy.first_vertex;
    job.template_node = mesh.first_node;
    job.first_node = copy.first_node;
    FB_CHECK_LT(mesh.level_first.size(), std::size_t{shared::kPoseJobLevels});
    job.level_count = static_cast<std::uint32_t>(mesh.level_first.size()) - 1;
    std::copy(mesh.level_first.begin(), mesh.level_first.end(), job.level_first);
    jobs.push_back(job);
  }
  return jobs;
}

}  // namespace fb::render
