#include "render/ray_list.h"

#include <chrono>
#include <ratio>

#include "trace_rays_bvh.spv.h"
#include "trace_rays_query.spv.h"

namespace fb::render {

RayList::RayList(gpu::Device& device, const GpuSceneOptions& options, bool candidates)
    : device_(device), table_(device), scene_(device, table_, options) {
  const auto how = trace_constants(device);
  const gpu::SpecializationConstant constants[]{{0, candidates ? 1u : 0u}, how[0], how[1]};
  std::span<const std::uint32_t> code = trace_rays_bvh_spv;
  if (options.ray_query) code = trace_rays_query_spv;
  pipeline_ = gpu::ComputePipeline(device, table_, code, "trace rays", constants);
}

void RayList::load(const scene::FrameSnapshot& snapshot, std::span<const shared::ListRay> rays) {
  count_ = static_cast<std::uint32_t>(rays.size());
  rays_ = gpu::Buffer(device_, gpu::BufferUse::kStorage, rays.size_bytes(), "rays");
  hits_ = gpu::Buffer(device_, gpu::BufferUse::kStorage, rays.size() * sizeof(shared::ListHit), "hits");
  gpu::upload_now(device_, rays_, rays);
  EmissionScales scales;
  scales.fill(1.0f);
  scene_.prepare(snapshot, scales);
  table_.set_frame(shared::kBindRays, rays_);
  table_.set_frame(shared::kBindHits, hits_);
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
