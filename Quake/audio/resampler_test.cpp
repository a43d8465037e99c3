// Rates of sounds: tones keep their pitch and loudness, what a rate cannot hold does not come back as another tone, and
// loops have no seam.
#include "audio/resampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "audio/test_sounds.h"

namespace fb::audio {
namespace {

constexpr std::size_t kNoLoop = static_cast<std::size_t>(-1);

double decibels(double ratio) { return 20.0 * std::log10(ratio); }

// The loudest difference of a resampled tone from the tone itself, away from the ends, of full scale.
double tone_error(double frequency, std::uint32_t from, std::uint32_t to, int quality) {
  const std::vector<float> in = test::sine(frequency, from, from / 4);
  const std::vector<float> out = resample(in, from, to, quality, kNoLoop, false);
  const std::vector<float> ideal = test::sine(frequency, to, out.size());
  double error = 0.0;
  for (std::size_t i = out.size() / 4; i < out.size() * 3 / 4; ++i)
    error = std::max(error, std::abs(static_cast<double>(out[i]) - ideal[i]));
  return error;
}

class Rates : public ::testing::TestWithParam<std::tuple<std::uint32_t, std::uint32_t, int>> {};

TEST_P(Rates, TonesInTheBandAreKept) {
  const auto [from, to, quality] = GetParam();
  const double nyquist = std::min(from, to) / 2.0;
  for (const double part : {0.02, 0.2, 0.6}) EXPECT_LT(tone_error(part * nyquist, from, to, quality), 2e-3) << part;
}
// 8363 and 44100 have no common measure: phases are rounded.
INSTANTIATE_TEST_SUITE_P(All, Rates,
                         ::testing::Combine(::testing::Values(8363u, 11025u, 22050u, 44100u, 48000u),
                                            ::testing::Values(11025u, 44100u, 48000u), ::testing::Values(1, 5)));

TEST(Resample, WhatLiesBeyondTheLowerRateIsGone) {
  // 18 kHz cannot be held at 11025 Hz, and must not come back as 4050 Hz.
  const std::vector<float> high = resample(test::sine(18000, 44100, 44100), 44100, 11025, 1, kNoLoop, false);
  EXPECT_LT(decibels(test::rms(high, 2000, 9000) / std::sqrt(0.5)), -60.0);
  // A tone of 4 kHz at 11025 Hz has an image at 7025 Hz, which samples that are held let through.
  const std::vector<float> in = test::sine(4000, 11025, 11025);
  const auto image = [&](const std::vector<float>& out) {
    double s = 0.0, c = 0.0;
    for (std::size_t i = 8000; i < 36000; ++i) {
      const double phase = 2.0 * std::numbers::pi * 7025.0 * static_cast<double>(i) / 44100.0;
      s += out[i] * std::sin(phase);
      c += out[i] * std::cos(phase);
    }
    return decibels(2.0 * std::hypot(s, c) / 28000.0);
  };
  EXPECT_LT(image(resample(in, 11025, 44100, 1, kNoLoop, false)), -60.0);
  EXPECT_GT(image(resample(in, 11025, 44100, 1, kNoLoop, true)), -15.0);
}

// The band that passes at half the power is the one that QuakeSpasm's kernels have: 0.9 of it with quality 1, 0.96 with
// quality 5.
TEST(Resample, QualityWidensTheBand) {
  const auto passed = [](double part, int quality) {
    const auto out = resample(test::sine(part * 5512.5, 11025, 11025), 11025, 44100, quality, kNoLoop, false);
    return decibels(test::rms(out, 8000, 36000) / std::sqrt(0.5));
  };
  EXPECT_NEAR(passed(0.900, 1), -6.0, 0.5);
  EXPECT_NEAR(passed(0.960, 5), -6.0, 0.5);
  EXPECT_LT(passed(0.960, 1), -15.0);
  EXPECT_GT(passed(0.900, 5), -0.5);
}

TEST(Resample, LengthsAndLevels) {
  EXPECT_EQ(resample(std::vector<float>(1000, 1.0f), 11025, 44100, 1, kNoLoop, false).size(), 4000u);
  EXPECT_EQ(resample(std::vector<float>(1000, 1.0f), 44100, 11025, 1, kNoLoop, false).size(), 250u);
  EXPECT_EQ(resample(std::vector<float>(1, 1.0f), 44100, 11025, 1, kNoLoop, false).size(), 1u);
  const auto level = resample(std::vector<float>(1000, 1.0f), 11025, 44100, 1, kNoLoop, false);
  for (std::size_t i = 200; i < 3800; ++i) ASSERT_NEAR(level[i], 1.0f, 1e-5f);
}

TEST(Resample, SameRateChangesNothing) {
  const std::vector<float> in = test::sine(440, 44100, 100);
  EXPECT_EQ(resample(in, 44100, 44100, 1, kNoLoop, false), in);
}

TEST(Resample, HeldSamplesStandUntilTheNext) {
  const std::vector<float> in = {0.0f, 1.0f, -1.0f};
  const std::vector<float> expected = {0, 0, 0, 0, 1, 1, 1, 1, -1, -1, -1, -1};
  EXPECT_EQ(resample(in, 11025, 44100, 1, kNoLoop, true), expected);
}

// Ten periods that loop: the end goes on into the beginning as if there were no end.
TEST(Resample, LoopsHaveNoSeam) {
  const std::vector<float> in = test::sine(110.25, 11025, 1000);
  const std::vector<float> out = resample(in, 11025, 44100, 1, 0, false);
  const std::vector<float> ideal = test::sine(110.25, 44100, out.size());
  for (std::size_t i = 0; i < out.size(); ++i) ASSERT_NEAR(out[i], ideal[i], 1e-3) << i;
  const std::vector<float> cut = resample(in, 11025, 44100, 1, kNoLoop, false);
  double error = 0.0;
  for (std::size_t i = cut.size() - 40; i < cut.size(); ++i)
    error = std::max(error, std::abs(static_cast<double>(cut[i]) - ideal[i]));
  EXPECT_GT(error, 5e-3) << "without a loop there is silence behind the end";
}

TEST(Resample, LoopsThatBeginLater) {
  std::vector<float> in(500, 0.25f);
  const std::vector<float> periods = test::sine(110.25, 11025, 500);
  in.insert(in.end(), periods.begin(), periods.end());
  const std::vector<float> out = resample(in, 11025, 44100, 1, 500, false);
  const std::vector<float> ideal = test::sine(110.25, 44100, 2000);
  for (std::size_t i = 1900; i < 2000; ++i) ASSERT_NEAR(out[2000 + i], ideal[i], 1e-3) << i;
}

}  // namespace
}  // namespace fb::audio
