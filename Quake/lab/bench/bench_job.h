// fullbright-lab bench: configurations of the renderer side by side on one view, speed against error.
//
// They run interleaved, a renderer each, frame by frame and in rotating order, so that what disturbs the machine
// disturbs all alike. Every frame is independent of the others but for what the estimator learns: no accumulation, no
// denoiser, nothing clamped. Every run starts cold, with another seed; the reference has a seed of its own.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "lab/bench/bench_statistics.h"
#include "lab/bench/bench_view.h"
#include "render/renderer.h"

namespace fb::lab {

struct Configuration {
  std::string name;
  render::RenderSettings settings;
};
struct BenchJob {
  std::vector<Configuration> configurations;  // gains are against the first
  std::uint32_t width = 320, height = 180;
  std::uint32_t runs = 1;
  MetricOptions metrics;
  bool quiet = false;
};

struct ConfigurationResult {
  std::string name, estimator;
  Frames frames;
  struct Pass {
    std::string name;
    double median = 0, p10 = 0, p90 = 0;  // milliseconds of the measured frames
    render::PassKind kind = render::PassKind::kFrame;
  };
  std::vector<Pass> passes;
  Pass all, estimator_passes;    // of all passes' sums, and of the estimator's own
  std::uint32_t not_finite = 0;  // samples, which counted as zero
  std::vector<WindowStatistics> windows;
  // Still views, over the last window's frames of all runs: sample variance of a frame, squared bias of their mean,
  // which is not a number where frames are correlated (render::Frames).
  double variance = 0, bias_squared = 0;
  Picture picture;  // the mean of those frames, or of a view that moves the last one
};
struct BenchResult {
  bool still = false;
  std::uint32_t width = 0, height = 0;
  std::uint64_t first_frame = 0;  // the view's number of the first of the warm-up; 0 if still
  ReferenceFigures reference;
  std::string device, intersector;
  std::vector<ConfigurationResult> configurations;
};
// `references` as make_references gives them. Fails if a renderer cannot be made or sizes differ.
Result<BenchResult> run_bench(gpu::Device& device, const View& view, const std::vector<Reference>& references,
                              const BenchJob& job);

}  // namespace fb::lab
