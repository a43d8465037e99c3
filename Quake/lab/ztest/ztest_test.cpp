// The z-test itself: its distributions against closed forms, and what it finds. How often it cries wolf:
// ztest_statistics_test.cpp.
#include "lab/ztest/ztest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <algorithm>

#include "base/probability.h"
#include "base/rng.h"
#include "lab/ztest/test_ztest.h"

namespace fb::lab {
namespace {

using namespace made_up;

TEST(ZTestMaths, ZHasTheTailOfT) {
  for (const int runs : {6, 9, 17, 33}) {  // n runs against ones that never vary: n - 1 degrees of freedom
    for (const double t : {0.5, 1.0, 2.0, 4.0, 6.0}) {
      // Values of mean t * error: spread 1 about it.
      std::vector<double> values, still(static_cast<std::size_t>(runs), 1e-9);
      for (int i = 0; i < runs; ++i) values.push_back(i % 2 == 0 ? 1.0 : -1.0);
      const double center = mean(values), error = standard_error(values);
      for (double& v : values) v += t * error - center;
      const Welch w = welch_test(still, values);
      EXPECT_NEAR(w.degrees, runs - 1, 1e-6);
      const double exact = 2 * (1 - student_t_probability(t, runs - 1));
      EXPECT_NEAR(two_sided_p(w.z) / exact, 1.0, 0.1) << t << " of " << runs;
    }
  }
}

TEST(ZTestMaths, KolmogorovKnowsNormalValues) {
  std::vector<double> values;
  Rng rng(4);
  for (int i = 0; i < 200; ++i) {
    const double radius = std::sqrt(2 * exponential(rng)), angle = 2 * std::numbers::pi * rng.uniform();
    values.push_back(radius * std::cos(angle));  // Box and Muller
  }
  EXPECT_GT(kolmogorov_p(values), 0.01);
  for (double& v : values) v *= 1.5;
  EXPECT_LT(kolmogorov_p(values), 0.01) << "too wide";
  for (double& v : values) v = v / 1.5 + 0.4;
  EXPECT_LT(kolmogorov_p(values), 1e-4) << "off centre";
  // 1.36 / sqrt(n) is the 5% point of n large (Stephens 1970).
  std::vector<double> at_distance;
  for (int i = 0; i < 1000; ++i) {
    const double p = std::min(0.9999, (i + 0.5) / 1000.0 + 0.0425);
    double low = -8, high = 8;
    for (int k = 0; k < 60; ++k)
      (0.5 * std::erfc(-0.5 * (low + high) / std::numbers::sqrt2) < p ? low : high) = 0.5 * (low + high);
    at_distance.push_back(low);
  }
  EXPECT_NEAR(kolmogorov_p(at_distance), 0.05, 0.006);
}

TEST(ZTest, FindsTwoPercentEverywhere) {
  const Scene brighter = [](std::uint32_t x, std::uint32_t y) { return Light{8.0, 1.02 * room(x, y).mean}; };
  const Scene fair = [](std::uint32_t x, std::uint32_t y) { return Light{8.0, room(x, y).mean}; };
  Rng rng(21);
  int found = 0, predicted = 0;
  for (int i = 0; i < 20; ++i) {
    const ZTest r = compare(fair, brighter, rng, 48);
    found += r.p < 1e-3;
    predicted += r.detectable(1e-3) < 0.02;
    EXPECT_LT(r.energy.low, 0.02);
    EXPECT_GT(r.energy.high, 0.0);
  }
  EXPECT_GE(found, 15);
  EXPECT_GE(predicted, 15) << "and says that it can";
}

TEST(ZTest, FindsWhatIsWrongInOneBlock) {
  const Scene spot = [](std::uint32_t x, std::uint32_t y) {
    Light light = room(x, y);
    if (x / kBlock == 1 && y / kBlock == 2) light.mean *= 1.35;
    return light;
  };
  Rng rng(22);
  int found = 0;
  for (int i = 0; i < 20; ++i) {
    const ZTest r = compare(room, spot, rng);
    found += r.p < 1e-3 && r.worst == 2 * r.blocks_x + 1 && r.holm_rejected(1e-3) >= 1 && r.max_z > 0;
  }
  EXPECT_GE(found, 15);
}

TEST(ZTest, FindsABiasThatCancelsOverThePicture) {
  const Scene chequered = [](std::uint32_t x, std::uint32_t y) {
    Light light{2.0, 1.0};
    light.mean += (x / kBlock + y / kBlock) % 2 == 0 ? 0.06 : -0.06;
    return light;
  };
  const Scene plain = [](std::uint32_t, std::uint32_t) { return Light{2.0, 1.0}; };
  Rng rng(23);
  int found = 0, by_spread = 0;
  for (int i = 0; i < 20; ++i) {
    const ZTest r = compare(plain, chequered, rng);
    found += r.p < 1e-3;
    by_spread += r.p_spread < 0.25e-3;
  }
  EXPECT_GE(found, 15);
  EXPECT_GE(by_spread, 15);
}

TEST(ZTest, HearsDimBlocksBesideABrightOne) {
  const auto lamp = [](double factor) {
    return [factor](std::uint32_t x, std::uint32_t y) {
      return x / kBlock == 0 && y / kBlock == 0 ? Light{50.0, 1000.0} : Light{2.0, 0.1 * factor};
    };
  };
  Rng rng(24);
  const ZTest r = compare(lamp(1.0), lamp(0.97), rng, 48);
  EXPECT_GT(r.p_energy, 1e-3) << "it drowns in the lamp";
  EXPECT_LT(r.p_relative, 1e-4);
  EXPECT_LT(r.relative.high, 0.0);
}

TEST(ZTest, PoolsWhatIsTooDimAndLeavesOutWhatIsBlack) {
  const auto scene = [](double factor) {
    return [factor](std::uint32_t x, std::uint32_t) {
      if (x < 16) return Light{1.0, 0.0};
      return x < 32 ? Light{2.0, 1.0} : Light{0.02, 0.05 * factor};
    };
  };
  Rng rng(25);
  const ZTest fair = compare(scene(1), scene(1), rng);
  EXPECT_EQ(fair.pooled, 10u);
  EXPECT_EQ(fair.tested, 10u);
  EXPECT_TRUE(std::isnan(fair.z[0]));
  EXPECT_GT(fair.p, 0.01);
  const ZTest dim = compare(scene(1), scene(2), rng);
  EXPECT_LT(dim.p, 1e-3);
  EXPECT_EQ(dim.worst, dim.z.size());
}

TEST(ZTest, CountsWhatIsNotFinite) {
  BlockRuns runs(9, 4, 8);
  Picture picture{9, 4, std::vector<vec3>(36, vec3(1.0f))};
  picture.pixels[35] = vec3(std::numeric_limits<float>::infinity(), 0, 0);
  picture.pixels[0].y = std::numeric_limits<float>::quiet_NaN();
  runs.add(picture);
  EXPECT_EQ(runs.not_finite(), 2u);
  EXPECT_EQ(runs.blocks(), 2u);
  EXPECT_EQ(runs.pixels(0), 32.0);
  EXPECT_EQ(runs.pixels(1), 4.0);
  EXPECT_NEAR(runs.value(0, 0), 31.0 / 32, 1e-6);
  EXPECT_NEAR(runs.value(0, 1), 3.0 / 4, 1e-6);
}

TEST(ZTest, WhatNeverVariesMustBeEqual) {
  BlockRuns a(16, 8, 8), b(16, 8, 8), c(16, 8, 8);
  Picture picture{16, 8, std::vector<vec3>(128, vec3(1.75f))}, other = picture;
  for (vec3& p : other.pixels) p *= 1.0001f;
  for (int run = 0; run < 4; ++run) a.add(picture), b.add(picture), c.add(other);
  EXPECT_EQ(z_test(a, b).p, 1.0);
  EXPECT_LT(z_test(a, c).p, 1e-6);
}

}  // namespace
}  // namespace fb::lab
