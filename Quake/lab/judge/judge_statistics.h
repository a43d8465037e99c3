// The judge's figures: of a seed, of a view over seeds, of a suite over views; all with 95% intervals over seeds. No
// device and no files: figures in, figures out.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lab/statistics.h"

namespace fb::lab {

enum JudgeFigure : std::size_t {
  kFlip,           // LDR-FLIP of the shown picture, mean over pixels
  kFlipEdges,      // the same over silhouettes
  kRelMse,         // of the linear radiance inside of surfaces (interior), less the reference's noise
  kRelMseTrimmed,  // without the worst 0.1% of pixels
  kBias,           // mean(x - r) / mean(r) of the linear radiance, there
  kFlicker,        // frame_metrics.h
  kLag,            // likewise
  kDark,
  kBright,    // isolated pixels of a frame
  kTopShare,  // of the squared error there, what the worst 0.1% of pixels hold
  kGBufferMs,
  kPathsMs,
  kDenoiserMs,
  kAllMs,  // device time of a frame, milliseconds
  kFigureCount
};
struct FigureInfo {
  const char* key;
  // Errors and times multiply: their logarithms are averaged over seeds and views, and the interval is that of the
  // mean logarithm. A seed whose fireflies make its error ten times larger then widens the interval both ways and
  // does not rule the mean. Others (bias, counts, shares) are averaged as they are.
  bool multiplies;
  std::size_t fewest = kFewestSteadyRuns;  // seeds that an interval wants: more where fireflies rule
};
const FigureInfo& info(JudgeFigure figure);

using Figures = std::array<double, kFigureCount>;  // not a number: unknown
Figures unknown_figures();
// Of several frames; unknown ones are left out.
Figures mean_of(const std::vector<Figures>& frames);

struct LaneFigures {
  std::vector<Figures> seeds;                    // each the mean of its frames
  std::uint32_t most_dark = 0, most_bright = 0;  // in any frame of any seed
  std::uint64_t not_finite = 0;                  // pixels of linear radiance; they counted as zero
};
// One figure of a lane in a view; an interval from kFewestSteadyRuns seeds on. `reference_error`:
// standard error that the reference gives to it, for the bias.
Estimate over_seeds(const LaneFigures& lane, JudgeFigure figure, double reference_error = 0);

// What the reference allows to be said of a view.
struct ReferenceFacts {
  double interior = 0;      // share of pixels inside of surfaces, of which all that follows but flip is told
  double mean = 0;          // radiance, over pixels and channels
  double epsilon = 0;       // of relMSE
  double rel_variance = 0;  // its own share of relMSE, which was taken off
  double bias_error = 0;    // standard error of its mean, relative
  double flip = 0;          // FLIP of its own noise
};

// A suite: the views that every lane has a figure of, weighed alike, seed by seed; so lanes are paired by view and
// seed. An error that is not positive (all of it was the reference's noise) counts as the reference's share of it.
struct ViewFigures {
  std::vector<LaneFigures> lanes;
  ReferenceFacts reference;
};
Estimate over_views(const std::vector<ViewFigures>& views, std::size_t lane, JudgeFigure figure);
// relMSE of the first lane over this one's, times what the first costs over this one: samples a pixel, or time of all
// passes. Above 1: better than the first.
struct JudgeGain {
  Estimate equal_samples, equal_time;
};
JudgeGain gain_over_first(const std::vector<ViewFigures>& views, std::size_t lane,
                          const std::vector<std::uint32_t>& spp);

}  // namespace fb::lab
