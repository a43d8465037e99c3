// Copies: what is not the world stands in the world's space as triangles and a tree of its own, made on the device for
// each instance (passes/pose.comp). A copy that stands where it stood, as it was, is not made again. Meshes of a leaf's
// few triangles (particles) are copied on the host. For ray queries only posed meshes have copies, in their own space.
#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/gpu_scene_assets.h"
#include "render/scene/gpu_scene_room.h"
#include "scene/snapshot.h"

namespace fb::render {

struct InstanceCopy {
  std::uint32_t mesh = 0;
  scene::PoseBlend blend;
  mat4x3 transform{1.0f};
  std::uint32_t owner = 0;            // what its triangles say whose they are
  std::uint32_t object_triangle = 0;  // posed: where its triangles in the mesh's space stand
  std::uint32_t world_triangle = 0, first_node = 0, first_vertex = 0;
  std::uint32_t root = 0;  // a reference
  bool asks = false;       // candidates must be asked (ray queries)
  bool as_before = false;
  bool operator==(const InstanceCopy&) const = default;
};

class InstanceCopies {
 public:
  explicit InstanceCopies(bool ray_query) : ray_query_(ray_query) {}
  // What a copy of this mesh takes.
  SceneRoom needs(const MeshRecord& mesh) const;
  // What there is for all of a frame's copies, and for the tree above them.
  SceneRoom room(SceneAssets& assets) const;
  // Starts a frame.
  void begin(SceneAssets& assets);
  // A copy for the instance that will have this index on the device; returns the copy's index.
  std::uint32_t add(const SceneAssets& assets, const scene::Instance& instance, std::uint32_t index, bool asks);
  // Ends it: places what the host copies behind the rest, and marks what is as it was, unless `forget` (the buffers are
  // new, or what was to be made was not).
  void finish(const SceneAssets& assets, bool forget);
  // Something else moved or overwrote the copies: the next frame makes all of them.
  void forget() { before_.clear(); }

  const std::vector<InstanceCopy>& copies() const { return copies_; }
  // What the device has to make.
  std::vector<shared::GpuCopyJob> jobs(const SceneAssets& assets) const;
  // What the host has made: triangles that stand from host_triangle() on.
  const std::vector<shared::GpuTriangle>& host_triangles() const { return host_triangles_; }
  std::uint32_t host_triangle() const { return next_triangle_; }
  // Where the frame's own parts of the device's arrays end.
  std::uint32_t end_triangle() const { return next_triangle_ + static_cast<std::uint32_t>(host_triangles_.size()); }
  std::uint32_t end_node() const { return next_node_; }
  std::uint32_t end_vertex() const { return next_vertex_; }

  // Poses clamped to those that exist; blends that show one pose alone are written one way.
  static scene::PoseBlend canonical(const MeshRecord& mesh, scene::PoseBlend blend);
  // A box around the mesh between two poses.
  static Bounds bounds(const MeshRecord& mesh, const scene::PoseBlend& canonical_blend);

 private:
  bool on_host(const MeshRecord& mesh) const { return !ray_query_ && !mesh.small.empty(); }
  bool ray_query_;
  std::vector<InstanceCopy> copies_, before_;
  std::vector<shared::GpuTriangle> host_triangles_;
  std::uint32_t next_triangle_ = 0, next_node_ = 0, next_vertex_ = 0;
};

}  // namespace fb::render
