#include "render/renderer.h"

#include <algorithm>
#include <utility>

#include "base/out_of_memory.h"
#include "render/renderer_impl.h"
#include "render/scene/intersector_choice.h"

namespace fb::render {

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::create(gpu::Device& device, const RenderSettings& settings) {
  if (settings.intersector == Intersector::kQuery && !device.has_ray_query()) {
    return Error{"r_intersector query: " + device.report().name + " has no ray query; use r_intersector bvh or auto"};
  }
  GpuSceneOptions options;
  if (settings.arrays != ArrayAccess::kAuto) options.by_address = settings.arrays == ArrayAccess::kAddress;
  if (settings.lanes != Lanes::kAuto) options.gpu_lanes = settings.lanes == Lanes::kGpu;
  options.build = settings.fast_build != 0 ? gpu::BuildPreference::kFastBuild : gpu::BuildPreference::kFastTrace;
  return within_memory([&]() -> Result<std::unique_ptr<Renderer>> {
    options.ray_query = settings.intersector == Intersector::kQuery ||
                        (settings.intersector == Intersector::kAuto && device.has_ray_query() &&
                         ray_query_is_faster(device, options.by_address));
    return std::unique_ptr<Renderer>(new Renderer(std::make_unique<Impl>(device, options)));
  });
}

void Renderer::resize(std::uint32_t width, std::uint32_t height) {
  impl_->output_size = uvec2(std::max(width, 1u), std::max(height, 1u));
}
uvec2 Renderer::output_size() const { return impl_->output_size; }
uvec2 Renderer::render_size() const { return impl_->render_size; }
void Renderer::set_swap_red_blue(bool swap) { impl_->swap_red_blue = swap; }

Status Renderer::fit(const RenderSettings& settings) {
  return within_memory([&] {
    impl_->finish();
    impl_->fit(with_last_step(settings, impl_->device.is_software()));
    return ok_status();
  });
}

void Renderer::begin(const scene::FrameSnapshot& snapshot, const scene::DrawList* draw,
                     const RenderSettings& settings) {
  try {
    impl_->begin(snapshot, draw, settings);
  } catch (...) {
    impl_->forget_frame();
    throw;
  }
}

void Renderer::finish() {
  try {
    impl_->finish();
  } catch (...) {
    impl_->forget_frame();
    throw;
  }
}

void Renderer::render(const scene::FrameSnapshot& snapshot, const scene::DrawList* draw,
                      const RenderSettings& settings) {
  begin(snapshot, draw, settings);
  finish();
}

void Renderer::set_finished(std::function<void()> finished) { impl_->finished = std::move(finished); }

void Renderer::set_waiting(std::function<bool()> waiting) { impl_->shaders.set_waiting(std::move(waiting)); }
void Renderer::set_precompiles(bool precompiles) { impl_->shaders.set_precompiles(precompiles); }
void Renderer::set_hurries(bool hurries) { impl_->shaders.set_hurries(hurries); }
bool Renderer::settled() const { return impl_->shaders.settled(); }
void Renderer::restart_accumulation() { impl_->restart = true; }
void Renderer::begin_iteration(std::uint32_t number, std::uint32_t samples) {
  impl_->iteration = uvec2(number, samples);
}
void Renderer::end_iterations() { impl_->ends_iterations = true; }
Bytes Renderer::save_iterations() {
  impl_->finish();
  Bytes state;
  impl_->technique->save_iterations(state);
  return state;
}
Status Renderer::resume_iterations(ByteView state, std::uint32_t frames) {
  impl_->finish();
  impl_->forget_learnt();
  ByteReader reader(state, "iterations");
  if (auto status = impl_->technique->resume_iterations(reader); !status) return status;
  impl_->resumed = frames;
  return ok_status();
}
void Renderer::reset_learning() { impl_->forget_learnt(); }
std::uint32_t Renderer::accumulated_frames() const { return impl_->accumulated; }
const std::string& Renderer::intersector_name() const {
  static const std::string query = "query", bvh = "bvh";
  return impl_->ray_query ? query : bvh;
}

const gpu::Buffer& Renderer::output_pixels() const {
  impl_->finish();
  return impl_->last_step.output();
}
Readback Renderer::read() const {
  impl_->finish();
  const Impl& r = *impl_;
  return Readback({r.device, r.last_step.output(), r.mean, r.m2, r.gbuffer, r.counters, r.exposure, r.denoiser,
                   r.allocated_output, r.render_size, r.constants.work_parity});
}
std::string Renderer::iterations_report() const { return impl_->technique ? impl_->technique->report() : ""; }
std::uint64_t Renderer::learnt_bytes() const { return impl_->technique ? impl_->technique->bytes() : 0; }
const Denoiser& Renderer::denoiser() const { return impl_->denoiser; }

const std::vector<PassTime>& Renderer::pass_times() const {
  impl_->finish();
  return impl_->pass_times;
}
double Renderer::gpu_milliseconds() const {
  impl_->finish();
  double sum = 0;
  for (const PassTime& pass : impl_->pass_times) sum += pass.milliseconds;
  return sum;
}
double Renderer::wait_milliseconds() const {
  impl_->finish();
  return impl_->wait_milliseconds;
}
const SceneStatistics& Renderer::scene_statistics() const { return impl_->scene.statistics(); }
std::uint64_t Renderer::device_bytes() const { return impl_->device.allocated_bytes(); }

}  // namespace fb::render
