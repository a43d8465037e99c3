// The scene as VK_KHR acceleration structures: a bottom level a rigid mesh (built when an instance first needs it), one
// a posed copy (built when the copy changes), and the top level, each frame.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/acceleration_structure.h"
#include "render/scene/gpu_scene_assets.h"
#include "render/scene/gpu_scene_copies.h"

namespace fb::render {

struct RayInstance {
  mat4x3 transform{1.0f};
  std::uint32_t index = 0;  // what hits report
  std::uint32_t visibility = 0;
  std::uint32_t mesh = 0;
  std::uint32_t copy = shared::kNoIndex;  // index of the posed copy, if the mesh is posed
  bool asks = false;
};

class RayStructures {
 public:
  RayStructures(gpu::Device& device, gpu::BuildPreference preference);
  // This frame's instances, along a curve. Between submissions.
  void prepare(SceneAssets& assets, std::vector<RayInstance> instances);
  // Whether the top level must grow: its handle changes when the next record() builds it, so that must happen in a
  // submission of its own, before the descriptor sets are in use.
  bool must_grow() const { return instances_.size() > capacity_ || capacity_ == 0; }
  // After the posed copies' corners have been written.
  void record(gpu::Commands& commands, SceneAssets& assets, const InstanceCopies& copies);
  // What was recorded may not have been done: all is built anew.
  void forget() {
    copies_.clear();
    capacity_ = 0;
  }
  VkAccelerationStructureKHR top_level() const { return top_.handle(); }

 private:
  void build_mesh(gpu::Commands& commands, SceneAssets& assets, MeshRecord& mesh, bool opaque);

  gpu::Device& device_;
  gpu::BuildPreference preference_;
  DeviceArray<std::uint32_t> indices_;  // 0, 1, 2...: corners are listed in leaf order
  std::vector<RayInstance> instances_;
  std::vector<gpu::BottomLevel> copies_;
  gpu::TopLevel top_;
  std::size_t capacity_ = 0;
};

}  // namespace fb::render
