// How often the z-test cries wolf.
#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"
#include "lab/ztest/test_ztest.h"

namespace fb::lab {
namespace {

using namespace made_up;

struct Alarms {
  int any = 0, block = 0, spread = 0, energy = 0, relative = 0, normal = 0;
};
Alarms count_alarms(const Scene& reference, const Scene& test, double alpha, int repetitions, std::uint64_t seed) {
  Alarms alarms;
  Rng rng(seed);
  for (int i = 0; i < repetitions; ++i) {
    const ZTest r = compare(reference, test, rng);
    alarms.any += r.p < alpha;
    alarms.block += r.p_block < alpha;
    alarms.spread += r.p_spread < alpha;
    alarms.energy += r.p_energy < alpha;
    alarms.relative += r.p_relative < alpha;
    alarms.normal += r.p_kolmogorov < alpha;
  }
  return alarms;
}

// The most that a binomial count exceeds once in 10,000 times, by the normal approximation and a half.
double most(int repetitions, double p) { return p * repetitions + 3.72 * std::sqrt(p * (1 - p) * repetitions) + 0.5; }

TEST(ZTestStatistics, SeldomCriesWolf) {
  const Scene guided = [](std::uint32_t x, std::uint32_t y) {  // the same mean, found three times as often
    return Light{3 * room(x, y).hits, room(x, y).mean};
  };
  const Scene outliers = [](std::uint32_t x, std::uint32_t y) {  // the same mean, from fewer and larger samples
    return Light{0.4 * room(x, y).hits, room(x, y).mean};
  };
  int pair = 0;
  for (const Scene& test : {Scene(room), guided, outliers}) {
    const int n = 200;
    const Alarms a = count_alarms(room, test, 0.05, n, 10 + static_cast<std::uint64_t>(pair));
    for (const int alarms : {a.any, a.block, a.spread, a.energy, a.relative, a.normal})
      EXPECT_LE(alarms, most(n, 0.05)) << pair;
    for (const int alarms : {a.block, a.spread, a.energy, a.relative})
      EXPECT_GE(alarms, 2) << "it never speaks " << pair;
    ++pair;
  }
  const Alarms rare = count_alarms(room, guided, 1e-3, 300, 5);
  EXPECT_LE(rare.any, most(300, 1e-3));
}

TEST(ZTestStatistics, IntervalsOfTheEnergyHoldTheBiasAsOftenAsTheySay) {
  const Scene brighter = [](std::uint32_t x, std::uint32_t y) {
    return Light{room(x, y).hits, 1.03 * room(x, y).mean};
  };
  Rng rng(17);
  constexpr int kTrials = 300;
  int energy = 0, block = 0;
  for (int i = 0; i < kTrials; ++i) {
    const ZTest r = compare(room, brighter, rng);
    energy += r.energy.low <= 0.03 && 0.03 <= r.energy.high;
    block += r.relative.low <= 0.03 && 0.03 <= r.relative.high;
  }
  for (const int held : {energy, block}) EXPECT_NEAR(held, 0.95 * kTrials, 14) << "3.7 binomial standard errors";
}

TEST(ZTestStatistics, IsNotLedAstrayByWhichBlocksHoldEnough) {
  // Every block's error is about what is enough: to choose those whose error came out small would blow up their z.
  const Scene dim = [](std::uint32_t, std::uint32_t) { return Light{0.17, 1.0}; };
  const int n = 400;
  const Alarms a = count_alarms(dim, dim, 0.02, n, 7);
  for (const int alarms : {a.any, a.block, a.spread, a.energy, a.relative}) EXPECT_LE(alarms, most(n, 0.02));
}

}  // namespace
}  // namespace fb::lab
