// Renderer: a snapshot and a draw list in, a picture out. Owns the frame's buffers; Impl::list_passes() is the way of a
// frame. What an estimator does of its own is a Technique.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/maths.h"
#include "base/result.h"
#include "gpu/commands.h"
#include "gpu/device.h"
#include "render/picture/denoiser.h"
#include "render/scene/gpu_scene.h"
#include "render/passes/pass.h"
#include "render/picture/readback.h"
#include "render/passes/settings.h"
#include "render/techniques/technique.h"
#include "scene/draw_list.h"
#include "scene/snapshot.h"

namespace fb::render {

class Renderer {
 public:
  // Fails if the device lacks what the settings ask for, with a sentence that says what to choose.
  static Result<std::unique_ptr<Renderer>> create(gpu::Device& device, const RenderSettings& settings);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Output size in pixels, at least 1x1. What is rendered is RenderSettings::scale of it.
  void resize(std::uint32_t width, std::uint32_t height);
  uvec2 output_size() const;  // as it was asked for last
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
  // The same without waiting: the host's part of this frame is done beside the device's part of the former one, which
  // is finished before this one's begins. Whatever reads results finishes it, too.
  void begin(const scene::FrameSnapshot& snapshot, const scene::DrawList* draw, const RenderSettings& settings);
  void finish();
  // Called when a frame that was begun is finished, before the next one can overwrite its output.
  void set_finished(std::function<void()> finished);
  // Called some twenty times a second, on the caller's thread, while a frame waits for shaders that are compiled. It
  // must not call this renderer, nor throw. Once it says false, begin() throws ShadersAbandoned
  // (render/passes/shader_set.h), and this renderer draws no more.
  void set_waiting(std::function<bool()> waiting);
  // What ShaderSet says of them (render/passes/shader_set.h). Off; a change is for shaders not made yet.
  void set_precompiles(bool precompiles);
  void set_hurries(bool hurries);
  // No shader is being made beside the frames: they take the time that they will take, and nothing that was abandoned
  // holds the destructor up.
  bool settled() const;
  // Starts accumulation anew at the next frame.
  void restart_accumulation();

  // Forgets what the estimator has learnt.
  void reset_learning();
  // Offline iterations (render/techniques/technique.h): the next frame is the first of iteration `number`, from 0, in
  // which frames take `samples` a pixel together.
  void begin_iteration(std::uint32_t number, std::uint32_t samples);
  // The next frame's picture is that of all iterations, made by the technique's final passes: only where it has them
  // (TechniqueInfo::ends_iterations). It is averaged with no other frame.
  void end_iterations();
  // What the picture goes on from in another program, after the last frame of an iteration that is not the last
  // (Technique::save_iterations); empty: the technique cannot.
  Bytes save_iterations();
  // Takes the place of these iterations, of so many frames. This renderer has rendered a frame of the same snapshot and
  // settings; what it learnt is forgotten. Fails where the state is damaged.
  Status resume_iterations(ByteView state, std::uint32_t frames);
  std::string iterations_report() const;  // Technique::report

  // Frames averaged in the linear image.
  std::uint32_t accumulated_frames() const;
  const std::string& intersector_name() const;  // "query" or "bvh"

  const gpu::Buffer& output_pixels() const;  // packed 8-bit pixels, output size
  Readback read() const;                     // of the last frame
  const Denoiser& denoiser() const;
  std::uint64_t learnt_bytes() const;  // device memory of what the technique learns

  const std::vector<PassTime>& pass_times() const;  // of the last frame
  double gpu_milliseconds() const;                  // their sum
  double wait_milliseconds() const;                 // for which the host waited for the last frame
  const SceneStatistics& scene_statistics() const;
  std::uint64_t device_bytes() const;

  struct Impl;

 private:
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace fb::render
