// What scenes made in code are put together from: materials, meshes, instances, spheres that glow, and rooms carved out
// of a grid of blocks.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scene/snapshot.h"

namespace fb::scene {

std::shared_ptr<Assets> new_code_assets();
// Lambert; emission (radiance) is EmissionKind::kConstant where there is any. Gives the material's index.
std::uint32_t add_material(Assets& assets, std::string name, const vec3& color, const vec3& emission = vec3(0.0f));
// Finishes the mesh (shapes.h) and adds it. Gives the mesh's index.
std::uint32_t add_finished(Assets& assets, Mesh mesh, std::string name);
std::uint32_t add_sphere_mesh(Assets& assets);

// Nothing has moved: prev_transform is transform.
Instance make_instance(std::uint32_t id, std::uint32_t mesh, const mat4x3& transform = mat4x3(1.0f));
mat4x3 placed(const vec3& origin, const vec3& size);  // scales, then moves
Camera camera_at(const vec3& position, const vec3& angles, float fov);
// Neither camera nor time moves, all light styles are 1, no instances yet.
FrameSnapshot still(std::shared_ptr<const Assets> assets, const Camera& camera);
// A black body of `radiance`: `mesh` (a sphere of radius 1) scaled by `size`.
Instance glowing(std::uint32_t id, std::uint32_t mesh, std::uint32_t material, const vec3& position, const vec3& size,
                 const vec3& radiance);

// Blocks between planes x[0] < x[1] < ..., likewise y and z; what lies outside of them is rock.
struct BlockGrid {
  std::vector<float> x, y, z;
  // Whether there is air at a block's centre.
  std::function<bool(const vec3& centre)> air;
  // The material of a face that air touches: its centre, and its normal into the air.
  std::function<std::uint32_t(const vec3& centre, const vec3& normal)> material;
};
// The boundary of the air, facing into it: closed, and without T-junctions, by construction.
void add_carved(Mesh& mesh, const BlockGrid& grid);
// `cells` + 1 planes from `min` to `max`.
std::vector<float> planes(float min, float max, int cells);

}  // namespace fb::scene
