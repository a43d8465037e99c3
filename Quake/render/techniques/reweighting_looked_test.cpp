// render/techniques/reweighting.h where light is looked for, too: paths of one and of two directions on a few points,
// each of which can end by what it met or by what it looked for. Every outcome of iterations that teach is enumerated
// with its probability.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "render/techniques/reweighting.h"

namespace fb::render {
namespace {

constexpr std::size_t kFirst = 2, kSecond = 3;  // directions of the first vertex; of the one it leads to
constexpr double kLookedExact = 1e-12;
using FirstRow = std::array<double, kFirst>;
using SecondRow = std::array<double, kSecond>;

// What is met in each direction of the first vertex, what the vertex there reflects to it, and what is met from there.
constexpr FirstRow kEmission{0.5, 3}, kReflected{0.8, 0.3};
constexpr std::array<SecondRow, kFirst> kMet{SecondRow{6, 0, 1}, SecondRow{0, 9, 2}};
// Looking: one of these directions, or none. What no one looks for is met alone.
constexpr FirstRow kLooked{0.1, 0.7};
constexpr std::array<SecondRow, kFirst> kLookedThere{SecondRow{0.5, 0.2, 0}, SecondRow{0, 0.3, 0.6}};

struct Proposals {
  FirstRow first{0.75, 0.25};
  std::array<SecondRow, kFirst> second{SecondRow{0.15, 0.6, 0.25}, SecondRow{0.5, 0.1, 0.4}};
};
double integral() {
  double sum = 0;
  for (std::size_t a = 0; a < kFirst; ++a) {
    sum += kEmission[a];
    for (std::size_t x = 0; x < kSecond; ++x) sum += kReflected[a] * kMet[a][x];
  }
  return sum;
}

struct PathSample {
  std::size_t a = 0, x = 0;                             // the directions of its path
  std::size_t looked_first = kFirst, looked = kSecond;  // kFirst, kSecond: nothing was looked for
  bool operator==(const PathSample&) const = default;
};
template <std::size_t N>
double chance_of(const std::array<double, N>& row, std::size_t at) {
  if (at < N) return row[at];
  double rest = 1;
  for (const double p : row) rest -= p;
  return rest;
}
// All outcomes of one sample, with their probability.
void each_sample(const Proposals& p, const std::function<void(const PathSample&, double)>& each) {
  PathSample s;
  for (s.a = 0; s.a < kFirst; ++s.a)
    for (s.x = 0; s.x < kSecond; ++s.x)
      for (s.looked_first = 0; s.looked_first <= kFirst; ++s.looked_first)
        for (s.looked = 0; s.looked <= kSecond; ++s.looked)
          each(s, p.first[s.a] * p.second[s.a][s.x] * chance_of(kLooked, s.looked_first) *
                      chance_of(kLookedThere[s.a], s.looked));
}

// Half of it the first iteration's, half as the samples found what they did not look for.
Proposals taught_by(const std::vector<PathSample>& samples, const Proposals& p) {
  const Proposals scattered;
  FirstRow first{};
  std::array<SecondRow, kFirst> second{};
  for (const PathSample& s : samples) {
    const double there = kMet[s.a][s.x] / (p.second[s.a][s.x] + kLookedThere[s.a][s.x]);
    second[s.a][s.x] += there;
    first[s.a] += kEmission[s.a] / (p.first[s.a] + kLooked[s.a]) + kReflected[s.a] * there / p.first[s.a];
  }
  Proposals next;
  const auto blend = [](const auto& found, const auto& own, auto& into) {
    double sum = 0;
    for (const double weight : found) sum += weight;
    for (std::size_t i = 0; i < into.size(); ++i) into[i] = sum > 0 ? 0.5 * own[i] + 0.5 * found[i] / sum : own[i];
  };
  blend(first, scattered.first, next.first);
  for (std::size_t a = 0; a < kFirst; ++a) blend(second[a], scattered.second[a], next.second[a]);
  return next;
}

using Iterations = std::vector<Proposals>;
enum class Weighed { kPath, kVertices };
// How a path's last direction counts in the ratio of its densities: end_log_ratio, or what is wrong.
enum class End { kMet, kLookedFor };
using EndRatio = std::function<double(double proposed, double own, double looked_for, End end)>;
double both_ends(double proposed, double own, double looked_for, End) {
  return end_log_ratio(proposed, own, looked_for);
}

// What a sample of iteration `own` adds to the picture.
double brought(const Iterations& p, const std::vector<double>& counts, std::size_t own, const PathSample& s,
               const EndRatio& end, Weighed how = Weighed::kPath) {
  const auto factor_of = [&](const auto& ratio) {
    std::vector<double> ratios(p.size());
    for (std::size_t k = 0; k < p.size(); ++k) ratios[k] = k == own ? 0 : ratio(p[k]);
    return balance_factor(ratios, counts);
  };
  const auto weighed = [&](double light, const auto& ratio) { return light > 0 ? light * factor_of(ratio) : 0; };
  const Proposals& mine = p[own];
  const auto first = [&](std::size_t at, End kind) {
    return weighed(kEmission[at] / (mine.first[at] + kLooked[at]),
                   [&](const Proposals& k) { return end(k.first[at], mine.first[at], kLooked[at], kind); });
  };
  const auto second = [&](std::size_t at, End kind) {
    const double all = mine.second[s.a][at] + kLookedThere[s.a][at];
    const double light = kReflected[s.a] * kMet[s.a][at] / (mine.first[s.a] * all);
    const auto first_ratio = [&](const Proposals& k) { return std::log(k.first[s.a] / mine.first[s.a]); };
    const auto last_ratio = [&](const Proposals& k) {
      return end(k.second[s.a][at], mine.second[s.a][at], kLookedThere[s.a][at], kind);
    };
    if (how == Weighed::kPath)
      return weighed(light, [&](const Proposals& k) { return first_ratio(k) + last_ratio(k); });
    double samples = 0;
    for (const double n : counts) samples += n;
    return weighed(light, last_ratio) * samples * factor_of(first_ratio);
  };
  return first(s.a, End::kMet) + (s.looked_first < kFirst ? first(s.looked_first, End::kLookedFor) : 0) +
         second(s.x, End::kMet) + (s.looked < kSecond ? second(s.looked, End::kLookedFor) : 0);
}

// Relative, of iterations of so many samples. `apart`: so many others teach. Samples that teach no longer, those of the
// last iteration and all seen ones where others teach, are asked one at a time: their expectations add up.
double looked_bias(const std::vector<std::size_t>& schedule, bool apart, const EndRatio& end,
                   Weighed how = Weighed::kPath) {
  std::vector<double> counts;
  for (const std::size_t n : schedule) counts.push_back(static_cast<double>(n));
  Iterations p;
  std::vector<std::vector<PathSample>> teaching;
  double sum = 0;
  const std::function<void(const Proposals&, double)> next = [&](const Proposals& proposals, double probability) {
    const std::size_t i = p.size();
    p.push_back(proposals);
    if (i + 1 == schedule.size()) {
      for (std::size_t own = 0; own < p.size(); ++own) {
        if (!apart && own < i) {
          for (const PathSample& s : teaching[own]) sum += probability * brought(p, counts, own, s, end, how);
        } else {
          each_sample(p[own], [&](const PathSample& s, double chance) {
            sum += probability * counts[own] * chance * brought(p, counts, own, s, end, how);
          });
        }
      }
    } else {
      teaching.emplace_back();
      const std::function<void(double)> teach = [&](double so_far) {
        if (teaching.back().size() == schedule[i]) {
          next(taught_by(teaching.back(), proposals), so_far);
          return;
        }
        each_sample(proposals, [&](const PathSample& s, double chance) {
          // Of those that teach apart what they looked for does not matter.
          if (apart && (s.looked_first != kFirst || s.looked != kSecond)) return;
          teaching.back().push_back(s);
          teach(so_far * (apart ? proposals.first[s.a] * proposals.second[s.a][s.x] : chance));
          teaching.back().pop_back();
        });
      };
      teach(probability);
      teaching.pop_back();
    }
    p.pop_back();
  };
  next(Proposals(), 1);
  return sum / integral() - 1;
}

TEST(ReweightingLookedSequences, NothingIsLostWhereOtherSamplesTeach) {
  for (const std::vector<std::size_t>& schedule :
       {std::vector<std::size_t>{3}, {1, 1}, {2, 1}, {1, 4}, {3, 3}, {1, 1, 1}, {2, 1, 3}})
    EXPECT_NEAR(looked_bias(schedule, true, both_ends), 0, kLookedExact) << schedule.size();
}

TEST(ReweightingLookedSequences, EnergyIsLostWhereTheSameSamplesTeach) {
  const double one = looked_bias({1, 1}, false, both_ends), two = looked_bias({2, 2}, false, both_ends);
  EXPECT_LT(two, -1e-3);
  EXPECT_LT(one, two) << "it falls with samples";
}

// Weights that know of one end alone what made it are biased whoever teaches: the two do not add up to one.
TEST(ReweightingLookedSequences, BothDensitiesStandInTheDenominatorOfBothEnds) {
  const auto each_its_own = [](double proposed, double own, double, End kind) {
    return kind == End::kMet ? std::log(proposed / own) : 0.0;
  };
  const auto looked_alone = [](double proposed, double own, double looked_for, End kind) {
    return kind == End::kMet ? std::log(proposed / own) : end_log_ratio(proposed, own, looked_for);
  };
  EXPECT_GT(std::abs(looked_bias({2, 2}, true, each_its_own)), 1e-3);
  EXPECT_GT(std::abs(looked_bias({2, 2}, true, looked_alone)), 1e-3);
}

// Of paths of two directions the weights of vertices do not add up to one.
TEST(ReweightingLookedSequences, WeightsOfEachVertexAreBiasedWhoeverTeaches) {
  EXPECT_NEAR(looked_bias({3}, true, both_ends, Weighed::kVertices), 0, kLookedExact);
  EXPECT_GT(std::abs(looked_bias({2, 2}, true, both_ends, Weighed::kVertices)), 1e-3);
}

}  // namespace
}  // namespace fb::render
