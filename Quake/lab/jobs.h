// Renders chosen frames of a source, each of so many samples.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "lab/frame_source.h"
#include "render/renderer.h"

namespace fb::lab {

enum class ImageFormat { kNone, kPng, kExr, kBoth };

struct RenderJob {
  std::uint64_t first = 0, last = 0;  // frames, inclusive; earlier ones are played and not written
  std::uint64_t warmup = 0;           // of these, so many are rendered, for an estimator and a denoiser to learn from
  std::uint32_t width = 640, height = 360;
  std::uint32_t spp = 1;  // samples a pixel and frame
  std::string out;        // folder; empty: nothing is written
  ImageFormat format = ImageFormat::kPng;
  bool hash = false;   // print `frame N hash H` of the linear image
  bool quiet = false;  // no progress on stderr
};
struct RenderSummary {
  std::uint64_t frames = 0;
  // GPU time of every pass, milliseconds: one entry a frame, its passes of samples added up. The first frame's hold
  // what drivers compile when a shader first runs.
  struct Pass {
    std::string name;
    std::vector<double> milliseconds;
    render::PassKind kind = render::PassKind::kFrame;
    double median() const;
  };
  std::vector<Pass> passes;
};
// Samples of each of the passes that make `spp`: a divisor of it, at most 16, so that progress shows and no device's
// watchdog bites; or at most `most`, fewer for an estimator that learns from pass to pass.
constexpr std::uint32_t kMostPerPass = 16;
std::uint32_t samples_per_pass(std::uint32_t spp, std::uint32_t most = kMostPerPass);
// Averages `spp` samples of one snapshot in the renderer's linear image, in passes of equally many, whose scatter gives
// its variance. Adds the time they took to `summary` as a frame; tells `progress` how many samples are done.
void render_samples(render::Renderer& renderer, render::RenderSettings& settings, const scene::FrameSnapshot& snapshot,
                    std::uint32_t spp, RenderSummary& summary, const std::function<void(std::uint32_t)>& progress,
                    std::uint32_t most_per_pass = kMostPerPass);

// Renders frames in order. A demo that ends before job.last is an error that says how many frames there were.
Result<RenderSummary> render_frames(FrameSource& source, render::Renderer& renderer, render::RenderSettings settings,
                                    const RenderJob& job);

}  // namespace fb::lab
