// Probes' arithmetic: octahedral maps that fold over their edges, cells of a volume that moves, weights, directions of
// rays, where paths end.
#include "estimators/ddgi/ddgi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "base/rng.h"
#include "shared/bsdf.h"

namespace fb::shared {
namespace {

constexpr double kDdgiPi = 3.14159265358979323846;

vec3 even_direction(Rng& rng) { return ddgi_sphere_point(static_cast<uint>(rng.uniform(0, 100000)), 100000); }

// What a map of a function's values at texels' middles gives in a direction.
template <typename Function>
double interpolated(const Function& function, vec3 d, int side) {
  const DdgiTaps t = ddgi_taps(d, side);
  double sum = 0;
  for (int i = 0; i < 4; ++i)
    sum += static_cast<double>(t.weight[i]) * static_cast<double>(function(ddgi_direction(t.texel[i], side)));
  return sum;
}

TEST(DdgiMap, ATexelsMiddleIsItsOwn) {
  for (const int side : {kDdgiLightSide, kDdgiDepthSide}) {
    for (int texel = 0; texel < side * side; ++texel) {
      const DdgiTaps t = ddgi_taps(ddgi_direction(static_cast<uint>(texel), side), side);
      double own = 0;
      for (int i = 0; i < 4; ++i) own += t.texel[i] == static_cast<uint>(texel) ? static_cast<double>(t.weight[i]) : 0;
      EXPECT_NEAR(own, 1, 1e-4) << texel;
    }
  }
}

// Over an edge lies the texel that is next to it on the sphere, and from there the way back is the same.
TEST(DdgiMap, EdgesFoldToNeighbours) {
  for (const int side : {kDdgiLightSide, kDdgiDepthSide}) {
    const auto cosine = [&](uint a, uint b) { return dot(ddgi_direction(a, side), ddgi_direction(b, side)); };
    const float near = std::cos(4.0f / static_cast<float>(side));
    for (int i = 0; i < side; ++i) {
      EXPECT_GT(cosine(ddgi_texel(-1, i, side), ddgi_texel(0, i, side)), near) << i;
      EXPECT_GT(cosine(ddgi_texel(side, i, side), ddgi_texel(side - 1, i, side)), near) << i;
      EXPECT_GT(cosine(ddgi_texel(i, -1, side), ddgi_texel(i, 0, side)), near) << i;
      EXPECT_GT(cosine(ddgi_texel(i, side, side), ddgi_texel(i, side - 1, side)), near) << i;
      const uint over = ddgi_texel(-1, i, side);
      EXPECT_EQ(ddgi_texel(-1, static_cast<int>(over) / side, side), ddgi_texel(0, i, side));
    }
    // Beyond a corner is the opposite one: all four are one point.
    EXPECT_EQ(ddgi_texel(-1, -1, side), ddgi_texel(side - 1, side - 1, side));
    EXPECT_EQ(ddgi_texel(side, -1, side), ddgi_texel(0, side - 1, side));
  }
}

// What a map says has no seams, and of a function that is linear in the direction it says what it should.
TEST(DdgiMap, InterpolationHasNoSeams) {
  Rng rng(3);
  const vec3 axis = normalize(vec3(0.3f, -0.5f, 0.8f));
  const auto linear = [&](vec3 d) { return 1.0f + dot(d, axis); };
  for (int i = 0; i < 20000; ++i) {
    vec3 d = even_direction(rng);
    if (i % 2 == 0) d.z = -1e-4f * rng.uniform(0.1f, 1);  // near the equator's fold
    if (i % 4 == 1) (i % 8 == 1 ? d.x : d.y) = 0;         // on the folds of the lower half
    d = normalize(d);
    const vec3 beside = normalize(d + vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)) * 1e-4f);
    for (const int side : {kDdgiLightSide, kDdgiDepthSide}) {
      EXPECT_NEAR(interpolated(linear, d, side), interpolated(linear, beside, side), 2e-3);
      EXPECT_NEAR(interpolated(linear, d, side), linear(d), 1.6 / side) << d.x << ' ' << d.y << ' ' << d.z;
    }
  }
}

// A volume that moves by a cell along an axis gives that layer's places to new cells, and leaves all others.
TEST(DdgiGrid, CellsKeepTheirPlaces) {
  for (const int count : {1, 5, 8, 16}) {
    for (int first = -40; first < 40; ++first) {
      std::set<int> places;
      int moved = 0;
      for (int place = 0; place < count; ++place) {
        const int cell = ddgi_cell_of(place, first, count);
        EXPECT_GE(cell, first);
        EXPECT_LT(cell, first + count);
        EXPECT_EQ(ddgi_modulo(cell, count), place);
        places.insert(cell);
        moved += ddgi_cell_of(place, first + 1, count) != cell ? 1 : 0;
      }
      EXPECT_EQ(places.size(), static_cast<std::size_t>(count));
      EXPECT_EQ(moved, 1);
    }
  }
  EXPECT_NE(ddgi_cell_key(0, 0, 0), 0u);
  EXPECT_NE(ddgi_cell_key(-1, 0, 0), ddgi_cell_key(0, -1, 0));
  EXPECT_NE(ddgi_cell_key(15, 0, 0), ddgi_cell_key(-1, 0, 0));
}

// Of any distances the share beyond one is at most the bound, before it is sharpened: here of two walls, for which it
// is met with equality.
TEST(DdgiWeights, VisibilityIsChebyshevsBound) {
  for (const float share : {0.1f, 0.4f, 0.8f}) {
    const float near = 10, far = 50, mean = share * far + (1 - share) * near;
    const float square = share * far * far + (1 - share) * near * near;
    EXPECT_EQ(ddgi_visibility(near, mean, square), 1);
    const float seen = ddgi_visibility(far, mean, square);
    EXPECT_NEAR(seen, std::max(share * share * share, kDdgiLeastVisible), 1e-4f);
  }
  EXPECT_EQ(ddgi_visibility(100, 10, 100), kDdgiLeastVisible);
  EXPECT_EQ(ddgi_crushed(kDdgiSmallWeight), kDdgiSmallWeight);
  EXPECT_LT(ddgi_crushed(kDdgiLeastVisible) * ddgi_facing(1), kDdgiLeastKnown) << "what none sees is not known";
  EXPECT_GT(ddgi_facing(-1), 0);
}

TEST(DdgiRays, DirectionsCoverTheSphereEvenly) {
  Rng rng(5);
  for (const uint n : {16u, 192u, 256u}) {
    for (int run = 0; run < 20; ++run) {
      const vec3 u(rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0, 1));
      const vec3 normal = even_direction(rng);
      double cosine = 0, length = 0;
      for (uint i = 0; i < n; ++i) {
        const vec3 d = ddgi_turned(ddgi_sphere_point(i, n), u);
        cosine += static_cast<double>(std::max(dot(d, normal), 0.0f)) / n;
        length = std::max(length, std::abs(1 - static_cast<double>(glm::length(d))));
      }
      EXPECT_NEAR(cosine, 0.25, 0.6 / n + 2e-4);
      EXPECT_LT(length, 1e-5);
    }
  }
}

// Rotations are uniform: a vector turned has no mean, and the second moments of one on the sphere.
TEST(DdgiRays, RotationsAreUniform) {
  Rng rng(7);
  constexpr int kTurns = 200000;
  vec3 mean(0.0f);
  std::array<double, 6> second{};
  for (int i = 0; i < kTurns; ++i) {
    const vec3 d = ddgi_turned(vec3(0, 0.6f, 0.8f), vec3(rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0, 1)));
    mean += d / static_cast<float>(kTurns);
    const std::array<float, 6> products{d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.y * d.z, d.z * d.x};
    for (std::size_t k = 0; k < 6; ++k) second[k] += static_cast<double>(products[k]) / kTurns;
  }
  const double error = 4.5 / std::sqrt(static_cast<double>(kTurns));
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(mean[axis], 0, error * std::sqrt(1.0 / 3));
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(second[k], k < 3 ? 1.0 / 3 : 0, error * std::sqrt(4.0 / 45));
}

// As ddgi_sphere_point, in double: a float has too few digits for the turn of so many points.
vec3 lattice_point(uint i, uint n) {
  const double phi = 2 * kDdgiPi * std::fmod(i * 0.6180339887498949, 1.0), z = 1 - (2.0 * i + 1) / n;
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  return vec3(r * std::cos(phi), r * std::sin(phi), z);
}

TEST(DdgiMap, TexelsCoverTheSphere) {
  std::vector<int> found(kDdgiLightTexels);
  double sum = 0;
  for (uint i = 0; i < 200000; ++i) ++found[ddgi_texel_about(lattice_point(i, 200000), kDdgiLightSide)];
  for (uint texel = 0; texel < kDdgiLightTexels; ++texel) {
    const double angle = static_cast<double>(ddgi_texel_angle(texel, kDdgiLightSide));
    sum += angle;
    EXPECT_NEAR(found[texel] / 200000.0 * 4 * kDdgiPi, angle, 0.12 * angle) << texel;
    EXPECT_EQ(ddgi_texel_about(ddgi_direction(texel, kDdgiLightSide), kDdgiLightSide), texel);
  }
  EXPECT_NEAR(sum, 4 * kDdgiPi, 0.02 * 4 * kDdgiPi);
}

// Directions that are drawn by the cells' weights against the density that is told of them, by the chi-squared of bins
// of the sphere's own (not of the cells): the density's integral over each is counted over a lattice.
TEST(DdgiCells, DirectionsAreDrawnByTheirDensity) {
  Rng rng(7);
  std::array<double, kDdgiCells> weight{};
  double all = 0;
  for (double& w : weight) all += w = static_cast<double>(rng.uniform()) + 0.1;
  constexpr int kSide = 6;
  std::vector<double> expected(kSide * kSide), seen(kSide * kSide);
  constexpr uint kPoints = 400000, kDraws = 200000;
  for (uint i = 0; i < kPoints; ++i) {
    const vec3 d = lattice_point(i, kPoints);
    if (d.z > 0)
      expected[ddgi_texel_about(d, kSide)] += weight[ddgi_cosine_cell(d)] / all * kDdgiCells *
                                              static_cast<double>(d.z) / kDdgiPi * (4 * kDdgiPi / kPoints) * kDraws;
  }
  for (uint i = 0; i < kDraws; ++i) {
    double pick = static_cast<double>(rng.uniform()) * all;
    uint cell = 0;
    while (cell + 1 < kDdgiCells && pick >= weight[cell]) pick -= weight[cell++];
    const vec3 d = sample_cosine_hemisphere(ddgi_cell_place(cell, {rng.uniform(), rng.uniform()}));
    ++seen[ddgi_texel_about(d, kSide)];
  }
  double chi = 0, total = 0;
  int bins = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    total += expected[i];
    if (expected[i] < 50) {
      EXPECT_LT(seen[i], 120) << "nothing is drawn where no density is";
      continue;
    }
    chi += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i];
    ++bins;
  }
  EXPECT_NEAR(total / kDraws, 1, 0.002);
  EXPECT_GE(bins, 12);
  // Mean bins - 1, variance twice that: five of its deviations.
  EXPECT_LT(chi, bins - 1 + 5 * std::sqrt(2.0 * (bins - 1)));
}

// A path that a matte surface scattered straight back to where it came from, as far, has a footprint of a quarter of
// what the camera sees: beyond c = 0.2, while a mirror's stays within.
TEST(DdgiEnds, MattePathsEndAndMirroredPathsGoOn) {
  const float distance = 100, seen = ddgi_seen_area(distance, 1);
  const float matte = ddgi_spread(distance, static_cast<float>(1 / kDdgiPi), 1),
              mirror = ddgi_spread(distance, 1e6f, 1);
  EXPECT_NEAR(matte * matte / seen, 0.25f, 1e-4f);
  EXPECT_LT(mirror * mirror / seen, 1e-5f);
  EXPECT_EQ(ddgi_spread(distance, 0, 1), 0);
}

// Ways across a door, along it, past it, that end before it, and that touch it from outside as its own surface's do.
TEST(DdgiDoors, AWayThroughABoxIsShut) {
  const vec3 low(-4, -24, 0), high(4, 24, 96);
  EXPECT_TRUE(ddgi_is_shut({-40, 0, 40}, {40, 0, 40}, low, high));
  EXPECT_TRUE(ddgi_is_shut({-40, 10, 90}, {40, -20, 20}, low, high));
  EXPECT_TRUE(ddgi_is_shut({-40, 0, 40}, {0, 0, 40}, low, high)) << "to a probe within";
  EXPECT_FALSE(ddgi_is_shut({-40, 0, 40}, {-6, 0, 40}, low, high));
  EXPECT_FALSE(ddgi_is_shut({-40, 30, 40}, {40, 30, 40}, low, high));
  EXPECT_FALSE(ddgi_is_shut({-40, 0, 100}, {40, 0, 97}, low, high));
  EXPECT_FALSE(ddgi_is_shut({-4, 0, 40}, {-60, 0, 40}, low, high));
  EXPECT_FALSE(ddgi_is_shut({-4, -20, 40}, {-4, 20, 40}, low, high)) << "along its side";
  EXPECT_TRUE(ddgi_is_shut({0, 0, -10}, {0, 0, 200}, low, high));
}

TEST(DdgiLamps, LightFallsOffByTheSquareOfTheWholeWay) {
  EXPECT_FLOAT_EQ(ddgi_attenuation(30, 0), 1);
  EXPECT_FLOAT_EQ(ddgi_attenuation(30, 30), 0.25f);
  EXPECT_FLOAT_EQ(ddgi_attenuation(0, 0), 0);
}

}  // namespace
}  // namespace fb::shared
