#include "render/scene/gpu_scene_rays.h"

#include <algorithm>
#include <numeric>

namespace fb::render {

RayStructures::RayStructures(gpu::Device& device, gpu::BuildPreference preference)
    : device_(device), preference_(preference), indices_(device, gpu::BufferUse::kGeometry, "indices") {}

void RayStructures::prepare(SceneAssets& assets, std::vector<RayInstance> instances) {
  instances_ = std::move(instances);
  std::uint32_t needed = assets.largest_mesh() * 3;
  if (indices_.kept() < needed) {
    std::vector<std::uint32_t> more(needed - indices_.kept());
    std::iota(more.begin(), more.end(), indices_.kept());
    indices_.append(std::span<const std::uint32_t>(more));
  }
}

void RayStructures::build_mesh(gpu::Commands& commands, SceneAssets& assets, MeshRecord& mesh, bool opaque) {
  gpu::TriangleGeometry geometry;
  geometry.vertices = &assets.vertices().buffer();
  geometry.vertex_offset = std::uint64_t{mesh.first_vertex} * sizeof(vec3);
  geometry.vertex_count = mesh.triangle_count * 3;
  geometry.indices = &indices_.buffer();
  geometry.triangle_count = mesh.triangle_count;
  geometry.opaque = opaque;
  mesh.bottom_level.build(device_, commands, geometry, preference_);
  mesh.bottom_level_opaque = opaque;
}

void RayStructures::record(gpu::Commands& commands, SceneAssets& assets, const InstanceCopies& copies) {
  for (const RayInstance& instance : instances_) {
    MeshRecord& mesh = assets.meshes()[instance.mesh];
    if (mesh.posed) continue;
    bool opaque = !mesh.asks && !instance.asks;
    // Once some instance asks, all of the mesh's do: the shader knows which of them mean it.
    if (!mesh.bottom_level || (mesh.bottom_level_opaque && !opaque)) build_mesh(commands, assets, mesh, opaque);
  }
  if (copies_.size() < copies.copies().size()) copies_.resize(copies.copies().size());
  for (std::size_t i = 0; i < copies.copies().size(); ++i) {
    const InstanceCopy& copy = copies.copies()[i];
    if (copy.as_before && copies_[i]) continue;
    const MeshRecord& mesh = assets.meshes()[copy.mesh];
    gpu::TriangleGeometry geometry;
    geometry.vertices = &assets.vertices().buffer();
    geometry.vertex_offset = std::uint64_t{copy.first_vertex} * sizeof(vec3);
    geometry.vertex_count = mesh.triangle_count * 3;
    geometry.indices = &indices_.buffer();
    geometry.triangle_count = mesh.triangle_count;
    geometry.opaque = !copy.asks;
    copies_[i].build(device_, commands, geometry, preference_);
  }
  commands.barrier();

  std::vector<gpu::TopLevelInstance> list;
  list.reserve(instances_.size());
  for (const RayInstance& instance : instances_) {
    gpu::TopLevelInstance item;
    item.transform = instance.transform;
    item.custom_index = instance.index;
    item.mask = static_cast<std::uint8_t>(instance.visibility);
    item.bottom_level = instance.copy == shared::kNoIndex ? assets.meshes()[instance.mesh].bottom_level.address()
                                                          : copies_[instance.copy].address();
    list.push_back(item);
  }
  if (must_grow() && !list.empty()) {
    // Some more that nothing sees, so that the next few instances need no other handle.
    gpu::TopLevelInstance spare = list.back();
    spare.mask = 0;
    list.resize(list.size() + list.size() / 2 + 16, spare);
  }
  top_.build(device_, commands, list, preference_);
  capacity_ = std::max({capacity_, list.size(), std::size_t{1}});
}

}  // namespace fb::render
