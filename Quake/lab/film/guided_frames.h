// Frames of a film by a technique that learns in iterations (mir, mir_nee). While nothing moves they are one picture:
// each frame adds its samples, teaches, and shows the picture of all so far. When something moves the picture begins
// anew, with what was learnt of directions, and without the paths of the former one. An iteration is one frame, then
// 2, 4, 8, ... frames from the fifth on.
#pragma once

#include <cstdint>

#include "render/renderer.h"

namespace fb::lab {

// Whether a snapshot that differs from another in its time alone looks different: textures that change or warp,
// liquids, a sky that scrolls.
bool shows_time(const scene::FrameSnapshot& snapshot);

class GuidedFrames {
 public:
  // The next frame, of settings.spp samples a pixel; the renderer's picture is that of all samples since something
  // moved, without the denoiser.
  void render(render::Renderer& renderer, render::RenderSettings settings, const scene::FrameSnapshot& snapshot);
  std::uint32_t samples() const { return samples_; }     // a pixel, of the picture that is shown
  double gpu_ms() const { return gpu_ms_; }              // of the last frame's passes,
  double estimator_ms() const { return estimator_ms_; }  // and of those of kind kEstimator

 private:
  scene::FrameSnapshot snapshot_;                        // that stands still
  std::uint64_t key_ = 0;                                // 0: there was no frame
  std::uint32_t iteration_ = 0, frames_ = 1, left_ = 1;  // of the picture, from 0; frames of it; those still to come
  std::uint32_t samples_ = 0, all_ = 0;
  double gpu_ms_ = 0, estimator_ms_ = 0;
};

}  // namespace fb::lab
