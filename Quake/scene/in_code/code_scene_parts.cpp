#include "scene/in_code/code_scene_parts.h"

#include <utility>

#include "scene/in_code/scenes_in_code.h"
#include "scene/shapes.h"

namespace fb::scene {

std::shared_ptr<Assets> new_code_assets() {
  auto assets = std::make_shared<Assets>();
  assets->generation = next_generation();
  assets->palette = code_palette();
  return assets;
}

std::uint32_t add_material(Assets& assets, std::string name, const vec3& color, const vec3& emission) {
  Material material;
  material.name = std::move(name);
  material.base_color = color;
  material.emission = emission;
  material.emission_kind = emission == vec3(0.0f) ? EmissionKind::kNone : EmissionKind::kConstant;
  assets.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(assets.materials.size() - 1);
}

std::uint32_t add_finished(Assets& assets, Mesh mesh, std::string name) {
  mesh.name = std::move(name);
  finish_mesh(mesh);
  assets.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(assets.meshes.size() - 1);
}

std::uint32_t add_sphere_mesh(Assets& assets) { return add_finished(assets, make_sphere(), "sphere"); }

Instance make_instance(std::uint32_t id, std::uint32_t mesh, const mat4x3& transform) {
  Instance instance;
  instance.id = id;
  instance.mesh = mesh;
  instance.transform = instance.prev_transform = transform;
  return instance;
}

mat4x3 placed(const vec3& origin, const vec3& size) {
  return mat4x3(vec3(size.x, 0, 0), vec3(0, size.y, 0), vec3(0, 0, size.z), origin);
}

Camera camera_at(const vec3& position, const vec3& angles, float fov) {
  Camera camera;
  camera.position = position;
  camera.angles = angles;
  camera.fov_x = fov;
  return camera;
}

FrameSnapshot still(std::shared_ptr<const Assets> assets, const Camera& camera) {
  FrameSnapshot snapshot;
  snapshot.assets = std::move(assets);
  snapshot.camera = snapshot.prev_camera = camera;
  return snapshot;
}

Instance glowing(std::uint32_t id, std::uint32_t mesh, std::uint32_t material, const vec3& position, const vec3& size,
                 const vec3& radiance) {
  Instance light = make_instance(id, mesh, placed(position, size));
  light.material_base = material;
  light.flags = kInstanceColor;
  light.color = vec3(0.0f);
  light.emission = radiance;
  return light;
}

std::vector<float> planes(float min, float max, int cells) {
  std::vector<float> at;
  for (int i = 0; i <= cells; ++i)
    at.push_back(min + (max - min) * (static_cast<float>(i) / static_cast<float>(cells)));
  return at;
}

namespace {

struct Carver {
  const BlockGrid& grid;
  const std::vector<float>* axes[3] = {&grid.x, &grid.y, &grid.z};

  vec3 corner(const glm::ivec3& block) const {
    vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = (*axes[axis])[static_cast<std::size_t>(block[axis])];
    return p;
  }
  bool air(const glm::ivec3& block) const {
    for (int axis = 0; axis < 3; ++axis)
      if (block[axis] < 0 || block[axis] + 1 >= static_cast<int>(axes[axis]->size())) return false;
    return grid.air(0.5f * (corner(block) + corner(block + glm::ivec3(1))));
  }
  // The two faces of an air block across an axis, where there is rock behind them.
  void add_faces(Mesh& mesh, const glm::ivec3& block, int axis) const {
    const vec3 low = corner(block), size = corner(block + glm::ivec3(1)) - low;
    glm::ivec3 step(0);
    step[axis] = 1;
    vec3 u(0.0f), v(0.0f), w(0.0f);  // cross(u, v) is along +axis
    u[(axis + 1) % 3] = size[(axis + 1) % 3];
    v[(axis + 2) % 3] = size[(axis + 2) % 3];
    w[axis] = size[axis];
    const vec3 normal = vec3(step), middle = low + 0.5f * (u + v);
    if (!air(block - step)) add_quad(mesh, low, u, v, grid.material(middle, normal));
    if (!air(block + step)) add_quad(mesh, low + w, v, u, grid.material(middle + w, -normal));
  }
};

}  // namespace

void add_carved(Mesh& mesh, const BlockGrid& grid) {
  const Carver carver{grid};
  const auto blocks = [](const std::vector<float>& at) { return static_cast<int>(at.size()) - 1; };
  for (int i = 0; i < blocks(grid.x); ++i)
    for (int j = 0; j < blocks(grid.y); ++j)
      for (int k = 0; k < blocks(grid.z); ++k) {
        const glm::ivec3 block(i, j, k);
        if (!carver.air(block)) continue;
        for (int axis = 0; axis < 3; ++axis) carver.add_faces(mesh, block, axis);
      }
}

}  // namespace fb::scene
