#include "render/techniques/probe_doors.h"

#include <algorithm>

#include "render/techniques/probe_leaves.h"
#include "scene/shapes.h"

namespace fb::render {
namespace {

constexpr float kCovers = 0.98f;  // of a box's side that is whole

// Moved and made larger along its axes, but not turned.
bool stands_straight(const mat4x3& m) {
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (column == row ? !(m[column][row] > 0.0f) : m[column][row] != 0.0f) return false;
  return true;
}

}  // namespace

bool shuts(const scene::Assets& assets, const scene::Mesh& mesh, std::uint32_t material_base) {
  if (mesh.posed() || mesh.bounds.empty()) return false;
  const vec3 size = mesh.bounds.max - mesh.bounds.min;
  int thin = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (size[axis] < size[thin]) thin = axis;
  float to_front = 0, to_back = 0;
  for (const scene::MeshTriangle& t : mesh.triangles) {
    const std::uint32_t index = t.material + material_base;
    if (index >= assets.materials.size()) return false;
    const scene::Material& material = assets.materials[index];
    if ((material.flags & (scene::kMaterialAlphaTest | scene::kMaterialLiquid | scene::kMaterialDielectric)) != 0 ||
        material.alpha < 1.0f)
      return false;
    const vec3 a = scene::vertex_position(mesh, t.vertices[0]);
    const vec3 normal =
        glm::cross(scene::vertex_position(mesh, t.vertices[1]) - a, scene::vertex_position(mesh, t.vertices[2]) - a);
    (normal[thin] > 0.0f ? to_front : to_back) += 0.5f * std::abs(normal[thin]);
  }
  const float whole = kCovers * size[(thin + 1) % 3] * size[(thin + 2) % 3];
  return whole > 0.0f && to_front >= whole && to_back >= whole;
}

std::vector<Bounds> ProbeDoors::find(const scene::FrameSnapshot& snapshot, const Bounds& within, std::size_t most) {
  std::vector<Bounds> doors;
  if (!snapshot.assets) return doors;
  const scene::Assets& assets = *snapshot.assets;
  if (generation_ != assets.generation) {
    generation_ = assets.generation;
    shuts_.clear();
  }
  for (const scene::Instance& instance : snapshot.instances) {
    const bool entity = instance.id >= scene::kIdEntity && instance.id < scene::kIdStatic;
    if (!entity || instance.mesh >= assets.meshes.size() || (instance.visibility & scene::kSeenByIndirect) == 0 ||
        instance.alpha < 1.0f || !stands_straight(instance.transform) || doors.size() >= most)
      continue;
    const scene::Mesh& mesh = assets.meshes[instance.mesh];
    const auto [known, fresh] = shuts_.try_emplace(instance.mesh, false);
    if (fresh) known->second = shuts(assets, mesh, instance.material_base);
    if (!known->second) continue;
    const Bounds box = transform_bounds(instance.transform, mesh.bounds);
    if (boxes_meet(box, within)) doors.push_back(box);
  }
  return doors;
}

}  // namespace fb::render
