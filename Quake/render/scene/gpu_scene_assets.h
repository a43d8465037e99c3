// What of the scene outlives a frame: texels, the palette, meshes with their trees. Uploaded once, when it first
// appears in the assets; the host keeps a few words a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/acceleration_structure.h"
#include "gpu/commands.h"
#include "render/scene/gpu_scene_array.h"
#include "scene/assets.h"
#include "shared/bvh.h"
#include "shared/scene_gpu.h"

namespace fb::render {

constexpr std::uint32_t kSubtrees = 256;  // parts that a large mesh's tree is taken into
// Of the arrays that meshes share with a frame's copies, one part of so many is kept for the copies.
constexpr std::uint32_t kCopiesPart = 8;

// A part of a mesh's tree: what the top of the frame's tree is built over.
struct SubtreeRef {
  std::uint32_t ref = 0;  // into the device's nodes or triangles
  Bounds bounds;
};

struct MeshRecord {
  std::uint32_t triangle_count = 0;  // 0: nothing to draw
  std::uint32_t first_attribute = 0;
  std::uint32_t first_normal = shared::kNoIndex;
  Bounds bounds;  // of all poses
  // Its tree: the root and what references count from (a posed mesh has no triangles of its own: 0).
  std::uint32_t root = 0;
  std::uint32_t first_triangle = 0;
  std::uint32_t first_node = 0, node_count = 0;
  std::uint32_t first_level_entry = 0;
  std::vector<std::uint32_t> level_first;
  std::vector<SubtreeRef> subtrees;        // of large rigid meshes: the whole tree in parts
  std::vector<shared::GpuTriangle> small;  // of rigid meshes that fit one leaf: their triangles
  bool posed = false;
  std::uint32_t first_pose_vertex = 0, vertex_count = 0, pose_count = 0;
  std::vector<Bounds> pose_bounds;
  vec3 pose_scale{1.0f}, pose_origin{0.0f};
  std::vector<std::uint32_t> order;      // of the mesh's triangles, as leaves hold them
  std::vector<std::uint32_t> materials;  // distinct ones its triangles name, before the instance's base is added
  bool asks = false;                     // some triangle has kTriangleAlphaTest
  // Ray queries, rigid meshes.
  std::uint32_t first_vertex = 0;
  gpu::BottomLevel bottom_level;
  bool bottom_level_opaque = true;
};

class SceneAssets {
 public:
  SceneAssets(gpu::Device& device, bool ray_query);

  // Uploads what is new; everything, if the generation is another one. Between submissions.
  void update(const scene::Assets& assets);
  // The next update uploads everything.
  void forget() { generation_ = 0; }

  std::vector<MeshRecord>& meshes() { return meshes_; }
  const std::vector<MeshRecord>& meshes() const { return meshes_; }
  DeviceArray<shared::BvhNode>& nodes() { return nodes_; }
  DeviceArray<shared::GpuTriangle>& triangles() { return triangles_; }
  DeviceArray<vec3>& vertices() { return vertices_; }  // ray queries only: three a triangle, in leaf order
  const gpu::Buffer& attributes() const { return attributes_.buffer(); }
  const gpu::Buffer& poses() const { return poses_.buffer(); }
  const gpu::Buffer& levels() const { return levels_.buffer(); }
  const gpu::Buffer& normals() const { return normals_.buffer(); }
  const gpu::Buffer& images() const { return images_.buffer(); }
  const gpu::Buffer& texels() const { return texels_.buffer(); }
  const gpu::Buffer& palette() const { return palette_.buffer(); }
  std::uint64_t generation() const { return generation_; }  // 0: of no assets
  std::uint32_t triangle_count() const { return attributes_.kept(); }
  std::uint32_t largest_mesh() const { return largest_mesh_; }  // triangles
  std::uint64_t device_bytes() const;

 private:
  void clear();
  void add_images(const scene::Assets& assets);
  void add_meshes(const scene::Assets& assets);
  struct Batch;  // the new meshes' parts, uploaded together
  MeshRecord add_mesh(const scene::Assets& assets, const scene::Mesh& mesh, Batch& batch) const;
  std::size_t triangles_that_fit(const Batch& batch, bool posed) const;
  void tell_of_cut(const Batch& batch) const;

  gpu::Device& device_;
  bool ray_query_;
  std::uint64_t generation_ = 0;
  std::uint32_t largest_mesh_ = 0;
  std::vector<MeshRecord> meshes_;
  std::size_t images_added_ = 0;
  DeviceArray<shared::BvhNode> nodes_;
  DeviceArray<shared::GpuTriangle> triangles_;
  DeviceArray<vec3> vertices_;
  DeviceArray<shared::GpuAttribute> attributes_;
  DeviceArray<scene::PoseVertex> poses_;
  DeviceArray<std::uint32_t> normals_;
  DeviceArray<std::uint32_t> levels_;
  DeviceArray<shared::GpuImage> images_;
  DeviceArray<std::uint32_t> texels_;
  DeviceArray<vec4> palette_;
};

}  // namespace fb::render
