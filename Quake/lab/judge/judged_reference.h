// References of judged frames: many samples of exactly such a frame, over the whole pixel, with their variance, what
// the camera sees, and the exposure at which the frame is shown. Kept on disk, so that each is made once.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "lab/bench/bench_view.h"
#include "lab/judge/frame_metrics.h"
#include "render/renderer.h"

namespace fb::lab {

struct JudgedReference {
  Reference radiance;
  Guides guides;         // without jitter
  float exposure = 1;    // the automatic one of this reference, times r_exposure; or r_exposure alone if that is fixed
  bool tone_map = true;  // r_tonemap
};

struct JudgedReferenceOptions {
  std::string estimator = "nee";  // unbiased; finds small lamps
  std::uint32_t spp = 2048;
  std::uint32_t width = 320, height = 180;
  std::string folder;  // where they are kept, as KEY.exr; empty: nowhere
  std::string label;   // before the progress: the view
  bool quiet = false;
};

// What a reference depends on: everything that is seen (content_key: the scene or game data, the frame, its time), the
// settings that change the mean of an unbiased estimator (reflections, emission, texture filter) or its exposure,
// estimator, samples and size. Not the shaders: the mean of all unbiased estimators is one, whatever a change of the
// code does to their noise.
std::uint64_t reference_key(const scene::FrameSnapshot& snapshot, const render::RenderSettings& settings,
                            const JudgedReferenceOptions& options);

// One for each frame of `view` (collect_view with no warm-up), for a still view one alone. Camera rays are jittered;
// the denoiser is off. Fails if a file cannot be written.
Result<std::vector<JudgedReference>> make_judged_references(const View& view, render::Renderer& renderer,
                                                            render::RenderSettings settings,
                                                            const JudgedReferenceOptions& options);

}  // namespace fb::lab
