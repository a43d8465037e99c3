// What a bench says about its frames: error of single frames, of running averages, time, and gains against the first
// configuration with 95% intervals. No device: figures in, figures out.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lab/compare/metrics.h"
#include "lab/statistics.h"

namespace fb::lab {

struct FrameRecord {
  double gpu_ms = 0;        // all passes
  double estimator_ms = 0;  // passes of kind kEstimator
  bool measured = false;    // has errors: warm-up frames of a view that moves have not
  Errors errors;            // this frame alone against its reference
  // Of the mean of this run's frames so far, from the first on and from the first warm one on, less the reference's
  // variance. Still views only.
  double running_mse = 0, running_rel_mse = 0, warm_running_mse = 0, warm_running_rel_mse = 0;
};

struct Frames {
  std::uint32_t runs = 0, warmup = 0, measured = 0;  // records: runs * (warmup + measured), run after run
  std::uint32_t spp = 1;
  std::vector<FrameRecord> records;
  const FrameRecord& at(std::uint32_t run, std::uint32_t index) const {
    return records[std::size_t{run} * (warmup + measured) + index];
  }
};
// `measured` consecutive frames of every run: the first ones (cold) or those behind the warm-up (warm).
struct Window {
  bool warm = false;
  std::uint32_t first = 0;
};

// (Error of the baseline / own error, MSE or relMSE) times a cost of the baseline over the own: samples a pixel, or
// median GPU time of the estimator's passes or of all: the geometric mean over runs of each run's own gain. Not a
// number where the reference's noise is all that a run measured.
struct Gains {
  Estimate samples, time, time_all;
  double samples_of_means = 0;  // as `samples`, of the mean error of all frames of all runs
  // As `time`, but with the median of the frames' own ratios of time, which a busy machine hardly touches: both frames
  // of a pair ran one after the other.
  Estimate time_paired;
  Estimate typical_time;  // as `time`, of the median frame's error
};
// An error over runs.
struct Errored {
  double mean = 0, standard_error = 0;  // the latter unknown (not a number) for one run
  Estimate typical;                     // geometric mean over runs, with its interval
  bool heavy_tail = false;              // rare frames rule it, or rare runs the mean: intervals promise too much
};
struct WindowStatistics {
  Window window;
  Errored mse;            // of frames, corrected
  double mse_median = 0;  // over frames
  Errored rel_mse;
  double rel_mse_median = 0;
  double bias = 0, bias_error = 0;        // mean signed difference; error over runs and of the reference
  double median_pixel = 0;                // mean over frames of the median pixel's squared error
  double top_share = 0;                   // of all squared error, what the worst 0.1% of each frame's pixels hold
  double reference_variance = 0;          // that was taken off, mean
  double gpu_ms = 0, estimator_ms = 0;    // medians
  std::optional<Gains> gains, rel_gains;  // of MSE, of relMSE; none of the first configuration
};
// `baseline` has the same shape; null: no gains. Pairs frames of the same run and index.
WindowStatistics window_statistics(const Frames& frames, const Window& window, const Frames* baseline);

// A frame over the runs, corrected: how errors follow what changes, and how an estimator learns. Every frame that has
// errors, in order; `index` counts from the first of the warm-up.
struct FrameOverRuns {
  std::uint32_t index = 0;
  double mse = 0, mse_error = 0, rel_mse = 0;  // means; standard error, unknown (not a number) for one run
  double estimator_ms = 0;                     // median
};
std::vector<FrameOverRuns> frames_over_runs(const Frames& frames);

// Mean over runs, frame after frame from the window's first: error of the running average, cumulated time.
struct Curve {
  std::vector<double> mse, rel_mse, gpu_ms, estimator_ms;
};
Curve running_curve(const Frames& frames, const Window& window);

}  // namespace fb::lab
