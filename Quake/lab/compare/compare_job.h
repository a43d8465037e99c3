// fullbright-lab compare: pictures held to a reference; several are runs of the same thing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "lab/compare/flip.h"
#include "lab/compare/metrics.h"
#include "lab/compare/spectrum.h"
#include "lab/statistics.h"

namespace fb::lab {

struct CompareJob {
  std::string reference;           // .exr or .png
  std::vector<std::string> tests;  // of the same kind and size
  MetricOptions metrics;
  bool flip = true;
  double pixels_per_degree = flip::kPixelsPerDegree;
  double exposure = 0;  // stops at which LDR-FLIP looks at linear pictures, cut at 1
  // The frame before: its reference, with the reference's motion (`picture` keeps such), and its TEST; EXR, one test.
  std::string former_reference, former_test;  // empty: no flicker
  std::string flip_map;  // PNG of FLIP per pixel (HDR-FLIP of linear pictures); one test only; empty: none
};

// One figure of a picture and what it is called, in columns and in JSON.
struct Figure {
  std::string name;
  double value = 0;
  bool multiplies = false;  // Metric::multiplies
};
struct ComparedFile {
  std::string file;
  std::vector<Figure> figures;  // the same names in the same order in all files
  std::uint64_t not_finite = 0;
  Spectrum spectrum;  // of the error
};
struct Spread {
  std::string name;
  double mean = 0;
  Estimate typical;  // over files: of what multiplies the geometric mean, else the mean
};
struct Comparison {
  CompareJob job;
  bool linear = true;  // EXR; otherwise figures are of sRGB values as stored, 0 to 1
  std::uint32_t width = 0, height = 0;
  double reference_mean = 0;  // over pixels and channels
  double peak = 0;            // PSNR's
  std::optional<double> reference_variance;
  double reference_bias_error = 0;  // standard error that the reference gives to every file's bias
  std::optional<flip::Exposures> exposures;
  std::vector<ComparedFile> files;
  std::vector<Spread> spreads;  // of several files
  // Of several linear files: the runs' variance and squared bias, whose sum is the corrected MSE's mean.
  std::optional<double> variance, bias_squared;
  std::optional<double> tail;  // tail_shape of the pixels' squared errors, of several files
};
// Fails with the file and the cause: unreadable, another size, PNG held to EXR.
Result<Comparison> compare(const CompareJob& job);

std::string comparison_table(const Comparison& c);
std::string comparison_json(const Comparison& c);
std::string comparison_csv(const Comparison& c);

}  // namespace fb::lab
