// A glowing room full of fog, against a quadrature of what its walls send through it: every unbiased estimator by the
// number of its rays, and mcpg_tail, whose cache stands for all reflections.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "render/techniques/test_techniques.h"
#include "render/test_fog.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

using glm::dvec3;
using FogFurnaceStatistics = FogTest;

// scene::furnace of albedo and emission about a medium, seen by one ray along x.
struct FoggyFurnace {
  double sigma, g, scattered, albedo, emission;
  static constexpr double kHalf = 128;
  static constexpr int kCells = 32;
  std::vector<double> table{};  // of wall_light, over a quarter of a wall; light that was reflected so often

  static double to_wall(const dvec3& from, const dvec3& direction) {
    double t = 1e30;
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(direction[axis]) > 1e-12)
        t = std::min(t, ((direction[axis] > 0 ? kHalf : -kHalf) - from[axis]) / direction[axis]);
    return std::max(t, 0.0);
  }
  // Integral over directions about the x axis of weight(cosine) times the light that comes from there, of paths that
  // leave a wall by emission or, with `reflected`, by one reflection before.
  double gathered(const dvec3& at, double least_cosine, int panels, bool reflected, const auto& weight) const {
    return integral(least_cosine, 1, panels, [&](double c) {
      const double s = std::sqrt(1 - c * c);
      return weight(c) * integral(0, 2 * kHalfTurn, 2 * panels, [&](double phi) {
               const dvec3 w(c, s * std::cos(phi), s * std::sin(phi));
               const double t = to_wall(at, w);
               return left_of_light(sigma, t) * (emission + (reflected ? albedo * wall_light(at + w * t) : 0.0));
             });
    });
  }
  // Irradiance over pi at a point of a wall, y and z of one where x is -128.
  double irradiance(double y, double z, bool reflected, int panels) const {
    return gathered({-kHalf, y, z}, 0, panels, reflected, [](double c) { return c / kHalfTurn; });
  }
  void tabulate(int reflections = 1) {
    for (int n = 0; n < reflections; ++n) {
      std::vector<double> next;
      for (int i = 0; i <= kCells; ++i)
        for (int j = 0; j <= kCells; ++j) next.push_back(irradiance(kHalf * i / kCells, kHalf * j / kCells, n > 0, 8));
      table = std::move(next);
    }
  }
  double wall_light(const dvec3& p) const {
    const dvec3 d = glm::abs(p) * (kCells / kHalf);
    const int wall = d.x > d.y ? (d.x > d.z ? 0 : 2) : (d.y > d.z ? 1 : 2);
    const double u = d[(wall + 1) % 3], v = d[(wall + 2) % 3];
    const int i = std::min(static_cast<int>(u), kCells - 1), j = std::min(static_cast<int>(v), kCells - 1);
    const auto at = [&](int k, int l) { return table[static_cast<std::size_t>(k * (kCells + 1) + l)]; };
    return glm::mix(glm::mix(at(i, j), at(i + 1, j), u - i), glm::mix(at(i, j + 1), at(i + 1, j + 1), u - i), v - j);
  }
  // What a ray from `eye` along x brings.
  double radiance(const dvec3& eye, int bounces, int fog_bounces) const {
    const double reach = kHalf - eye.x;
    const double surface = emission + albedo * irradiance(eye.y, eye.z, bounces > 1, 16);
    const double in_fog = integral(0, reach, 4, [&](double t) {
      return sigma * left_of_light(sigma, t) * gathered(eye + dvec3(t, 0, 0), -1, 16, fog_bounces > 1, [&](double c) {
               return draine({g, 0}, c);
             });
    });
    return left_of_light(sigma, reach) * surface + scattered * in_fog;
  }
};

// That room, of albedo 0.6 and emission 0.7, with a camera that looks along x by a ray's width.
scene::FrameSnapshot foggy_furnace() {
  scene::FrameSnapshot snapshot = scene::furnace(0.6f, 0.7f);
  snapshot.camera.position = {-40, 30, 10};
  snapshot.camera.fov_x = 1;
  snapshot.prev_camera = snapshot.camera;
  snapshot.medium.extinction = 0.006f;
  snapshot.medium.albedo = vec3(0.8f);
  snapshot.medium.g = 0.5f;
  return snapshot;
}

// T(d) (e + a E) + albedo * integral of sigma T(s) * (mean over directions, weighted by the phase function, of what
// comes from the walls), where E is a wall's irradiance over pi. Paths of the surface have r_bounces reflections, those
// of the fog r_fog_bounces rays, and neither scatters a second time.
TEST_F(FogFurnaceStatistics, AGlowingRoomFullOfItHasItsQuadrature) {
  FoggyFurnace room{0.006, 0.5, 0.8, 0.6, 0.7};
  room.tabulate();
  const scene::FrameSnapshot snapshot = foggy_furnace();
  std::vector<std::pair<std::pair<int, int>, double>> rows;
  for (const auto& [bounces, fog_bounces] : {std::pair(1, 1), std::pair(2, 1), std::pair(1, 2), std::pair(2, 2)})
    rows.push_back({{bounces, fog_bounces}, room.radiance({-40, 30, 10}, bounces, fog_bounces)});
  for (const std::string& estimator : one_of_each_family(Whose::kUnbiased)) {
    auto renderer = make_renderer(settings(estimator, 128), 16, 12);
    for (const auto& [rays, expected] : rows) {
      // Steps know nothing of the other kind's number of rays: both together are enough but for one estimator.
      if (estimator != "nee" && rays.first != rays.second) continue;
      const RenderSettings s = settings(estimator, 128, rays.first, rays.second);
      const std::string what = fmt::format("{}, r_bounces {}, r_fog_bounces {}", estimator, rays.first, rays.second);
      draw(*renderer, snapshot, s, 8);
      const ImageEstimate e = columns_estimate(*renderer, 16, 0, 16);
      // 3e-4: the panels' and the table's error, and half a degree to either side.
      EXPECT_NEAR(e.mean, expected, 4.5 * e.error + 3e-4 * expected) << what;
      EXPECT_LT(e.error, 3e-3 * expected) << what << ": the test can see little";
      fmt::print("{}: {:.5f}, quadrature {:.5f}: {:+.3f}% +- {:.3f}%\n", what, e.mean, expected,
                 100 * (e.mean / expected - 1), 100 * e.error / expected);
      expect_finite(*renderer, what);
    }
  }
}

// mcpg_tail: whatever r_fog_bounces says, the cache of the wall that a path from the fog meets stands for all that this
// wall reflects, as it does for a surface's paths. Biased, so held to a share of the whole,
// path_tail_statistics_test's: a wall of which nothing is known is thought to be lit like the fog that sees it, from
// all sides. The fog's own tail is 9%, what all walls reflect a second time and on 3%.
TEST_F(FogFurnaceStatistics, PathsFromItThatEndInTheCacheHaveAllReflections) {
  const dvec3 eye(-40, 30, 10);
  FoggyFurnace all{0.006, 0.5, 0.8, 0.6, 0.7}, once = all;
  all.tabulate(8);  // a wall gives back less than a fifth of what reaches it
  once.tabulate();
  const double expected = all.radiance(eye, 2, 2), tail = expected - all.radiance(eye, 2, 1);
  constexpr double kTolerance = 0.02;
  ASSERT_GT(tail, 4 * kTolerance * expected);
  ASSERT_GT(expected - once.radiance(eye, 2, 2), kTolerance * expected) << "of the second reflection and on";
  const scene::FrameSnapshot snapshot = foggy_furnace();
  for (const int fog_bounces : {1, 2}) {
    RenderSettings s = settings("mcpg_tail", 4, 2, fog_bounces);
    s.deterministic = 1;
    auto renderer = make_renderer(s, 48, 32);
    draw(*renderer, snapshot, s, 100);
    renderer->restart_accumulation();
    draw(*renderer, snapshot, s, 16);
    const ImageEstimate e = columns_estimate(*renderer, 48, 0, 48);
    EXPECT_NEAR(e.mean, expected, kTolerance * expected) << fog_bounces;
    EXPECT_LT(4.5 * e.error, 0.25 * kTolerance * expected) << "the test can see little";
    fmt::print(
        "mcpg_tail, r_fog_bounces {}: {:.5f}, all reflections {:.5f}: {:+.3f}% +- {:.3f}%; tail in fog {:.3f}%\n",
        fog_bounces, e.mean, expected, 100 * (e.mean / expected - 1), 100 * e.error / expected, 100 * tail / expected);
    expect_finite(*renderer, "mcpg_tail");
  }
}

}  // namespace
}  // namespace fb::render
