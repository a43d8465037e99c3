// Progressive spatio-temporal filtering: the control variate's integral and form, what it is fitted to, its factor, and
// how cells blend.
#include "estimators/pstf/pstf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/rng.h"
#include "shared/bsdf.h"
#include "shared/fixed_point.h"
#include "shared/test_quadrature.h"

namespace fb::shared {
namespace {

using Real = long double;
constexpr Real kPi = 3.141592653589793238L;

vec3 unit_direction(Rng& rng) {
  const float z = rng.uniform(-1, 1), phi = rng.uniform(0, 6.2831853f), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

// Integral over the sphere of f(direction), the hemisphere about n by itself: the cosine has its edge there.
template <typename F>
Real over_sphere(const vec3& n, F f) {
  const vec3 t = normalize(cross(n, std::abs(n.x) < 0.5f ? vec3(1, 0, 0) : vec3(0, 1, 0))), b = cross(n, t);
  const auto half = [&](Real sign) {
    return integrate(
        [&](Real z) {
          return integrate(
              [&](Real phi) {
                const Real r = std::sqrt(std::max(1 - z * z, Real{0}));
                const auto x = static_cast<float>(r * std::cos(phi)), y = static_cast<float>(r * std::sin(phi));
                return f(t * x + b * y + n * static_cast<float>(sign * z));
              },
              0, 2 * kPi, 8);
        },
        0, 1, 8);
  };
  return half(1) + half(-1);
}
Real lambert_at(const LinearLight& l, const vec3& n, const vec3& w) {
  return static_cast<Real>(max(dot(n, w), 0.0f)) / kPi * static_cast<Real>(linear_at(l, w));
}

TEST(Pstf, TheControlVariatesIntegralIsExact) {
  Rng rng(5);
  for (int i = 0; i < 24; ++i) {
    const vec3 n = unit_direction(rng), b = unit_direction(rng) * rng.uniform(0, 8);
    const LinearLight l{rng.uniform(-3, 3), b};
    const Real sum = over_sphere(n, [&](const vec3& w) { return lambert_at(l, n, w); });
    EXPECT_NEAR(sum, linear_integral(l, n), 3e-6L * (1 + std::abs(static_cast<Real>(l.a)) + 8)) << i;
  }
}

// Over all directions that may be drawn: with any density the right form's mean is the integral of g, with any h and
// factor. As Eq. 24 is printed, beta I is added as often as the domain is large.
TEST(Pstf, EquationTwentyFourAsPrintedIsBiased) {
  Rng rng(6);
  const vec3 n = normalize(vec3(1, 2, 2));
  const auto light = [](const vec3& w) { return 1 + std::pow(static_cast<Real>(std::max(w.z, 0.0f)), 4); };
  const auto g = [&](const vec3& w) { return static_cast<Real>(0.7f * max(dot(n, w), 0.0f)) / kPi * light(w); };
  const Real truth = over_sphere(n, g);
  for (const float beta : {0.5f, 1.0f, 2.0f}) {
    const LinearLight l{rng.uniform(-1, 2), unit_direction(rng)};
    const Real known = static_cast<Real>(beta * linear_integral(l, n));
    const auto density = [&](const vec3& w) { return (1 + static_cast<Real>(dot(n, w)) / 2) / (4 * kPi); };
    const auto rest = [&](const vec3& w) {
      return (g(w) - static_cast<Real>(beta) * lambert_at(l, n, w)) / density(w);
    };
    const Real right = over_sphere(n, [&](const vec3& w) { return density(w) * (rest(w) + known); });
    const Real printed = over_sphere(n, [&](const vec3& w) { return density(w) * (rest(w) + known / density(w)); });
    EXPECT_NEAR(right, truth, 1e-5L);
    EXPECT_NEAR(printed, truth + (4 * kPi - 1) * known, 1e-5L * (1 + std::abs(printed)));
  }
}

// Moments of light under the cosine's density, as a cell keeps them.
struct Moments {
  float mean = 0;
  vec3 first{0};
};
template <typename F>
Moments moments_of(const vec3& n, F light) {
  Moments m;
  m.mean = static_cast<float>(
      over_sphere(n, [&](const vec3& w) { return static_cast<Real>(max(dot(n, w), 0.0f)) / kPi * light(w); }));
  for (int axis = 0; axis < 3; ++axis)
    m.first[axis] = static_cast<float>(over_sphere(
        n, [&](const vec3& w) { return static_cast<Real>(max(dot(n, w), 0.0f) * w[axis]) / kPi * light(w); }));
  return m;
}

TEST(Pstf, LinearLightIsFittedExactly) {
  Rng rng(8);
  for (int i = 0; i < 12; ++i) {
    const vec3 n = unit_direction(rng), b = unit_direction(rng) * 0.8f;
    const Moments m = moments_of(n, [&](const vec3& w) { return static_cast<Real>(1.5f + dot(b, w)); });
    const LinearLight l = fitted_light(m.mean, m.first, n);
    EXPECT_NEAR(linear_integral(l, n), 1, 1e-5);
    EXPECT_NEAR(l.a * m.mean, 1.5f, 1e-3f);
    EXPECT_LT(length(l.b * m.mean - b), 1e-3f);
  }
}

// No other slope leaves less of the variance.
TEST(Pstf, TheFitIsOfLeastSquares) {
  const vec3 n(0, 0, 1), up = normalize(vec3(2, 1, 1));
  const auto light = [&](const vec3& w) { return std::pow(static_cast<Real>(std::max(dot(up, w), 0.0f)), 3); };
  const Moments m = moments_of(n, light);
  const auto left = [&](const LinearLight& l) {
    return over_sphere(n, [&](const vec3& w) {
      const Real off = light(w) - static_cast<Real>(m.mean * linear_at(l, w));
      return static_cast<Real>(max(w.z, 0.0f)) / kPi * off * off;
    });
  };
  const LinearLight fitted = fitted_light(m.mean, m.first, n);
  const Real least = left(fitted), without = left(LinearLight{1, vec3(0)});
  EXPECT_LT(least, 0.5L * without);
  Rng rng(9);
  for (int i = 0; i < 12; ++i) {
    LinearLight other = fitted;
    other.b += unit_direction(rng) * 0.3f;
    other.a = 1 - 2.0f / 3 * dot(other.b, n);
    EXPECT_GT(left(other), least);
  }
}

TEST(Pstf, NoLightAndLightFromOnePointHaveBoundedSlopes) {
  EXPECT_EQ(linear_integral(fitted_light(0, vec3(0), vec3(0, 0, 1)), vec3(0, 0, 1)), 1);
  EXPECT_EQ(fitted_light(-1, vec3(9), vec3(0, 0, 1)).b, vec3(0));
  for (const vec3& from : {vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, 0, -1), vec3(0, 100, 0)}) {
    const LinearLight l = fitted_light(2, from * 2.0f, vec3(0, 0, 1));
    EXPECT_LE(length(l.b), kMostSlope * 1.00001f);
    EXPECT_NEAR(linear_integral(l, vec3(0, 0, 1)), 1, 1e-5);
  }
}

TEST(Pstf, OutgoingLightByTheNormal) {
  // One normal: the mean there, whatever it is. As printed it would be a quarter of 1 + 3 cos.
  EXPECT_NEAR(light_of_normal(5, vec3(0, 0, 5), vec3(0, 0, 1), vec3(0, 0, 1)), 5, 1e-5);
  // A normal that no sample had, and turns away from all: the mean.
  EXPECT_EQ(light_of_normal(5, vec3(0, 0, 5), vec3(0, 0, 1), vec3(0, 0, -1)), 5);
  // Normals all about, light from above: more of it above.
  Rng rng(2);
  float mean = 0;
  vec3 first(0), normals(0);
  constexpr int kSamples = 100000;
  for (int i = 0; i < kSamples; ++i) {
    const vec3 n = unit_direction(rng);
    const float light = 1 + n.z;
    mean += light / kSamples;
    first += n * (light / kSamples);
    normals += n * (1.0f / kSamples);
  }
  for (const float z : {-1.0f, -0.5f, 0.0f, 0.5f, 1.0f})
    EXPECT_NEAR(light_of_normal(mean, first, normals, vec3(std::sqrt(1 - z * z), 0, z)), 1 + z, 0.03f) << z;
  EXPECT_EQ(light_of_normal(0, vec3(0), vec3(0), vec3(0, 0, 1)), 0);
}

TEST(Pstf, ColoursGoThereAndBack) {
  Rng rng(3);
  for (int i = 0; i < 100; ++i) {
    const vec3 c(rng.uniform(0, 9), rng.uniform(0, 9), rng.uniform(0, 9));
    EXPECT_LT(length(rgb_from_ycocg(ycocg_from_rgb(c)) - c), 1e-5f);
  }
  EXPECT_EQ(ycocg_from_rgb(vec3(2)), vec3(2, 0, 0));
}

TEST(Pstf, FramesBlend) {
  EXPECT_EQ(pstf_blend(1, 0, 64), 1);
  EXPECT_EQ(pstf_blend(0, 5, 64), 0);
  EXPECT_FLOAT_EQ(pstf_blend(4, 12, 64), 0.5f);
  EXPECT_FLOAT_EQ(pstf_blend(1, 1e6f, 64), 1.0f / 64);
  EXPECT_FLOAT_EQ(pstf_blend(1e6f, 1e6f, 64), std::sqrt(0.5f));
  // No window: the square root of one over the frame's number, a memory of frames that grows with the root.
  float value = 0, before = 0;
  for (int frame = 1; frame <= 100; ++frame) {
    const float w = pstf_blend(3, before, 1e6f);
    EXPECT_NEAR(w, 1 / std::sqrt(static_cast<float>(frame)), 1e-4f);
    value = mix(value, frame <= 50 ? 1.0f : 3.0f, w);
    before += 3;
  }
  EXPECT_NEAR(value, 3, 0.02f);
}

TEST(Pstf, BetaIsCovarianceOverVarianceAndNoneWhereNothingIsKnown) {
  EXPECT_EQ(learnt_beta({1, 1, 1, 0}), 0);
  EXPECT_EQ(learnt_beta({1, 1, 1, 15}), 0);
  EXPECT_EQ(learnt_beta({0, 0, 1, 1e6f}), 0);
  EXPECT_EQ(learnt_beta({-1, 1, 1, 1e6f}), 0);
  EXPECT_NEAR(learnt_beta({0.8f, 1, 1, 1e6f}), 0.8f, 2e-3f);
  EXPECT_NEAR(learnt_beta({0.8f, 1, 1, 100}), 0.7f, 1e-5f);
  EXPECT_EQ(learnt_beta({9, 1, 100, 1e6f}), kMostBeta);
}

// Of a control variate that has nothing to do with the light, and one that has much: what it adds to the variance.
TEST(Pstf, ALearntFactorAddsLittleVariance) {
  Rng rng(12);
  for (const int count : {16, 64, 1000}) {
    for (const double related : {0.0, 0.6}) {
      int over_a_tenth = 0;
      double added = 0;
      constexpr int kRuns = 2000;
      for (int run = 0; run < kRuns; ++run) {
        ControlMoments m{0, 0, 0, static_cast<float>(count)};
        for (int i = 0; i < count; ++i) {
          const double h = rng.uniform(-1.7320508f, 1.7320508f), noise = rng.uniform(-1.7320508f, 1.7320508f);
          const double g = related * h + std::sqrt(1 - related * related) * noise;
          m.gh += static_cast<float>(g * h / count);
          m.hh += static_cast<float>(h * h / count);
          m.gg += static_cast<float>(g * g / count);
        }
        const double beta = static_cast<double>(learnt_beta(m)), change = beta * beta - 2 * beta * related;
        added += change / kRuns;
        over_a_tenth += change > 0.1 ? 1 : 0;
      }
      EXPECT_LT(over_a_tenth, kRuns / 50) << count << ' ' << related;
      EXPECT_LT(added, related > 0 ? -0.2 : 0.02) << count;
    }
  }
}

TEST(Pstf, MomentsJoin) {
  ControlMoments m{0, 0, 0, 0};
  m = joined_moments(m, {2, 4, 8, 10});
  EXPECT_EQ(m.gh, 2);
  EXPECT_EQ(m.samples, 10);
  m = joined_moments(m, {0, 0, 0, 0});
  EXPECT_EQ(m.samples, 10);
  m = joined_moments(m, {4, 6, 10, 30});
  EXPECT_FLOAT_EQ(m.gh, 3.5f);
  EXPECT_FLOAT_EQ(m.samples, 40);
  for (int frame = 0; frame < 2000; ++frame) m = joined_moments(m, {1, 1, 1, 10});
  EXPECT_NEAR(m.samples, 10 * 127, 2) << "an exponential window of 64 frames";
  EXPECT_NEAR(m.hh, 1, 1e-4);
}

TEST(Pstf, ChangesAreSeen) {
  EXPECT_FALSE(has_changed(0, 1, 2, 100, 0)) << "never";
  EXPECT_TRUE(has_changed(0, 1, 2, 100, 6));
  EXPECT_FALSE(has_changed(0, 1, 2, 25, 6)) << "too few samples";
  EXPECT_FALSE(has_changed(1.01f, 1, 1, 1000, 6)) << "a hundredth, though nothing varies";
  EXPECT_TRUE(has_changed(1e-3f, 0, 0, 100, 6)) << "light where there was none";
}

// A sample in a frame, and more than there are: sums stay within a word as long as samples are the crowd's share.
TEST(Pstf, SumsHoldManySamples) {
  EXPECT_GE(signed_room(kPstfLargest, kPstfSteps), 4096u);
  EXPECT_GE(signed_room(kPstfMomentLargest, kPstfMomentSteps), 4096u);
}

TEST(Pstf, DirectionsHaveParts) {
  Rng rng(4);
  for (const int parts : {1, 3, 8}) {
    std::set<uint> seen;
    for (int i = 0; i < 20000; ++i) seen.insert(direction_part(unit_direction(rng), parts));
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(parts * parts));
    EXPECT_LT(*seen.rbegin(), static_cast<uint>(parts * parts));
  }
  EXPECT_EQ(direction_part(vec3(0, 0, 0), 8), direction_part(vec3(0, 0, 1), 8));
  EXPECT_LT(direction_part(normalize(vec3(1, 1, 1)), 8), 64u);
}

}  // namespace
}  // namespace fb::shared
