// Errors of a picture against a reference, in linear radiance, over pixels and channels.
//
// What is measured is m = mean((x - r)^2), where r is the reference's estimate of the truth. With v the variance of x's
// pixels, b their bias and v_r the variance of the reference's pixels (all averaged over pixels and channels),
// E[m] = v + b^2 + v_r: the corrected figures take v_r off where the reference says what it is. Nothing is clamped.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/picture.h"

namespace fb::lab {

struct MetricOptions {
  double epsilon = 0.01;  // in the denominators of relMSE, MAPE and SMAPE, radiance squared and radiance
  double peak = 0;        // of PSNR; 0: the reference's largest channel
};

// The share of brightest errors that `top_share` looks at.
constexpr double kTopPixels = 0.001;

struct Errors {
  double mse = 0;         // mean (x - r)^2
  double rel_mse = 0;     // mean (x - r)^2 / (r^2 + epsilon)
  double mape = 0;        // mean |x - r| / (|r| + epsilon)
  double smape = 0;       // mean |x - r| / (|x| + |r| + epsilon), 0 to 1
  double peak = 0;        // what PSNR takes for the largest value
  double bias = 0;        // mean (x - r), signed
  double median_mse = 0;  // over pixels, each the mean of its channels
  double top_share = 0;  // of the squared error, what the 0.1% of pixels (at least one) with most of it hold: fireflies
  double reference_variance = 0;      // v_r, to be taken off mse; 0 if unknown
  double reference_rel_variance = 0;  // its share of rel_mse: mean v_r / (r^2 + epsilon)
  double reference_bias_error = 0;    // standard error that the reference alone gives to `bias`
  std::uint64_t not_finite = 0;       // pixels of x with a channel that is not finite; these count as zero
  double rmse() const;
  double psnr() const;  // decibels: 10 log10(peak^2 / mse); infinite for equal pictures
  double mse_corrected() const { return mse - reference_variance; }  // below zero where the noise is the reference's
  double rel_mse_corrected() const { return rel_mse - reference_rel_variance; }
};
// Both of one size.
Errors measure(const Reference& reference, const Picture& test, const MetricOptions& options = {});

// What figures of whole pictures look at: the values as measured, and as a screen shows them (sRGB values, 0 to 1).
struct PicturePair {
  const Picture &reference, &test;
  const Picture &shown_reference, &shown_test;
};

// A figure of an error as `compare` and the frames of `bench` print it: a row is a metric. It is computed from the
// errors of pixels or, where that is null, from the pictures (by `compare` alone).
struct Metric {
  enum class When {
    kAlways,
    kLinear,          // pictures of linear radiance
    kStored,          // pictures as they are stored: 8 bits, sRGB
    kKnownVariance,   // the reference knows its own variance
    kLinearVariance,  // both
  };
  const char* name;
  double (*value)(const Errors& errors);
  When when = When::kAlways;
  bool of_frames = true;  // a column of bench's frames
  double (*of_pictures)(const PicturePair& pair) = nullptr;
  // Errors multiply: over runs their logarithms are averaged (lab/statistics.h).
  bool multiplies = false;
  // Whether it means something for such pictures.
  bool holds(bool linear, bool variance_known) const;
};
const std::vector<Metric>& metrics();

// Several runs of the same thing: where their error comes from.
class Runs {
 public:
  void add(const Picture& picture);  // all of one size; what is not finite counts as zero
  std::uint32_t count() const { return count_; }
  const Picture& mean() const { return mean_; }
  // Sample variance of one run's pixels, averaged over pixels and channels; 0 for fewer than two runs.
  double variance() const;
  // mean((mean of runs - r)^2) less what the runs' variance and the reference's make of it: the bias squared, averaged
  // over pixels. Unbiased itself, so it scatters about zero where there is none.
  double bias_squared(const Reference& reference) const;

 private:
  std::uint32_t count_ = 0;
  Picture mean_;
  std::vector<vec3> m2_;  // Welford 1962
};

}  // namespace fb::lab
