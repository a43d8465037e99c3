// What tests of fog share: their fixture, and the terms of their quadratures.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "render/test_device.h"
#include "render/test_image.h"
#include "scene/in_code/scenes_in_code.h"
#include "shared/test_quadrature.h"

namespace fb::render {

constexpr double kHalfTurn = 3.14159265358979323846;

class FogTest : public DeviceTest {
 protected:
  static RenderSettings settings(std::string_view estimator, int spp, int bounces = 1, int fog_bounces = 1) {
    RenderSettings s;
    s.estimator = estimator;
    s.spp = spp;
    s.bounces = bounces;
    s.medium_bounces = fog_bounces;
    s.jitter = 0;
    return s;
  }
  // Walls 29,440 units away on all sides.
  static scene::FrameSnapshot wide_furnace() {
    scene::FrameSnapshot snapshot = scene::furnace(0.6f, 0.7f);
    for (scene::Instance& instance : snapshot.instances)
      for (int axis = 0; axis < 3; ++axis) {
        instance.transform[axis] *= 230.0f;
        instance.prev_transform[axis] *= 230.0f;
      }
    return snapshot;
  }
  static void draw(Renderer& renderer, const scene::FrameSnapshot& snapshot, const RenderSettings& s, int frames) {
    for (int i = 0; i < frames; ++i) renderer.render(snapshot, nullptr, s);
  }
  static void expect_finite(const Renderer& renderer, const std::string& what) {
    EXPECT_EQ(renderer.read().counters().not_finite, 0u) << what;
    EXPECT_EQ(renderer.read().counters().states_not_finite, 0u) << what;
    for (const vec4& p : renderer.read().linear())
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && p.x >= 0.0f) << what;
  }
};

// Mean of the red channel over columns of a picture, and its standard error by the spread over frames.
inline ImageEstimate columns_estimate(const Renderer& renderer, std::uint32_t width, std::uint32_t from,
                                      std::uint32_t to) {
  const std::vector<vec4> mean = renderer.read().linear(), variance = renderer.read().variance_of_mean();
  double sum = 0, sum_variance = 0, n = 0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    if (i % width < from || i % width >= to) continue;
    sum += static_cast<double>(mean[i].x);
    sum_variance += static_cast<double>(variance[i].x);
    n += 1;
  }
  return {sum / n, std::sqrt(sum_variance) / n};
}

inline double left_of_light(double sigma, double distance) { return std::exp(-sigma * distance); }
// Draine's phase function as it is printed (shared/phase.h), in doubles; alpha 0 is Henyey and Greenstein's.
struct Lobe {
  double g, alpha;
};
inline double draine(const Lobe& lobe, double cosine) {
  const auto [g, alpha] = lobe;
  return (1 - g * g) * (1 + alpha * cosine * cosine) /
         (4 * kHalfTurn * (1 + alpha * (1 + 2 * g * g) / 3) * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}
inline double integral(double low, double high, int panels, const auto& f) {
  return static_cast<double>(shared::integrate(
      [&](long double x) { return static_cast<long double>(f(static_cast<double>(x))); }, low, high, panels));
}

}  // namespace fb::render
