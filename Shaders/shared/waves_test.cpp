// shared/waves.h against the same sum in long double, without any reduction of phases.
#include "shared/waves.h"

#include <algorithm>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/rng.h"
#include "shared/test_vmf_errors.h"

namespace fb::shared {
namespace {

using reference::Real;

struct Octave {
  int x, y, n;
  Real offset, amplitude;
};
constexpr std::array<Octave, 6> kOctaves{{{60, 22, 4093, 0.13L, 0.44678L},
                                          {-95, 39, 5189, 0.71L, 0.25286L},
                                          {69, -148, 6543, 0.37L, 0.14493L},
                                          {79, 250, 8290, 0.92L, 0.08211L},
                                          {-363, -210, 10485, 0.55L, 0.04673L},
                                          {655, -145, 13261, 0.28L, 0.02659L}}};

struct ExactWave {
  Real height = 0, slope_x = 0, slope_y = 0, rate = 0;
};
ExactWave exact_wave(float height, float length, Real x, Real y, Real seconds) {
  const Real frequency = std::sqrt(kWaveGravity / (2 * reference::kPi * length));
  ExactWave sum;
  for (const Octave& o : kOctaves) {
    const Real turn = 2 * reference::kPi, cycles = (o.x * x + o.y * y) / (64 * static_cast<Real>(length)) -
                                                   o.n * frequency * seconds / 4096 + o.offset;
    const Real a = o.amplitude * height, slope = a * std::cos(turn * cycles) * turn;
    sum.height += a * std::sin(turn * cycles);
    sum.slope_x += slope * o.x / (64 * static_cast<Real>(length));
    sum.slope_y += slope * o.y / (64 * static_cast<Real>(length));
    sum.rate -= slope * o.n * frequency / 4096;
  }
  return sum;
}
WaveState wave_at(float height, float length, float x, float y, double seconds) {
  return wave_state({height, length, wave_clock(seconds, length)}, {x, y});
}

// At any place and time: as if the point was half a spacing of its coordinates off, the time a tick of the clock, and
// the phase 2^-22 cycles.
TEST(Waves, ArePreciseFarAwayAndLateInTheGame) {
  Rng rng(51);
  for (const float length : {16.0f, 64.0f, 100.3f}) {
    for (const float range : {1.0f, 1000.0f, 30000.0f}) {
      for (const double seconds : {0.0, 1.7, 3600.5, 1e5, 1e7}) {
        for (int i = 0; i < 500; ++i) {
          const float x = rng.uniform(-range, range), y = rng.uniform(-range, range);
          const double time = seconds * (1 + rng.uniform() * 0.1);
          const WaveState got = wave_at(3, length, x, y, time);
          const ExactWave exact = exact_wave(3, length, x, y, time);
          const double off = std::max(std::abs(x), std::abs(y)) * kRoundoff * 1.5;  // units
          const double frequency = wave_frequency(length), tick = 4096 / frequency * 0x1p-32;
          // The shortest wave has 10.5 times the wave number and 3.3 times the frequency of the longest.
          const double slope = 3 * kWaveMaxSlope / length, rate = 3 * 2 * 3.1416 * 1.4 * frequency;
          const double cycles = 10.5 / length * off + 3.3 * frequency * tick + 0x1p-22, turn = 2 * 3.1416 * cycles;
          ASSERT_NEAR(got.height, static_cast<double>(exact.height), slope * off + rate * tick + 3 * 6.2832 * 0x1p-22);
          ASSERT_NEAR(got.slope.x, static_cast<double>(exact.slope_x), slope * turn);
          ASSERT_NEAR(got.slope.y, static_cast<double>(exact.slope_y), slope * turn);
          ASSERT_NEAR(got.rate, static_cast<double>(exact.rate), rate * turn);
        }
      }
    }
  }
}

TEST(Waves, DerivativesAreThoseOfTheHeight) {
  Rng rng(52);
  for (int i = 0; i < 2000; ++i) {
    const Real x = rng.uniform(-3e4f, 3e4f), y = rng.uniform(-3e4f, 3e4f), time = rng.uniform(0, 1e5f), step = 1e-4L;
    const auto height = [&](Real dx, Real dy, Real dt) { return exact_wave(2, 64, x + dx, y + dy, time + dt).height; };
    const WaveState got = wave_at(2, 64, static_cast<float>(x), static_cast<float>(y), static_cast<double>(time));
    const auto difference = [&](Real dx, Real dy, Real dt) {
      return static_cast<double>((height(dx, dy, dt) - height(-dx, -dy, -dt)) / (2 * step));
    };
    ASSERT_NEAR(got.slope.x, difference(step, 0, 0), 2e-3);
    ASSERT_NEAR(got.slope.y, difference(0, step, 0), 2e-3);
    ASSERT_NEAR(got.rate, difference(0, 0, step), 2e-2);
    const vec3 n = wave_normal(got);
    ASSERT_NEAR(static_cast<double>(reference::length(n)), 1, 9 * kRoundoff);
    ASSERT_NEAR(n.x / n.z, -got.slope.x, 1e-6);
  }
}

// Over one tile, at one time, each wave passes whole cycles.
TEST(Waves, MeanIsZeroAndHeightAndSlopeAreBounded) {
  constexpr int kSide = 2048;
  double sum = 0, highest = 0, steepest = 0;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const WaveState s = wave_at(1, 1, static_cast<float>(i) / 32, static_cast<float>(j) / 32, 12.3);
      sum += s.height;
      highest = std::max(highest, static_cast<double>(std::abs(s.height)));
      steepest = std::max(steepest, static_cast<double>(length(s.slope)));
    }
  }
  EXPECT_NEAR(sum / (kSide * kSide), 0, 1e-6);
  EXPECT_LE(highest, 1);
  EXPECT_GT(highest, 0.8);
  EXPECT_LE(steepest, kWaveMaxSlope);
  EXPECT_GT(steepest, 0.6 * kWaveMaxSlope);
}

TEST(Waves, MoveSmoothlyAlsoWhereTheClockAndTheTileWrap) {
  const float size = 64;
  const double wrap = 4096 / static_cast<double>(wave_frequency(size));
  const double step = 1.0 / 1024;
  for (const double start : {0.0, wrap - 0.5, 1e5}) {
    for (int i = 0; i < 1024; ++i) {
      const double time = start + i * step;
      const WaveState a = wave_at(4, size, 100, -7, time), b = wave_at(4, size, 100, -7, time + step);
      ASSERT_NEAR(b.height - a.height, (a.rate + b.rate) / 2 * step, 2e-5) << time;
    }
  }
  for (int i = 0; i < 4096; ++i) {
    const float x = static_cast<float>(i) / 16 - 128, next = x + 1.0f / 16;
    const WaveState a = wave_at(4, size, x, x, 3), b = wave_at(4, size, next, next, 3);
    ASSERT_NEAR(b.height - a.height, (a.slope.x + a.slope.y + b.slope.x + b.slope.y) / 32, 2e-4) << x;
  }
  EXPECT_NEAR(wave_at(4, size, 5, 9, 1.25).height, wave_at(4, size, 5 + 64 * size, 9 - 64 * size, 1.25).height, 1e-5);
  EXPECT_EQ(wave_clock(-1e-30, size), 0u);
}

// The frequencies are those of deep water to a part in 10,000, and the amplitudes sum to 1.
TEST(Waves, FollowDeepWater) {
  Real sum = 0, slope = 0;
  for (const Octave& o : kOctaves) {
    const Real k = std::hypot(static_cast<Real>(o.x), static_cast<Real>(o.y)) / 64;
    EXPECT_NEAR(static_cast<double>(o.n / (4096 * std::sqrt(k))), 1, 1e-4);
    sum += o.amplitude;
    slope += o.amplitude * 2 * reference::kPi * k;
  }
  EXPECT_NEAR(static_cast<double>(sum), 1, 1e-12);
  EXPECT_NEAR(static_cast<double>(slope), kWaveMaxSlope, 1e-3);
  EXPECT_LE(static_cast<double>(slope), kWaveMaxSlope);
}

}  // namespace
}  // namespace fb::shared
