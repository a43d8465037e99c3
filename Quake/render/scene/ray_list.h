// RayList: traces lists of rays through a GpuScene, for tests and the traversal benchmark.
#pragma once

#include <span>
#include <vector>

#include "gpu/commands.h"
#include "gpu/pipeline.h"
#include "render/scene/gpu_scene.h"
#include "shared/ray_list.h"

namespace fb::render {

class RayList {
 public:
  // `candidates`: hits on alpha-tested triangles and translucent instances must ask (see passes/trace_rays.comp).
  RayList(gpu::Device& device, const GpuSceneOptions& options, bool candidates);

  GpuScene& scene() { return scene_; }
  // Uploads the snapshot and the rays, and does the frame's device work.
  void load(const scene::FrameSnapshot& snapshot, std::span<const shared::ListRay> rays);
  // Traces what is loaded and waits; milliseconds on the host's clock.
  double trace();
  std::vector<shared::ListHit> hits() const;

 private:
  gpu::Device& device_;
  gpu::BindingTable table_;
  GpuScene scene_;
  gpu::ComputePipeline pipeline_;
  gpu::Buffer rays_, hits_;
  std::uint32_t count_ = 0;
};

}  // namespace fb::render
