// From the tone-mapped picture to the output: anti-aliasing, over time or of each frame by itself, scaling up to the
// window's pixels, and the 2D. Where the device is a CPU what is left at the window's pixels is done on the host.
#pragma once

#include <optional>

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/pipeline.h"
#include "render/passes/pass.h"
#include "render/passes/settings.h"
#include "render/passes/shader_set.h"
#include "render/picture/host_present.h"
#include "render/picture/overlay.h"
#include "scene/draw_list.h"
#include "shared/frame.h"

namespace fb::render {

// What the settings leave to the program, by what the device is.
RenderSettings with_last_step(RenderSettings settings, bool on_cpu);

class LastStep {
 public:
  LastStep(gpu::Device& device, gpu::BindingTable& table);

  // Buffers of these sizes; what was in them is lost.
  void resize(uvec2 smooth, uvec2 output);
  // Between submissions. `list` may be null.
  void prepare(const scene::DrawList* list, uvec2 output, const RenderSettings& settings);
  // Its rows of the uniform block.
  void fill(shared::FrameConstants& constants) const;
  // From the tone-mapped picture on. `warps`: waves distort the picture.
  void add_passes(PassList& list, ShaderSet& shaders, const shared::FrameConstants& constants, bool warps);
  // The device has done that: what is left to the host, if anything is, with its time.
  std::optional<PassTime> finish();

  const gpu::Buffer& output() const { return output_; }

 private:
  gpu::Device& device_;
  gpu::BindingTable& table_;
  Overlay overlay_;
  HostPresent host_;
  gpu::Buffer smoothed_, output_;
  bool on_host_ = false;
  float sharpness_ = 0;
  std::optional<PresentedPicture> left_;  // to the host
};

}  // namespace fb::render
