// Renderer: a snapshot and a draw list in, a picture out. Owns the frame's buffers and passes; the list of passes in
// record_passes() is the way of a frame.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/maths.h"
#include "base/result.h"
#include "gpu/commands.h"
#include "gpu/device.h"
#include "render/denoiser.h"
#include "render/gpu_scene.h"
#include "render/settings.h"
#include "scene/draw_list.h"
#include "scene/snapshot.h"
#include "shared/frame.h"

namespace fb::render {

struct EstimatorInfo {
  std::string name, description;
  bool unbiased;
  bool learns;                  // keeps what it learnt from frame to frame
  bool tail = false;            // its paths end in the irradiance cache
  bool samples_lights = false;  // wants the list of lights
};
const std::vector<EstimatorInfo>& estimators();

class Renderer {
 public:
  // Fails if the device lacks what the settings ask for, with a sentence that says what to choose.
  static Result<std::unique_ptr<Renderer>> create(gpu::Device& device, const RenderSettings& settings);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Output size in pixels, at least 1x1. What is rendered is RenderSettings::scale of it.
  void resize(std::uint32_t width, std::uint32_t height);
  uvec2 output_size() const;
  uvec2 render_size() const;
  // The lowest byte of output pixels is blue (for swapchains that want it).
  void set_swap_red_blue(bool swap);

  // Makes what the output size and these settings need now, not at the next frame. Fails where there is no memory for
  // it, or the device takes nothing so large; then nothing is left to read until a frame has been rendered.
  Status fit(const RenderSettings& settings);

  // Renders one frame and waits for it. Throws OutOfMemory or std::bad_alloc; the next frame is rendered all the same
  // if size and settings are what there is memory for, and what was learnt and accumulated begins anew. The same
  // snapshot again (nothing moved, same time) accumulates. An unknown estimator or a ray query where there is none
  // keeps the former choice and says so once.
  void render(const scene::FrameSnapshot& snapshot, const scene::DrawList* draw, const RenderSettings& settings);
  // Starts accumulation anew at the next frame.
  void restart_accumulation();

  // Forgets what the estimator has learnt.
  void reset_learning();

  // Frames averaged in the linear image.
  std::uint32_t accumulated_frames() const;
  const std::string& intersector_name() const;  // "query" or "bvh"

  const gpu::Buffer& output_pixels() const;         // packed 8-bit pixels, output size
  std::vector<std::uint32_t> read_output() const;   // r lowest (unless swapped)
  std::vector<vec4> read_linear() const;            // mean radiance, linear Rec.709; w: frames averaged
  std::vector<vec4> read_denoised() const;          // denoised radiance; the raw mean where the denoiser is off
  std::vector<vec4> read_variance_of_mean() const;  // per channel, from the accumulated frames (zero for one)
  std::vector<shared::GBufferTexel> read_gbuffer() const;
  // Samples that were not finite, since the renderer was made; they counted as zero.
  std::uint32_t nan_count() const;
  // Irradiances that were not finite and were kept out of the denoiser's history.
  std::uint32_t history_nan_count() const;
  const Denoiser& denoiser() const;

  // States of the guide that were not finite and were not stored.
  std::uint32_t guide_nan_count() const;
  std::uint64_t guide_bytes() const;  // device memory of what the estimator learns

  const std::vector<gpu::PassTime>& pass_times() const;  // of the last frame
  double gpu_milliseconds() const;                       // their sum
  const SceneStatistics& scene_statistics() const;
  std::uint64_t device_bytes() const;

  struct Impl;

 private:
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace fb::render
