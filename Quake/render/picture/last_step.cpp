#include "render/picture/last_step.h"

#include <chrono>
#include <ratio>
#include <utility>

namespace fb::render {
namespace {

constexpr float kSmoothScaleOnCpu = 1.0f;

PresentedPicture presented(const shared::FrameConstants& c, bool warps, float sharpness) {
  PresentedPicture p;
  p.size = uvec2(c.smooth_width, c.smooth_height);
  p.output = uvec2(c.output_width, c.output_height);
  p.place = {uvec2(c.picture_x, c.picture_y), uvec2(c.picture_width, c.picture_height)};
  p.tint = c.screen_tint;
  p.sharpness = sharpness;
  p.gamma = c.gamma;
  p.contrast = c.contrast;
  p.warps = warps;
  p.warp_phase = c.warp_phase;
  p.swap_red_blue = c.swap_red_blue != 0;
  return p;
}

}  // namespace

RenderSettings with_last_step(RenderSettings settings, bool on_cpu) {
  if (settings.host_present < 0) settings.host_present = on_cpu ? 1 : 0;
  if (settings.taa_scale < 0) settings.taa_scale = on_cpu ? kSmoothScaleOnCpu : 0.0f;
  return settings;
}

LastStep::LastStep(gpu::Device& device, gpu::BindingTable& table)
    : device_(device), table_(table), overlay_(device, table) {}

void LastStep::resize(uvec2 smooth, uvec2 output) {
  // A CPU's memory is the host's.
  const auto use = device_.is_software() ? gpu::BufferUse::kUpload : gpu::BufferUse::kStorage;
  const auto make = [&](gpu::Buffer& buffer, std::uint32_t binding, uvec2 size, const char* name) {
    buffer = gpu::Buffer();  // the old one's memory goes first
    table_.set_array(shared::kSetFrame, binding, buffer);
    buffer = gpu::Buffer(device_, use, VkDeviceSize{size.x} * size.y * sizeof(std::uint32_t), name);
    table_.set_array(shared::kSetFrame, binding, buffer);
  };
  left_.reset();
  make(smoothed_, shared::kBindSmooth, smooth, "anti-aliased picture");
  make(output_, shared::kBindOutput, output, "output");
}

void LastStep::prepare(const scene::DrawList* list, uvec2 output, const RenderSettings& settings) {
  on_host_ = settings.host_present > 0 && smoothed_.mapped() != nullptr;
  sharpness_ = settings.sharpness;
  if (on_host_) host_.prepare(list);
  overlay_.prepare(on_host_ ? nullptr : list, output.x, output.y);
}

void LastStep::fill(shared::FrameConstants& constants) const {
  constants.draw_quads = !overlay_.empty();
  constants.quad_tiles_x = overlay_.tiles_x();
  constants.atlas_width = overlay_.atlas_width();
}

void LastStep::add_passes(PassList& list, ShaderSet& shaders, const shared::FrameConstants& c, bool warps) {
  const uvec2 smooth(c.smooth_width, c.smooth_height), output(c.output_width, c.output_height);
  const char* over_time = smooth == uvec2(c.width, c.height) ? "temporal_antialias" : "temporal_upscale";
  list.dispatch("antialias", PassKind::kFrame, shaders.get(c.taa != 0 ? over_time : "antialias"),
                groups_over(smooth, 8));
  left_.reset();
  if (on_host_)
    left_ = presented(c, warps, sharpness_);
  else
    overlay_.add_present(list, shaders.get(warps ? "present_warped" : "present"), output);
}

std::optional<PassTime> LastStep::finish() {
  if (!left_) return std::nullopt;
  const auto start = std::chrono::steady_clock::now();
  host_.draw(*std::exchange(left_, std::nullopt), smoothed_.mapped_as<std::uint32_t>(),
             output_.mapped_as<std::uint32_t>());
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
  return PassTime{"present", taken.count(), PassKind::kFrame};
}

}  // namespace fb::render
