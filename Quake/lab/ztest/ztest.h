// Whether two estimators have the same mean: z-tests over blocks of pixels, from independent runs of each.
//
// A run is a picture (of one frame, or the mean of some). Its blocks' mean luminances are the data: Welch's t between
// the runs of both sides, block by block, turned into a standard normal z of the same tail (Wallace 1959). Four
// questions are asked of a scene, and the smallest p of the four, times four, is the answer:
//   - block: is one block off? The largest |z|, corrected for their number (Bonferroni, which is Holm's first step);
//   - spread: are many a little off? The sum of z^2 against chi-squared;
//   - energy: is the whole picture too bright or too dark? Welch's t of the runs' means;
//   - relative: the same where every block counts alike, so that dim ones are heard: each over the mean of the 3 x 3
//     blocks about it (over its own mean alone, weight and value would depend on each other and feign a bias).
// Pixels of one run may share what was learnt. While every estimate is unbiased whatever was learnt before it, the
// pixels are uncorrelated all the same, and so are consecutive frames: their deviations are a martingale's steps.
// Frames of one long run may therefore stand for independent runs as long as the scene stands still.
//
// Heavy tails: a run must hold enough light for its blocks to be nearly normal. Where the difference has a standard
// error above `enough` of the mean (the median of the 3 x 3 blocks about a block), blocks are pooled into one, which is
// tested in their stead if it is precise enough. What remains is judged by repetition (ztest_job.h): a bias grows with
// the square root of the runs, a chance does not come twice.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lab/picture.h"
#include "lab/statistics.h"

namespace fb::lab {

class BlockRuns {
 public:
  // Blocks of block x block pixels, those at the right and lower edge smaller.
  BlockRuns(std::uint32_t width, std::uint32_t height, std::uint32_t block);

  void add(const Picture& picture);  // one run; what is not finite counts as zero, and is counted
  std::uint32_t runs() const { return runs_; }
  std::uint32_t blocks_x() const { return blocks_x_; }
  std::uint32_t blocks_y() const { return blocks_y_; }
  std::size_t blocks() const { return pixels_.size(); }
  std::uint64_t not_finite() const { return not_finite_; }
  // Mean luminance of a block in a run, and the number of its pixels.
  double value(std::uint32_t run, std::size_t block) const { return values_[run * blocks() + block]; }
  double pixels(std::size_t block) const { return pixels_[block]; }

 private:
  std::uint32_t width_, height_, block_, blocks_x_, blocks_y_, runs_ = 0;
  std::uint64_t not_finite_ = 0;
  std::vector<double> pixels_, values_;  // run-major
};

struct Welch {
  double difference = 0, error = 0;  // of the means, test less reference; its standard error
  double degrees = 0;                // of freedom (Welch 1947)
  double z = 0;
};
// Of two samples, two values each at least. An error below 1e-6 of the mean (the rounding of sums) counts as that.
Welch welch_test(const std::vector<double>& reference, const std::vector<double>& test);

double kolmogorov_p(std::vector<double> standard_normal_values);  // of their largest distance (Stephens 1970)

struct ZTestOptions {
  double enough = 0.15;
};

struct ZTest {
  std::uint32_t blocks_x = 0, blocks_y = 0;
  std::vector<double> z;   // one a block; NaN where it was pooled, or where nothing varies and both agree
  std::size_t tested = 0;  // that were tested alone
  std::size_t pooled = 0;  // with too little light
  double pooled_z = 0;     // NaN if there are none, or if even together they are too dim
  std::size_t worst = 0;   // block of the largest |z|; blocks_x * blocks_y if it is the pooled one
  double max_z = 0;        // that z, signed
  double chi_squared = 0;  // sum of z^2 over what was tested
  double p_block = 1, p_spread = 1, p_energy = 1, p_relative = 1;  // each alone; p_block is corrected
  double p_kolmogorov = 1;    // whether the z are standard normal: a check of the test, not of the estimator
  Interval energy, relative;  // bias over the reference's mean, 95%
  double mean_reference = 0;  // luminance
  double p = 1;               // the smallest of the four, times four
  // The relative bias of the whole picture's energy that a test at `alpha` would find nine times in ten.
  double detectable(double alpha) const;
  double energy_error = 0;                        // standard error of the bias, relative
  std::size_t holm_rejected(double alpha) const;  // blocks that Holm's step-down rejects
};
// Both sides need two runs at least and the same blocks.
ZTest z_test(const BlockRuns& reference, const BlockRuns& test, const ZTestOptions& options = {});

// A few lines for eyes, and a table of the blocks' z (a dot where a block was not tested alone).
std::string ztest_text(const ZTest& result);
std::string ztest_map(const ZTest& result);

}  // namespace fb::lab
