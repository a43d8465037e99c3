#include "render/scene/ray_list.h"

#include <chrono>
#include <ratio>

#include "render/passes/shader_code.h"

namespace fb::render {

RayList::RayList(gpu::Device& device, const GpuSceneOptions& options, bool candidates)
    : device_(device), table_(device), scene_(device, table_, options) {
  const gpu::SpecializationConstant constants[]{
      {shared::kSpecCandidates, candidates ? 1u : 0u},
      {shared::kSpecGpuLanes, lanes_of_gpu(device, options.gpu_lanes) ? 1u : 0u}};
  pipeline_ = make_pipeline(device, table_, "trace_rays", options.ray_query,
                            arrays_by_address(device, options.by_address), constants);
}

void RayList::load(const scene::FrameSnapshot& snapshot, std::span<const shared::ListRay> rays) {
  count_ = static_cast<std::uint32_t>(rays.size());
  rays_ = gpu::Buffer(device_, gpu::BufferUse::kStorage, rays.size_bytes(), "rays");
  hits_ = gpu::Buffer(device_, gpu::BufferUse::kStorage, rays.size() * sizeof(shared::ListHit), "hits");
  gpu::upload_now(device_, rays_, rays);
  EmissionScales scales;
  scales.fill(1.0f);
  scene_.prepare(snapshot, scales);
  scene_.stage();
  table_.set_array(shared::kSetFrame, shared::kBindRays, rays_);
  table_.set_array(shared::kSetFrame, shared::kBindHits, hits_);
  table_.flush();
  device_.run([&](gpu::Commands& commands) {
    commands.bind(table_);
    scene_.record(commands);
  });
}

double RayList::trace() {
  const auto start = std::chrono::steady_clock::now();
  device_.run([&](gpu::Commands& commands) {
    commands.bind(table_);
    commands.push(count_);
    commands.dispatch(pipeline_, (count_ + 63) / 64);
    commands.barrier();
  });
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::vector<shared::ListHit> RayList::hits() const { return gpu::read_now<shared::ListHit>(device_, hits_, count_); }

}  // namespace fb::render
