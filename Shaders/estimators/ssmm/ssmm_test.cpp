// Screen-space Markov chain mixtures: both estimators over all random outcomes of small domains, the exchange of lanes,
// and what a state learns.
#include "estimators/ssmm/ssmm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "base/rng.h"

namespace fb::shared {
namespace {

// A domain of five points, and densities over it: one for each lane of a tile of eight, of which some have no lobe and
// scatter.
constexpr int kPlaces = 5, kTileLanes = 8;
using Density = std::array<double, kPlaces>;

Density normalized(Density p) {
  double sum = 0;
  for (const double x : p) sum += x;
  for (double& x : p) x /= sum;
  return p;
}
std::array<Density, kTileLanes> lane_densities() {
  const Density scattered = normalized({1, 1, 2, 1, 1});
  std::array<Density, kTileLanes> all;
  Rng rng(7);
  for (int lane = 0; lane < kTileLanes; ++lane) {
    Density lobe;
    for (double& x : lobe) x = std::pow(rng.uniform(), 4);
    lobe = normalized(lobe);
    for (int i = 0; i < kPlaces; ++i) all[lane][i] = lane % 3 == 1 ? scattered[i] : 0.2 * scattered[i] + 0.8 * lobe[i];
  }
  return all;
}
constexpr Density kEmitted{0.3, 0, 2.5, 1e-3, 7};
double sum_of(const Density& f) {
  double sum = 0;
  for (const double x : f) sum += x;
  return sum;
}
// What is expected of f / density where a sample is of `from`.
double expected(const Density& from, const Density& density) {
  double sum = 0;
  for (int i = 0; i < kPlaces; ++i)
    if (from[i] > 0) sum += from[i] * kEmitted[i] / density[i];
  return sum;
}
Density mean_of(const std::array<Density, kTileLanes>& all) {
  Density mean{};
  for (const Density& p : all)
    for (int i = 0; i < kPlaces; ++i) mean[i] += p[i] / kTileLanes;
  return mean;
}

TEST(Ssmm, TheSpatialEstimatorIsExact) {
  const std::array<Density, kTileLanes> p = lane_densities();
  const Density all = mean_of(p);
  for (std::uint32_t lane = 0; lane < kTileLanes; ++lane) {
    double mean = 0, without_zero = 0, own = 0;
    for (std::uint32_t mask = 0; mask < kTileLanes; ++mask) {
      const double e = expected(p[spatial_lane(lane, mask)], all);
      mean += e / kTileLanes;
      if (mask > 0) without_zero += e / (kTileLanes - 1);
    }
    own = expected(p[lane], all);
    EXPECT_NEAR(mean, sum_of(kEmitted), 1e-12);
    // A mask that is never zero leaves the lane's own density out of what it may have sampled.
    EXPECT_NEAR(without_zero, (kTileLanes * sum_of(kEmitted) - own) / (kTileLanes - 1), 1e-12);
    EXPECT_GT(std::abs(without_zero - sum_of(kEmitted)), 1e-3);
    // Without exchange it is biased by all that the lane's density differs from the tile's.
    EXPECT_GT(std::abs(own - sum_of(kEmitted)), 1e-3);
  }
}

// A tile some of whose places hold nothing: who should sample one of them keeps its own.
TEST(Ssmm, ATileWithHolesIsBiased) {
  const std::array<Density, kTileLanes> p = lane_densities();
  const std::set<std::uint32_t> holes{2, 5};
  Density all{};
  for (std::uint32_t lane = 0; lane < kTileLanes; ++lane)
    for (int i = 0; i < kPlaces; ++i) all[i] += holes.contains(lane) ? 0 : p[lane][i] / (kTileLanes - 2);
  double mean = 0, theory = 0;
  for (std::uint32_t mask = 0; mask < kTileLanes; ++mask) {
    const std::uint32_t from = spatial_lane(0, mask);
    mean += expected(p[holes.contains(from) ? 0 : from], all) / kTileLanes;
  }
  for (int i = 0; i < kPlaces; ++i)
    theory += kEmitted[i] * ((kTileLanes - 2) * all[i] + 2 * p[0][i]) / kTileLanes / all[i];
  EXPECT_NEAR(mean, theory, 1e-12);
  EXPECT_GT(std::abs(mean - sum_of(kEmitted)), 1e-3);
}

// A pixel's mean over its paths, as the steps sample and weigh: exact for each draw over time, and over all draws of
// the tile. One lobe too few in the density is seen.
TEST(Ssmm, ThePathsOfAPixelAreExact) {
  const std::array<Density, kTileLanes> p = lane_densities();
  const auto pixel = [&](std::uint32_t lane, std::uint32_t draw, std::uint32_t paths, bool temporal, bool all) {
    const std::uint32_t lanes = weighed_lanes(paths, kTileLanes, temporal) - (all ? 0 : 1);
    Density weighed{};
    for (std::uint32_t i = 0; i < lanes; ++i) {
      const std::uint32_t of = weighed_lane(lane, draw, i, kTileLanes, temporal);
      for (int place = 0; place < kPlaces; ++place) weighed[place] += p[of][place] / lanes;
    }
    double mean = 0;
    for (std::uint32_t path = 0; path < paths; ++path)
      mean += expected(p[sampled_lane(lane, draw, path, kTileLanes, temporal)], weighed) / paths;
    return mean;
  };
  for (const std::uint32_t lane : {0u, 2u, 7u}) {
    for (const std::uint32_t paths : {2u, 3u, 8u, 11u}) {
      double spatial = 0, spatial_less = 0;
      for (std::uint32_t draw = 0; draw < kTileLanes; ++draw) {
        EXPECT_NEAR(pixel(lane, draw, paths, true, true), sum_of(kEmitted), 1e-12) << lane << ' ' << draw;
        EXPECT_GT(std::abs(pixel(lane, draw, paths, true, false) - sum_of(kEmitted)), 1e-3);
        spatial += pixel(lane, draw, paths, false, true) / kTileLanes;
        spatial_less += pixel(lane, draw, paths, false, false) / kTileLanes;
      }
      EXPECT_NEAR(spatial, sum_of(kEmitted), 1e-12) << lane;
      EXPECT_GT(std::abs(spatial_less - sum_of(kEmitted)), 1e-3);
    }
  }
}

// Lanes that all scatter, but for none or for one, which knows where light is.
TEST(Ssmm, OneLobeOfATileAndNoneAreExact) {
  for (const bool one : {false, true}) {
    std::array<Density, kTileLanes> p;
    p.fill(normalized({1, 1, 2, 1, 1}));
    if (one) p[5] = normalized({1e-9, 1e-9, 1e-9, 1e-9, 1});
    const Density all = mean_of(p);
    for (std::uint32_t lane = 0; lane < kTileLanes; ++lane) {
      double spatial = 0, temporal = 0;
      for (std::uint32_t draw = 0; draw < kTileLanes; ++draw) {
        spatial += expected(p[spatial_lane(lane, draw)], all) / kTileLanes;
        temporal += expected(p[temporal_lane(lane, draw, kTileLanes)], all) / kTileLanes;
      }
      EXPECT_NEAR(spatial, sum_of(kEmitted), 1e-12);
      EXPECT_NEAR(temporal, sum_of(kEmitted), 1e-12);
    }
  }
}

// A second lobe that the first one's sample moved: the sum of densities hangs on a sample of the sum.
TEST(Ssmm, ALobeThatItsOwnSamplesMoveIsBiased) {
  const std::array<Density, kTileLanes> p = lane_densities();
  double mean = 0;
  for (int first = 0; first < kPlaces; ++first) {
    const Density& moved = p[first < 2 ? 3 : 6];
    double e = kEmitted[first] / (p[0][first] + moved[first]);
    for (int second = 0; second < kPlaces; ++second)
      e += moved[second] * kEmitted[second] / (p[0][second] + moved[second]);
    mean += p[0][first] * e;
  }
  EXPECT_GT(std::abs(mean - sum_of(kEmitted)), 1e-3);
}

TEST(Ssmm, LanesExchange) {
  for (const int tile : {8, 16, 32}) {
    const std::uint32_t lanes = lanes_of(tile);
    EXPECT_EQ(lanes, static_cast<std::uint32_t>(tile));
    for (std::uint32_t draw = 0; draw < lanes; ++draw) {
      std::set<std::uint32_t> spatial, temporal;
      for (std::uint32_t lane = 0; lane < lanes; ++lane) {
        spatial.insert(spatial_lane(lane, draw));
        temporal.insert(temporal_lane(lane, draw, lanes));
      }
      EXPECT_EQ(spatial.size(), lanes);
      EXPECT_EQ(temporal.size(), lanes);
      EXPECT_LT(*spatial.rbegin(), lanes);
      EXPECT_LT(*temporal.rbegin(), lanes);
    }
    for (std::uint32_t y = 0; y < 9; ++y) {
      for (std::uint32_t x = 0; x < 17; ++x) {
        const uvec2 block(x, y);
        EXPECT_EQ(block_of_lane(tile_of(block, lanes), lane_of(block, lanes), lanes), block);
      }
    }
  }
}

// The state against sums in double precision, for light that is spread over a lamp of any size, with and without light.
TEST(Ssmm, AStateHasTheMeansOfItsSamples) {
  using Real = long double;
  using Vector = std::array<Real, 3>;
  const auto direction_from = [](const vec3& origin, Vector to) {
    Real square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      to[axis] -= static_cast<Real>(origin[axis]);
      square += to[axis] * to[axis];
    }
    for (Real& x : to) x /= std::sqrt(square);
    return to;
  };
  Rng rng(3);
  for (const float size : {1e-3f, 1.0f, 40.0f}) {
    ChainState s = no_chain_state();
    const vec3 origin(10, -20, 5), center(100, 30, 60);
    Real weight = 0, cosine = 0;
    Vector target{};
    for (int n = 0; n < 200; ++n) {
      const vec3 hit = center + vec3(rng.uniform(-size, size), rng.uniform(-size, size), rng.uniform(-size, size));
      const float score = n > 0 && n % 5 == 0 ? 0.0f : rng.uniform(0.1f, 3.0f);
      s = updated_state(s, origin, hit, score, 0.1f, 1024);
      const Vector at{hit.x, hit.y, hit.z}, mu = direction_from(origin, target), way = direction_from(origin, at);
      const Real a = std::max(1 / static_cast<Real>(n + 1), static_cast<Real>(0.1f));
      const Real kept = (1 - a) * weight, added = a * static_cast<Real>(score), all = kept + added;
      Real square = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const Real x = (kept * cosine * mu[axis] + added * way[axis]) / all;
        square += x * x;
        target[axis] = (kept * target[axis] + added * at[axis]) / all;
      }
      cosine = std::sqrt(square);
      weight = all;
      ASSERT_NEAR(s.weight, weight, 1e-5L * weight);
      for (int axis = 0; axis < 3; ++axis) ASSERT_NEAR(s.target[axis], target[axis], 1e-4L);
      ASSERT_NEAR(s.spread, 1 - cosine, 1e-3L * (1 - cosine) + 1e-9L) << size << ' ' << n;
    }
    EXPECT_EQ(s.count, 200);
  }
}

TEST(Ssmm, HardStates) {
  const vec3 origin(1, 2, 3);
  // Nothing was found, or no number: nothing is kept, of any field.
  for (const float score : {0.0f, std::numeric_limits<float>::quiet_NaN()}) {
    const ChainState none = updated_state(no_chain_state(), origin, vec3(4, 5, 6), score, 0.1f, 1024);
    EXPECT_FALSE(is_valid_state(none));
    EXPECT_EQ(none.count, 0);
    EXPECT_EQ(none.spread, 0);
    EXPECT_EQ(none.target, vec3(0));
  }
  // Found at the vertex itself: it has a state, and no lobe there.
  const ChainState here = updated_state(no_chain_state(), origin, origin, 1, 0.1f, 1024);
  EXPECT_TRUE(is_valid_state(here));
  EXPECT_FALSE(has_lobe(here, origin));
  EXPECT_TRUE(has_lobe(here, vec3(9, 9, 9)));
  // The count ends, and then the least weight of a sample is all that it decides.
  ChainState s = no_chain_state();
  for (int i = 0; i < 40; ++i) s = updated_state(s, origin, vec3(100, 0, 0), 1, 0.1f, 32);
  EXPECT_EQ(s.count, 32);
  EXPECT_EQ(s.spread, 0);
  for (const float prior : {0.0f, 0.2f}) {
    const VmfLobe lobe = chain_lobe(s, origin, prior, 0, 8);
    EXPECT_TRUE(std::isfinite(lobe.scale)) << prior;
    EXPECT_TRUE(std::isfinite(vmf_lobe_pdf(lobe, vec3(0, 0, 1))));
  }
  // Directions that cancel: as wide as can be.
  ChainState wide = updated_state(no_chain_state(), vec3(0), vec3(1, 0, 0), 1, 0.1f, 1024);
  wide = updated_state(wide, vec3(0), vec3(-1, 0, 0), 1, 0.1f, 1024);
  EXPECT_NEAR(wide.spread, 1, 1e-6);
  Rng rng(7);
  for (int i = 0; i < 1000; ++i) {
    const vec3 way(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    wide = updated_state(updated_state(no_chain_state(), vec3(0), way, 1, 0.1f, 1024), vec3(0), -way, 1, 0.1f, 1024);
    ASSERT_TRUE(wide.spread > 0.999f && wide.spread <= 1);
  }
  EXPECT_EQ(usable_score(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(usable_score(std::numeric_limits<float>::infinity()), 0);
  EXPECT_EQ(usable_score(-1), 0);
  EXPECT_EQ(usable_score(2), 2);
}

// Mean cosines from 1 to 0 with no prior: the density is finite, is one over the sphere, and is where samples fall.
TEST(Ssmm, LobesOfAnyWidthAreDensities) {
  Rng rng(5);
  for (const float spread : {0.0f, 1e-9f, 1e-6f, 1e-3f, 0.1f, 0.5f, 0.999f, 1.0f}) {
    ChainState s = updated_state(no_chain_state(), vec3(0), vec3(0, 0, 100), 1, 0.1f, 1024);
    s.spread = spread;
    const VmfLobe lobe = chain_lobe(s, vec3(0), 0, 0, 8);
    // Over x = log(1 - cosine), by midpoints.
    constexpr int kSteps = 4000;
    const double low = std::log(1e-14), step = (std::log(2.0) - low) / kSteps;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double t = std::exp(low + (i + 0.5) * step), sine = std::sqrt(t * (2 - t));
      const float pdf = vmf_lobe_pdf(lobe, vec3(static_cast<float>(sine), 0, static_cast<float>(1 - t)));
      ASSERT_TRUE(std::isfinite(pdf)) << spread;
      sum += 2 * std::acos(-1.0) * static_cast<double>(pdf) * t * step;
    }
    EXPECT_NEAR(sum, 1, 0.01) << spread;
    for (int i = 0; i < 100; ++i) {
      const vec3 way = vmf_sample(lobe.mu, lobe.kappa, vec2(rng.uniform(), rng.uniform()));
      ASSERT_NEAR(length(way), 1, 1e-5f) << spread;
      ASSERT_GT(vmf_lobe_pdf(lobe, way), 0) << spread;
    }
  }
}

// A target at the shading point has no lobe; one beside it has a lobe that is finite, by either prior.
TEST(Ssmm, TargetsAtTheVertex) {
  const vec3 origin(1000, -2000, 50);
  for (const float distance : {0.0f, 1e-30f, 1e-20f, 1e-4f, 0.002f, 0.1f}) {
    const ChainState s = updated_state(no_chain_state(), vec3(0), vec3(0, 0, distance), 1, 0.1f, 1024);
    ASSERT_TRUE(is_valid_state(s));
    EXPECT_EQ(has_lobe(s, vec3(0)), distance > 0.001f) << distance;
    for (const float cosine : {0.0f, 0.99f, -1.0f}) {
      const VmfLobe lobe = chain_lobe(s, vec3(0), 0.2f, cosine, 8);
      EXPECT_TRUE(std::isfinite(lobe.kappa) && std::isfinite(lobe.scale) && std::isfinite(lobe.mu.z))
          << distance << ' ' << cosine;
    }
    // Where float32 holds no difference between the two.
    const ChainState far =
        updated_state(no_chain_state(), origin, origin + vec3(0, 0, 0.01f * distance), 1, 0.1f, 1024);
    EXPECT_TRUE(std::isfinite(chain_lobe(far, origin, 0.2f, -1, 8).kappa));
  }
}

// The prior counts less with the square of the samples, and one of a size is as wide as that is far.
TEST(Ssmm, ThePriorFades) {
  ChainState s = updated_state(no_chain_state(), vec3(0), vec3(0, 0, 100), 1, 0.1f, 1024);
  const float once = chain_lobe(s, vec3(0), 0.2f, 0, 8).kappa;
  EXPECT_NEAR(once, vmf_kappa(0.2f / 1.2f), 1e-3 * once);
  s = updated_state(s, vec3(0), vec3(0, 0, 100), 1, 0.1f, 1024);
  EXPECT_NEAR(chain_lobe(s, vec3(0), 0.2f, 0, 8).kappa, vmf_kappa(0.2f / 4.2f), 1e-2);
  for (const float distance : {1.0f, 10.0f, 1000.0f}) {
    const double cosine = 1 / std::sqrt(1 + 64.0 / (static_cast<double>(distance) * distance));
    EXPECT_NEAR(prior_spread(-1, 8, distance), (1 - cosine) / 2, 1e-5 * (1 - cosine) + 1e-9);
  }
  EXPECT_EQ(prior_spread(0.25f, 8, 1), 0.75f);
}

TEST(Ssmm, ACellKeepsStatesByTheirScoresAndFadesInTheDark) {
  ChainState cell = no_chain_state();
  const ChainState none = no_chain_state();
  ChainState weak = updated_state(none, vec3(0), vec3(1, 0, 0), 1, 0.1f, 1024), strong = weak;
  weak.score = 1;
  strong.score = 4;
  EXPECT_FALSE(is_valid_state(kept_in_world(none, none, 0)));
  cell = kept_in_world(cell, weak, 0.9f);
  EXPECT_EQ(cell.score, 1);
  EXPECT_EQ(kept_in_world(cell, strong, 0.99f).score, 4);
  EXPECT_EQ(kept_in_world(strong, weak, 0.24f).score, 1);
  EXPECT_EQ(kept_in_world(strong, weak, 0.26f).score, 4);
  for (int frame = 0; frame < 70; ++frame) cell = kept_in_world(cell, none, 0.5f);
  EXPECT_FALSE(is_valid_state(cell));
}

TEST(Ssmm, EveryPixelOfALargeCellTeachesIt) {
  for (const std::uint32_t element : {0u, 1u, 0xfffffeu, 0x3ffffffu})
    for (const std::uint32_t order : {0u, 77u, 0xffffffffu})
      EXPECT_EQ(claiming_element(claim_of(element, order), order), element);
  constexpr std::uint32_t kPixels = 4096, kFrames = 4096;
  Rng rng(3);
  int quarters[4] = {0, 0, 0, 0};
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    const std::uint32_t order = rng.next();
    std::uint32_t largest = 0;
    for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) largest = std::max(largest, claim_of(pixel, order));
    ++quarters[4 * claiming_element(largest, order) / kPixels];
  }
  for (const int count : quarters) EXPECT_NEAR(count, kFrames / 4, 4 * 28) << "four standard deviations";
}

// Six numbers make a B-spline of degree 5 over the window (four, as the paper has it, would make one of degree 3).
TEST(Ssmm, NeighboursAreOfABSplineOfDegreeFive) {
  Rng rng(11);
  double square = 0, fourth = 0;
  constexpr int kDraws = 200000;
  for (int i = 0; i < kDraws; ++i) {
    const double x = spline_offset(rng.next());
    EXPECT_LE(std::abs(x), 0.5);
    square += x * x / kDraws;
    fourth += x * x * x * x / kDraws;
  }
  // Sums of n numbers: variance n / 12 and excess of the fourth moment -6 / (5 n), here over six units.
  EXPECT_NEAR(square, 1.0 / 72, 0.01 / 72);
  EXPECT_NEAR(fourth / (square * square), 3 - 6.0 / (5 * 6), 0.03);
}

}  // namespace
}  // namespace fb::shared
