// fullbright-lab iterate: offline rendering in iterations. A run begins with nothing learnt, takes the samples of a
// schedule on a view that stands still, one a pixel and frame, and ends with one picture: the mean of all samples or,
// where the technique makes it itself, what its final passes say. Its cost is all that ran: learning, all samples and
// the final passes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "lab/bench/bench_job.h"
#include "lab/iterate/schedule.h"
#include "render/renderer.h"

namespace fb::lab {

struct IteratedPicture {
  Picture picture;
  std::uint32_t samples = 0;            // a pixel
  double gpu_ms = 0, estimator_ms = 0;  // of all passes, and of those of kind kEstimator
  double wall_ms = 0;                   // by the clock, with what the host does between frames
  std::string report;                   // what the technique has kept (render::Technique::report)
};
// Between iterations, of a picture that several runs of a program make.
struct IterationBreaks {
  std::uint32_t first = 0;  // iterations that the renderer has resumed (Renderer::resume_iterations)
  // After each iteration but the last: how many are done, and their samples a pixel. False: the picture is given up,
  // and what render_iterations returns has none.
  std::function<bool(std::uint32_t iterations, std::uint32_t samples)> ended;
};
// The renderer has its size. Of the settings the samples a frame, accumulation and the denoiser are set here
// (settings_of_samples). `progress`: samples that are done.
IteratedPicture render_iterations(render::Renderer& renderer, render::RenderSettings settings,
                                  scene::FrameSnapshot snapshot, const Schedule& schedule,
                                  const std::function<void(std::uint32_t)>& progress,
                                  const IterationBreaks* breaks = nullptr);

struct IterateJob {
  std::vector<Configuration> configurations;  // gains are against the first
  Schedule schedule;
  std::uint32_t width = 320, height = 180;
  std::uint32_t runs = kFewestRuns;
  MetricOptions metrics;
  bool quiet = false;
};
struct IteratedConfiguration {
  std::string name, estimator;
  Frames runs;                  // a run is a record: its picture's errors, the times of all its passes
  WindowStatistics statistics;  // of these
  Estimate gpu_ms, estimator_ms, wall_ms;
  double variance = 0, bias_squared = 0;  // of the runs' pictures, and of their mean
  std::uint32_t not_finite = 0;           // samples, which counted as zero
  Picture first;                          // the first run's picture
  std::string report;                     // of the first run
};
struct IterateResult {
  Schedule schedule;
  std::uint32_t width = 0, height = 0;
  ReferenceFigures reference;
  std::string device, intersector;
  std::vector<IteratedConfiguration> configurations;
};
// Run by run the configurations take turns, in rotating order, a renderer each. Run n (from 0) has seed r_seed + 1 + n.
// Fails where a renderer cannot be made, sizes differ, or r_spp says how many samples a frame has.
Result<IterateResult> run_iterate(gpu::Device& device, const View& view, const Reference& reference,
                                  const IterateJob& job);

}  // namespace fb::lab
