// Gains that can be computed by hand, and intervals that cover the true gain as often as they should.
#include "lab/bench/bench_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"

namespace fb::lab {
namespace {

FrameRecord record(double mse, double estimator_ms, double other_ms) {
  FrameRecord f;
  f.measured = true;
  f.errors.mse = mse + 0.5;
  f.errors.reference_variance = 0.5;  // taken off again
  f.errors.rel_mse = 2 * mse;
  f.estimator_ms = estimator_ms;
  f.gpu_ms = estimator_ms + other_ms;
  return f;
}
Frames constant(std::uint32_t spp, double mse, double estimator_ms) {
  Frames frames{8, 3, 9, spp, {}};
  for (int i = 0; i < 96; ++i) frames.records.push_back(record(mse, estimator_ms, 10));
  return frames;
}

TEST(BenchStatistics, GainsOfConstantFrames) {
  const Frames base = constant(1, 4, 10), own = constant(2, 1, 30);
  const WindowStatistics s = window_statistics(own, {true, 3}, &base);
  EXPECT_DOUBLE_EQ(s.mse.mean, 1);
  EXPECT_DOUBLE_EQ(s.mse.standard_error, 0);
  EXPECT_DOUBLE_EQ(s.mse.typical.value, 1);
  EXPECT_DOUBLE_EQ(s.rel_mse.mean, 2);
  EXPECT_DOUBLE_EQ(s.reference_variance, 0.5);
  EXPECT_DOUBLE_EQ(s.gpu_ms, 40);
  EXPECT_DOUBLE_EQ(s.estimator_ms, 30);
  ASSERT_TRUE(s.gains.has_value());
  const auto expect_exactly = [](const Estimate& e, double value) {
    EXPECT_NEAR(e.value, value, 1e-12);
    EXPECT_NEAR(e.interval.low, value, 1e-12);
    EXPECT_NEAR(e.interval.high, value, 1e-12);
  };
  expect_exactly(s.gains->samples, 4.0 / 2);
  expect_exactly(s.gains->time, 4 * 10 / 30.0);
  expect_exactly(s.gains->time_all, 4 * 20 / 40.0);
  expect_exactly(s.gains->time_paired, 4 * 10 / 30.0);
  expect_exactly(s.gains->typical_time, 4 * 10 / 30.0);
  EXPECT_FALSE(window_statistics(base, {true, 3}, nullptr).gains.has_value());
}

TEST(BenchStatistics, WindowsLookAtTheirFrames) {
  Frames frames = constant(1, 1, 10);
  for (std::uint32_t run = 0; run < 8; ++run)
    for (std::uint32_t i = 0; i < 3; ++i) frames.records[run * 12 + i] = record(100, 50, 10);  // cold
  EXPECT_DOUBLE_EQ(window_statistics(frames, {true, 3}, nullptr).mse.mean, 1);
  EXPECT_DOUBLE_EQ(window_statistics(frames, {false, 0}, nullptr).mse.mean, (3 * 100 + 6 * 1) / 9.0);
  EXPECT_DOUBLE_EQ(window_statistics(frames, {false, 0}, nullptr).mse_median, 1);
}

TEST(BenchStatistics, AnOutlierIsInTheMeanAndItsPixelsAreNamed) {
  Frames base = constant(1, 1, 10), own = constant(1, 1, 10);
  own.records[7] = record(1e7 - 0.5, 10, 10);
  own.records[7].errors.top_share = 1;
  const WindowStatistics s = window_statistics(own, {true, 3}, &base);
  EXPECT_NEAR(s.mse.mean, (71 + 1e7) / 72, 1);
  EXPECT_DOUBLE_EQ(s.mse_median, 1);
  EXPECT_DOUBLE_EQ(s.gains->typical_time.value, 1);
  EXPECT_NEAR(s.gains->time.value, std::pow((8 + 1e7 - 0.5) / 9, -1.0 / 8), 1e-9) << "of a typical run";
  EXPECT_TRUE(s.mse.heavy_tail);
  EXPECT_FALSE(window_statistics(base, {true, 3}, nullptr).mse.heavy_tail);
  EXPECT_NEAR(s.top_share, 1e7 / (71 * 1.5 + 1e7), 1e-12) << "of all squared error, the reference's included";
  EXPECT_GT(s.mse.standard_error, 1e5);
}

TEST(BenchStatistics, NothingButNoiseHasNoGain) {
  const Frames base = constant(1, 1, 10), own = constant(1, -0.1, 10);
  EXPECT_TRUE(std::isnan(window_statistics(own, {true, 3}, &base).gains->time.value));
}

TEST(BenchStatistics, ABusyMachineHardlyTouchesPairs) {
  // Own takes 1.5 times the baseline's time; everything takes twice as long in some frames, more of them on one side of
  // the median.
  Frames base = constant(1, 1, 10), own = constant(1, 1, 15);
  for (std::size_t i = 0; i < 96; i += 2) base.records[i] = record(1, 20, 20), own.records[i] = record(1, 30, 20);
  for (std::size_t i = 0; i < 2; ++i) own.records[2 * i + 5] = record(1, 30, 20);  // where the baseline was lucky
  const WindowStatistics s = window_statistics(own, {true, 3}, &base);
  EXPECT_NEAR(s.gains->time_paired.value, 1 / 1.5, 1e-12);
  EXPECT_GT(std::abs(s.gains->time.value - s.gains->time_paired.value), 1e-6);
}

TEST(BenchStatistics, IntervalsCoverTheTrueGain) {
  // Runs whose frames share a factor, as those of an estimator that learns do: an interval over frames would miss it.
  // The typical run's gain is 3. 1000 trials: three binomial standard errors are 2.1%.
  Rng rng(5);
  const auto normal = [&] {
    return std::sqrt(-2 * std::log(1.0 - rng.uniform())) * std::cos(2 * M_PI * rng.uniform());
  };
  int covers = 0;
  constexpr int kTrials = 1000;
  for (int trial = 0; trial < kTrials; ++trial) {
    Frames base{8, 0, 16, 1, {}}, own = base;
    for (std::uint32_t run = 0; run < base.runs; ++run) {
      const double shared = std::exp(0.3 * normal());
      for (int i = 0; i < 16; ++i) {
        base.records.push_back(record(3 * std::exp(0.4 * normal()), 1, 1));
        own.records.push_back(record(shared * std::exp(0.4 * normal()), 1, 1));
      }
    }
    const Estimate gain = window_statistics(own, {false, 0}, &base).gains->samples;
    covers += gain.interval.low <= 3 && 3 <= gain.interval.high;
  }
  EXPECT_NEAR(covers / double{kTrials}, 0.95, 0.021);
}

TEST(BenchStatistics, CurvesCumulateTimeFromTheirWindowOn) {
  Frames frames = constant(1, 1, 10);
  for (std::size_t i = 0; i < 96; ++i) {
    frames.records[i].running_mse = static_cast<double>(i % 12);
    frames.records[i].warm_running_mse = 100.0 + static_cast<double>(i % 12);
  }
  const Curve cold = running_curve(frames, {false, 0}), warm = running_curve(frames, {true, 3});
  ASSERT_EQ(cold.mse.size(), 12u);
  ASSERT_EQ(warm.mse.size(), 9u);
  EXPECT_DOUBLE_EQ(cold.mse[5], 5);
  EXPECT_DOUBLE_EQ(warm.mse[0], 103);
  EXPECT_DOUBLE_EQ(cold.gpu_ms[11], 12 * 20);
  EXPECT_DOUBLE_EQ(warm.estimator_ms[8], 9 * 10);
}

TEST(BenchStatistics, FramesOverRuns) {
  Frames frames = constant(1, 1, 10);
  frames.records[12 + 5] = record(9, 10, 10);  // frame 5 of the second run
  frames.records[0].measured = false;
  const auto list = frames_over_runs(frames);
  ASSERT_EQ(list.size(), 11u);
  EXPECT_EQ(list[0].index, 1u);
  EXPECT_DOUBLE_EQ(list[4].mse, 2);
  EXPECT_DOUBLE_EQ(list[4].mse_error, 1);
  EXPECT_DOUBLE_EQ(list[3].mse_error, 0);
}

}  // namespace
}  // namespace fb::lab
