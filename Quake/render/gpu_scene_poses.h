// Posed copies: every distinct (mesh, poses, blend) of a frame gets triangles and a tree of its own on the device,
// whichever instances share it. A copy that stands where it stood, as it was, is not made again.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "render/gpu_scene_assets.h"
#include "scene/snapshot.h"

namespace fb::render {

struct PosedCopy {
  std::uint32_t mesh = 0;
  scene::PoseBlend blend;
  std::uint32_t first_triangle = 0, first_node = 0, first_vertex = 0;
  std::uint32_t root = 0;  // a reference
  bool asks = false;       // candidates must be asked (ray queries)
  bool same_place_as_before = false;
  bool operator==(const PosedCopy&) const = default;
};

class PosedCopies {
 public:
  // Starts a frame.
  void begin(SceneAssets& assets);
  // The copy for a blend of a posed mesh; returns its index.
  std::uint32_t get(const SceneAssets& assets, std::uint32_t mesh, const scene::PoseBlend& blend, bool asks);
  // Ends it: marks what is as it was, unless `forget` (the buffers are new).
  void finish(bool forget);
  // Something else moved or overwrote the copies: the next frame makes all of them.
  void forget() { before_.clear(); }

  const std::vector<PosedCopy>& copies() const { return copies_; }
  // What the device has to make.
  std::vector<shared::GpuPoseJob> jobs(const SceneAssets& assets) const;
  // Where the frame's own parts of the device's arrays end.
  std::uint32_t end_triangle() const { return next_triangle_; }
  std::uint32_t end_node() const { return next_node_; }
  std::uint32_t end_vertex() const { return next_vertex_; }

  // Poses clamped to those that exist; blends that show one pose alone are written one way.
  static scene::PoseBlend canonical(const MeshRecord& mesh, scene::PoseBlend blend);
  // A box around the mesh between two poses.
  static Bounds bounds(const MeshRecord& mesh, const scene::PoseBlend& canonical_blend);

 private:
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, float>;
  std::map<Key, std::uint32_t> index_;
  std::vector<PosedCopy> copies_, before_;
  std::uint32_t next_triangle_ = 0, next_node_ = 0, next_vertex_ = 0;
};

}  // namespace fb::render
