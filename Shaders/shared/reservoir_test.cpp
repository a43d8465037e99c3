// shared/reservoir.h: what a reservoir is expected to give, summed over all that chance can do on small domains. Random
// numbers are integrated, too: the share of u that selects a sample is found by bisection of the function itself.
#include "shared/reservoir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/rng.h"

namespace fb::shared {
namespace {

// Of float32 arithmetic: W has some ten roundings of 6e-8, and a chance is known to 3e-8. Expected values are about 1.
constexpr double kTolerance = 1e-6;
constexpr float kLastBelowOne = 0x1.fffffep-1f;

// The probability with which a uniform u in [0, 1) selects.
template <typename Selects>
double chance(const Selects& selects) {
  if (!selects(0.0f)) return 0;
  if (selects(kLastBelowOne)) return 1;
  double low = 0, high = 1;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (selects(static_cast<float>(middle)) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

constexpr int kPoints = 4, kNone = -1;
using PerPoint = std::array<float, kPoints>;

// Where one reservoir is made: points x, each a piece of the domain of some measure; candidates fall into them with
// `chances`. Points that domains share are moved between them by a shift whose Jacobian is that of their measures.
struct Domain {
  PerPoint chances, target, measure;
  int candidates;
  float confidence;
};

struct State {
  double probability;
  int sample;
  Reservoir reservoir;
};

// Both outcomes of one update that `apply` makes with its u.
template <typename Apply>
std::vector<State> branches(const State& before, int sample, const Apply& apply) {
  const double p = chance([&](float u) {
    Reservoir r = before.reservoir;
    return apply(r, u);
  });
  std::vector<State> after;
  for (const bool selected : {true, false}) {
    State s = before;
    s.probability *= selected ? p : 1 - p;
    if (s.probability == 0) continue;
    apply(s.reservoir, selected ? 0.0f : kLastBelowOne);
    if (selected) s.sample = sample;
    after.push_back(s);
  }
  return after;
}

// Each state is replaced by all that `next` makes of it.
template <typename Next>
std::vector<State> all_of(const std::vector<State>& states, const Next& next) {
  std::vector<State> all;
  for (const State& s : states)
    for (const State& n : next(s)) all.push_back(n);
  return all;
}

// A domain's reservoir by streaming RIS.
std::vector<State> initial(const Domain& d) {
  std::vector<State> states{{1, kNone, empty_reservoir()}};
  for (int i = 0; i < d.candidates; ++i) {
    states = all_of(states, [&](const State& before) {
      std::vector<State> next;
      for (int x = 0; x < kPoints; ++x) {
        if (d.chances[x] == 0) continue;
        const float pdf = d.chances[x] / d.measure[x];
        State drawn = before;
        drawn.probability *= static_cast<double>(d.chances[x]);
        const auto update = [&](Reservoir& r, float u) {
          return update_reservoir(r, d.target[x] / pdf, d.target[x], 1, u);
        };
        for (const State& s : branches(drawn, x, update)) next.push_back(s);
      }
      return next;
    });
  }
  for (State& s : states) {
    finish_reservoir(s.reservoir, 1 / static_cast<float>(d.candidates));
    s.reservoir.confidence = d.confidence;
  }
  return states;
}

enum class Mis { kConfidence, kCounted, kBalance, kPairwise, kPairwiseDefensive, kPairwiseThird };
constexpr Mis kWithoutBias[] = {Mis::kCounted, Mis::kBalance, Mis::kPairwise, Mis::kPairwiseDefensive,
                                Mis::kPairwiseThird};

// p-hat_<-j of x in domain `here`.
float target_from(const Domain& j, const Domain& here, int x) { return j.target[x] * j.measure[x] / here.measure[x]; }

float sum_of_confidences(const std::vector<Domain>& domains) {
  float sum = 0;
  for (const Domain& d : domains) sum += d.confidence;
  return sum;
}

PairwiseMis pairs(Mis mis, const std::vector<Domain>& domains) {
  const float canonical = domains[0].confidence, others = sum_of_confidences(domains) - canonical;
  const float defensive = mis == Mis::kPairwise            ? 0.0f
                          : mis == Mis::kPairwiseDefensive ? defensive_share(canonical, others)
                                                           : 1.0f / 3;
  return pairwise_mis(canonical, others, defensive);
}

// The MIS weight of reservoir i's sample x; the first is the canonical one.
float mis_weight(Mis mis, const std::vector<Domain>& domains, std::size_t i, int x) {
  const Domain& here = domains[0];
  switch (mis) {
    case Mis::kConfidence:
      return mis_by_confidence(domains[i].confidence, sum_of_confidences(domains));
    case Mis::kCounted:
      return domains[i].confidence;
    case Mis::kBalance: {
      float scores = 0;
      for (const Domain& d : domains) scores += mis_score(d.confidence, target_from(d, here, x));
      return mis_balance(mis_score(domains[i].confidence, target_from(domains[i], here, x)), scores);
    }
    default:
      break;
  }
  const PairwiseMis p = pairs(mis, domains);
  if (i > 0) return mis_pairwise(p, domains[i].confidence, target_from(domains[i], here, x), here.target[x]);
  float sum = p.defensive;
  for (std::size_t j = 1; j < domains.size(); ++j)
    sum += mis_pairwise_canonical(p, domains[j].confidence, target_from(domains[j], here, x), here.target[x]);
  return sum;
}

// The reservoirs of all domains, in this order, merged into one in the first domain.
std::vector<State> merged(Mis mis, const std::vector<Domain>& domains, const std::vector<std::vector<State>>& inputs,
                          const std::vector<std::size_t>& order) {
  std::vector<State> states{{1, kNone, empty_reservoir()}};
  for (const std::size_t i : order) {
    states = all_of(states, [&](const State& before) {
      std::vector<State> next;
      for (const State& in : inputs[i]) {
        State met = before;
        met.probability *= in.probability;
        const int x = in.sample;
        const float m = x == kNone ? 0 : mis_weight(mis, domains, i, x);
        const float jacobian = x == kNone ? 1 : domains[0].measure[x] / domains[i].measure[x];
        const float target = x == kNone ? 0 : domains[0].target[x];
        const auto merge = [&](Reservoir& r, float u) {
          return merge_reservoir(r, in.reservoir, m, target, jacobian, u);
        };
        for (const State& s : branches(met, x, merge)) next.push_back(s);
      }
      return next;
    });
  }
  for (State& s : states) {
    float share = 1;
    if (mis == Mis::kCounted && s.sample != kNone) {
      float counted = 0;
      for (const Domain& d : domains) counted += counted_confidence(d.confidence, target_from(d, domains[0], s.sample));
      share = counted_share(counted);
    }
    finish_reservoir(s.reservoir, share);
  }
  return states;
}

std::vector<State> merged(Mis mis, const std::vector<Domain>& domains) {
  std::vector<std::vector<State>> inputs;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < domains.size(); ++i) {
    inputs.push_back(initial(domains[i]));
    order.push_back(i);
  }
  return merged(mis, domains, inputs, order);
}

// Of W where the sample is x: the measure of x, if there is no bias.
std::array<double, kPoints> expected_weights(const std::vector<State>& states) {
  std::array<double, kPoints> sums{};
  double probability = 0;
  for (const State& s : states) {
    probability += s.probability;
    if (s.sample != kNone)
      sums[static_cast<std::size_t>(s.sample)] += s.probability * static_cast<double>(s.reservoir.contribution_weight);
  }
  EXPECT_NEAR(probability, 1, kTolerance);
  return sums;
}

void expect_unbiased(const std::vector<State>& states, const Domain& here, const char* what) {
  const auto weights = expected_weights(states);
  for (std::size_t x = 0; x < kPoints; ++x) {
    const double wanted = here.target[x] > 0 ? static_cast<double>(here.measure[x]) : 0;
    EXPECT_NEAR(weights[x], wanted, kTolerance) << what << ", point " << x;
  }
}

const PerPoint kEven{0.25f, 0.25f, 0.25f, 0.25f}, kUneven{0.1f, 0.2f, 0.3f, 0.4f}, kOnes{1, 1, 1, 1};

// All targets above zero, one measure.
std::vector<Domain> like_domains() {
  return {
      {kUneven, {1, 2, 0.5f, 3}, kOnes, 2, 2}, {kEven, {2, 1, 1, 0.25f}, kOnes, 1, 1}, {kUneven, kOnes, kOnes, 2, 5}};
}
// Targets that are zero in places, each domain elsewhere; a point where the canonical one is zero, and one that only it
// has; other measures.
std::vector<Domain> unlike_domains() {
  return {{kEven, {1, 2, 0, 0.5f}, {1, 0.5f, 1, 2}, 2, 2},
          {kUneven, {0, 1, 3, 0}, {2, 1, 0.5f, 1}, 2, 1},
          {kUneven, {4, 0, 1, 0}, {0.5f, 1, 1, 3}, 1, 7}};
}

TEST(Reservoir, OneStreamEstimatesOneOverTheDensityOfItsSample) {
  for (const auto& domains : {like_domains(), unlike_domains()})
    for (const Domain& d : domains) expect_unbiased(initial(d), d, "RIS");
}

TEST(Reservoir, MisWeightsWithoutBiasExpectTheTrueSum) {
  for (const Mis mis : kWithoutBias) {
    const std::string name = "MIS weight " + std::to_string(static_cast<int>(mis));
    expect_unbiased(merged(mis, like_domains()), like_domains()[0], name.c_str());
    expect_unbiased(merged(mis, unlike_domains()), unlike_domains()[0], name.c_str());
  }
}

// One that never finds anything, and one that finds nothing that the canonical one can use.
TEST(Reservoir, ReservoirsWithoutWeightTakeNothingAway) {
  auto domains = unlike_domains();
  domains[1].target = {0, 0, 0, 0};
  domains[2].target = {0, 0, 5, 0};
  for (const Mis mis : kWithoutBias) expect_unbiased(merged(mis, domains), domains[0], "no use");
  for (const Mis mis : kWithoutBias) expect_unbiased(merged(mis, {domains[0]}), domains[0], "alone");
  domains[0].target = {0, 0, 0, 0};
  for (const Mis mis : kWithoutBias) expect_unbiased(merged(mis, domains), domains[0], "dark");
}

// The canonical reservoir has no confidence: the others must have all that it may want, and then there is no bias.
TEST(Reservoir, NoConfidenceIsNoPart) {
  auto domains = like_domains();
  domains[0].confidence = 0;
  for (const Mis mis : kWithoutBias) expect_unbiased(merged(mis, domains), domains[0], "confidence 0");
}

// What one merge made goes into the next, as it does from frame to frame.
TEST(Reservoir, MergedReservoirsMayBeMergedAgain) {
  for (const Mis mis : kWithoutBias) {
    auto first = unlike_domains(), second = unlike_domains();
    first.pop_back();
    for (Domain& d : first) d.candidates = 1;
    second.erase(second.begin() + 1);
    for (Domain& d : second) d.candidates = 1;
    auto history = merged(mis, first);
    for (State& s : history) {
      EXPECT_EQ(s.reservoir.confidence, 3.0f);
      cap_confidence(s.reservoir, 2.5f);
      EXPECT_EQ(s.reservoir.confidence, 2.5f);
      cap_confidence(s.reservoir, 20);
      EXPECT_EQ(s.reservoir.confidence, 2.5f);
    }
    // The history is the first of the second merge, in a domain like that of both.
    second[0].confidence = 2.5f;
    const auto all = merged(mis, second, {history, initial(second[1])}, {0, 1});
    // Points that no reservoir of the first merge lacks are all there.
    expect_unbiased(all, second[0], "merged again");
    for (const State& s : all) EXPECT_EQ(s.reservoir.confidence, 9.5f);
  }
}

// Exactly as dark as the share of confidence that could not have brought the sample.
TEST(Reservoir, WeightsByConfidenceAloneAreBiasedWhereSupportsDiffer) {
  expect_unbiased(merged(Mis::kConfidence, like_domains()), like_domains()[0], "one support");
  const auto domains = unlike_domains();
  const auto weights = expected_weights(merged(Mis::kConfidence, domains));
  for (std::size_t x = 0; x < kPoints; ++x) {
    double able = 0;
    for (const Domain& d : domains) able += d.target[x] > 0 ? static_cast<double>(d.confidence) : 0;
    const double measure = domains[0].target[x] > 0 ? static_cast<double>(domains[0].measure[x]) : 0;
    EXPECT_NEAR(weights[x], measure * able / 10, kTolerance) << x;
    if (measure > 0) {
      EXPECT_LT(weights[x], 0.91 * measure) << x;
    }
  }
}

TEST(Reservoir, MisWeightsOfASampleAddUpToOne) {
  for (const Mis mis :
       {Mis::kConfidence, Mis::kBalance, Mis::kPairwise, Mis::kPairwiseDefensive, Mis::kPairwiseThird}) {
    for (const auto& domains : {like_domains(), unlike_domains()}) {
      for (int x = 0; x < kPoints; ++x) {
        if (domains[0].target[static_cast<std::size_t>(x)] == 0) continue;
        double sum = 0;
        for (std::size_t i = 0; i < domains.size(); ++i) {
          const float m = mis_weight(mis, domains, i, x);
          EXPECT_GE(m, 0.0f);
          EXPECT_LE(m, 1.0f + 1e-6f);
          sum += static_cast<double>(m);
        }
        EXPECT_NEAR(sum, 1, kTolerance) << static_cast<int>(mis) << ' ' << x;
      }
    }
  }
}

// The course's share: with like targets and confidences the canonical one of n has (2 n - 1) / n^2.
TEST(Reservoir, TheDefensiveShareIsTheCanonicalOnesConfidence) {
  std::vector<Domain> domains(4, Domain{kEven, kOnes, kOnes, 1, 3});
  EXPECT_NEAR(mis_weight(Mis::kPairwiseDefensive, domains, 0, 0), 7.0 / 16, kTolerance);
  EXPECT_NEAR(mis_weight(Mis::kPairwise, domains, 0, 0), 1.0 / 4, kTolerance);
  EXPECT_EQ(pairwise_mis(3, 0, 0).defensive, 1.0f) << "alone it is all";
}

TEST(Reservoir, ConfidenceWeighsInTheBalance) {
  EXPECT_FLOAT_EQ(mis_balance(mis_score(1, 2), mis_score(1, 2) + mis_score(3, 2)), 0.25f);
  EXPECT_FLOAT_EQ(mis_pairwise(pairwise_mis(1, 3, 0), 3, 2, 2), 0.75f);
  EXPECT_FLOAT_EQ(mis_pairwise_canonical(pairwise_mis(1, 3, 0), 3, 2, 2), 0.25f);
}

TEST(Reservoir, OrderDoesNotMatterInDistribution) {
  constexpr std::array<float, 4> kWeights{0.5f, 0, 2, 1.25f};
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  do {
    std::vector<State> states{{1, kNone, empty_reservoir()}};
    for (const std::size_t i : order) {
      states = all_of(states, [&](const State& s) {
        return branches(s, static_cast<int>(i),
                        [&](Reservoir& r, float u) { return update_reservoir(r, kWeights[i], 1, 1, u); });
      });
    }
    std::array<double, 4> chances{};
    for (const State& s : states) chances[static_cast<std::size_t>(s.sample)] += s.probability;
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(chances[i], static_cast<double>(kWeights[i]) / 3.75, kTolerance);
  } while (std::next_permutation(order.begin(), order.end()));
}

// And the merge of several: in distribution of sample and W.
TEST(Reservoir, MergesInAnyOrderExpectTheSame) {
  const auto domains = unlike_domains();
  std::vector<std::vector<State>> inputs;
  for (const Domain& d : domains) inputs.push_back(initial(d));
  const auto squares = [](const std::vector<State>& states) {
    std::array<double, kPoints> sums{};
    for (const State& s : states) {
      const auto w = static_cast<double>(s.reservoir.contribution_weight);
      if (s.sample != kNone) sums[static_cast<std::size_t>(s.sample)] += s.probability * w * w;
    }
    return sums;
  };
  const auto one = squares(merged(Mis::kBalance, domains, inputs, {0, 1, 2}));
  const auto other = squares(merged(Mis::kBalance, domains, inputs, {2, 0, 1}));
  for (std::size_t x = 0; x < kPoints; ++x) EXPECT_NEAR(one[x], other[x], 1e-5 * one[x]) << x;
}

// Of any u below 1 the first sample with a weight is selected: else its light would be lost.
TEST(Reservoir, TheFirstSampleIsAlwaysSelected) {
  Rng rng(1);
  for (int i = 0; i < 100000; ++i) {
    Reservoir r = empty_reservoir();
    const float weight = std::exp2(rng.uniform(-99, 99));
    EXPECT_FALSE(update_reservoir(r, 0, 1, 1, 0));
    EXPECT_TRUE(update_reservoir(r, weight, 1, 1, kLastBelowOne)) << weight;
    EXPECT_FALSE(update_reservoir(r, 0, 1, 1, 0));
    EXPECT_EQ(r.confidence, 3.0f);
  }
}

TEST(Reservoir, WhatIsNoNumberOrNegativeIsAsGoodAsZero) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, infinite, -infinite, -1.0f, 1e-35f, 1e35f}) {
    Reservoir r = empty_reservoir();
    EXPECT_FALSE(update_reservoir(r, bad, 1, 1, 0)) << bad;
    EXPECT_FALSE(update_reservoir(r, 1, bad, 1, 0)) << bad;
    EXPECT_TRUE(update_reservoir(r, 2, 4, 1, 0));
    EXPECT_FALSE(update_reservoir(r, bad, 1, 1, 0)) << bad;
    Reservoir other = r;
    other.contribution_weight = bad;
    EXPECT_FALSE(merge_reservoir(r, other, 1, 1, 1, 0)) << bad;
    other.contribution_weight = 1;
    EXPECT_FALSE(merge_reservoir(r, other, bad, 1, 1, 0)) << bad;
    EXPECT_FALSE(merge_reservoir(r, other, 1, bad, 1, 0)) << bad;
    EXPECT_FALSE(merge_reservoir(r, other, 1, 1, bad, 0)) << bad;
    EXPECT_EQ(r.weight_sum, 2.0f);
    Reservoir finished = r;
    finish_reservoir(finished, 1);
    EXPECT_EQ(finished.contribution_weight, 0.5f);
    finish_reservoir(r, bad);
    EXPECT_EQ(r.contribution_weight, 0.0f) << bad;
    EXPECT_EQ(mis_score(1, bad), 0.0f) << bad;
    EXPECT_EQ(counted_confidence(1, bad), 0.0f) << bad;
    EXPECT_EQ(mis_pairwise(pairwise_mis(1, 1, 0), 1, bad, 1), 0.0f) << bad;
  }
  for (const float bad : {nan, -infinite, -1.0f}) {
    EXPECT_EQ(mis_score(bad, 1), 0.0f);
    EXPECT_EQ(mis_by_confidence(bad, 1), 0.0f);
    EXPECT_EQ(counted_share(bad), 0.0f);
  }
  Reservoir r = empty_reservoir();
  EXPECT_FALSE(update_reservoir(r, 1, 0, nan, 0)) << "no target, no sample";
  update_reservoir(r, 0, 0, -3, 0);
  update_reservoir(r, 0, 0, infinite, 0);
  EXPECT_EQ(r.confidence, kMostConfidence);
  finish_reservoir(r, 1);
  EXPECT_EQ(r.contribution_weight, 0.0f);
}

// A million of the largest weights are finite, and so is what comes of them.
TEST(Reservoir, SumsStayFinite) {
  Reservoir r = empty_reservoir();
  for (int i = 0; i < 1000000; ++i) update_reservoir(r, kReservoirMost, 1e-24f, kMostConfidence, 0.5f);
  EXPECT_TRUE(std::isfinite(r.weight_sum));
  EXPECT_EQ(r.confidence, kMostConfidence);
  finish_reservoir(r, 1);
  EXPECT_EQ(r.contribution_weight, 0.0f) << "beyond what is kept";
}

TEST(Reservoir, PackingKeepsTheWeightAndTheRestWithinItsError) {
  Rng rng(2);
  double worst_target = 0, worst_confidence = 0;
  for (int i = 0; i < 200000; ++i) {
    Reservoir r = empty_reservoir();
    r.contribution_weight = std::exp2(rng.uniform(-99, 99));
    r.target = std::exp2(rng.uniform(-99, 99));
    r.confidence = i % 2 == 0 ? static_cast<float>(rng.below(2049)) : std::exp2(rng.uniform(-10, 15.9f));
    const Reservoir back = unpack_reservoir(pack_reservoir(r));
    EXPECT_EQ(back.contribution_weight, r.contribution_weight);
    worst_target =
        std::max(worst_target, std::abs(static_cast<double>(back.target) / static_cast<double>(r.target) - 1));
    if (i % 2 == 0) {
      EXPECT_EQ(back.confidence, r.confidence);
    } else {
      worst_confidence = std::max(
          worst_confidence, std::abs(static_cast<double>(back.confidence) / static_cast<double>(r.confidence) - 1));
    }
    EXPECT_EQ(back.weight_sum, reservoir_number(back.contribution_weight * back.target));
  }
  EXPECT_LE(worst_target, 0x1p-9);
  EXPECT_LE(worst_confidence, 0x1p-10);
  EXPECT_GT(worst_target, 0x1p-10) << "the stated error is met";
  const Reservoir none = unpack_reservoir(pack_reservoir(empty_reservoir()));
  EXPECT_EQ(none.target + none.contribution_weight + none.confidence + none.weight_sum, 0.0f);
  EXPECT_EQ(unpack_reservoir(uvec2(0xffffffffu, 0xffffffffu)).contribution_weight, 0.0f) << "no number";
}

}  // namespace
}  // namespace fb::shared
