// bench over many frames of a box: its error is the variance, and falls with samples and frames.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "lab/bench/bench_report.h"
#include "lab/bench/test_bench.h"

namespace fb::lab {
namespace {

using BenchJobStatistics = BenchTest;

TEST_F(BenchJobStatistics, ErrorIsVarianceAndFallsWithSamplesAndFrames) {
  const View view = view_of("cbox", {0, 11, 4});
  ASSERT_TRUE(view.still);
  const auto references = references_of(view, 8192);
  const BenchResult result = run(view, references, {configuration("one", 1), configuration("four", 4)}, 8);
  ASSERT_EQ(result.configurations.size(), 2u);
  const auto &one = result.configurations[0], &four = result.configurations[1];
  ASSERT_EQ(one.windows.size(), 2u) << "cold and warm";
  ASSERT_EQ(one.frames.records.size(), 8u * 16);
  EXPECT_EQ(one.not_finite, 0u);

  // pt is unbiased: all of the error is variance, and the two are measured apart.
  const WindowStatistics& warm = one.windows[1];
  EXPECT_NEAR(warm.mse.mean, one.variance, 4 * warm.mse.standard_error);
  // What is left of it in the mean of 96 frames: 2304 values with heavy tails, known to well under 30%.
  EXPECT_LT(std::abs(one.bias_squared), 0.3 * (one.variance / 96 + warm.reference_variance));
  EXPECT_LT(std::abs(warm.bias), 5 * warm.bias_error);

  // Equal samples: no gain by definition. Its own interval, twice as wide, holds 1.
  const Estimate gain = four.windows[1].gains->samples;
  EXPECT_NEAR(gain.value, 1, gain.interval.high - gain.interval.low);
  EXPECT_NEAR(one.windows[1].mse.mean / four.windows[1].mse.mean, 4, 4 * (gain.interval.high - gain.interval.low));

  // The mean of 16 frames has a 16th of a frame's error.
  const Curve curve = running_curve(one.frames, one.windows[0].window);
  ASSERT_EQ(curve.mse.size(), 16u);
  EXPECT_NEAR(curve.mse.back() * 16 / warm.mse.mean, 1, 0.3);
  double first = 0;
  for (std::uint32_t r = 0; r < 8; ++r) first += one.frames.at(r, 0).errors.mse_corrected() / 8;
  EXPECT_NEAR(curve.mse.front(), first, 1e-12 * first);
  EXPECT_NE(one.frames.at(0, 0).errors.mse, one.frames.at(1, 0).errors.mse) << "runs have seeds of their own";

  const BenchTitle title{"command", "scene cbox", "pt"};
  EXPECT_THAT(bench_table(result, title), testing::HasSubstr("gain of four over one"));
  EXPECT_THAT(bench_json(result, title), testing::HasSubstr("\"gpu_ms_median\""));
  const std::string csv = bench_csv(result);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 8 * 16);
}

}  // namespace
}  // namespace fb::lab
