// estimators/mcpg/guide.h: what packing keeps, updates against the same recurrence in long double (which carries a
// bound of the error that float may have), and whatever is fed to it, finite states within their limits.
#include "estimators/mcpg/guide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/rng.h"

namespace fb::shared {
namespace {

using Real = long double;
constexpr Real kEpsilon = 0x1p-24L;  // relative rounding error of one operation

GuideState some_state() { return GuideState{vec3(10, -20, 30), 2.0f, 0.01f, 7, 0x1235, 99, vec3(0), 0.25f}; }
GuideState repacked(const GuideState& s) {
  return add_guide_motion(unpack_guide_state(pack_guide_state(s)), pack_guide_motion(s));
}

// --- packing ---

TEST(GuidePacking, CoordinatesAreKeptToHalfAStep) {
  Rng rng(1);
  const float special[] = {0, 1e-20f, -1e-20f, 30000, -30000, 0x1p-6f, kTargetLimit, -kTargetLimit};
  for (int i = 0; i < 100000; ++i) {
    GuideState s = some_state();
    for (int axis = 0; axis < 3; ++axis) {
      s.target[axis] = i < 1000 ? special[rng.below(8)] : rng.uniform(-kTargetLimit, kTargetLimit);
    }
    const GuideState back = repacked(s);
    for (int axis = 0; axis < 3; ++axis) {
      // x + 32768 is rounded to 2^-8 before.
      ASSERT_NEAR(back.target[axis], s.target[axis], 0x1p-6f + 0x1p-9f) << axis;
      ASSERT_EQ(repacked(back).target[axis], back.target[axis]) << "packing again moves nothing";
    }
    ASSERT_EQ(back.check, s.check);
    ASSERT_EQ(back.count, s.count);
  }
}

TEST(GuidePacking, CoordinatesBeyondTheWorldStopAtItsBorder) {
  for (const float far : {32768.0f, 1e9f, std::numeric_limits<float>::infinity()}) {
    EXPECT_EQ(unpack_guide_coordinate(pack_guide_coordinate(far)), kTargetLimit);
    EXPECT_EQ(unpack_guide_coordinate(pack_guide_coordinate(-far)), -kTargetLimit);
  }
  EXPECT_LT(pack_guide_coordinate(kTargetLimit), 1u << 21u);
}

TEST(GuidePacking, WeightsAreKeptToAStepOfTheirLogarithm) {
  Rng rng(2);
  const double step = std::exp2(0.5 / static_cast<double>(kWeightSteps)) - 1 + 1e-5;
  for (int i = 0; i < 100000; ++i) {
    const float w = std::exp2(rng.uniform(-40, 56));
    const float back = unpack_guide_weight(pack_guide_weight(w));
    ASSERT_NEAR(static_cast<double>(back / w), 1, step) << w;
    ASSERT_EQ(pack_guide_weight(back), pack_guide_weight(w));
  }
  uint before = 0;
  for (float w = 1e-38f; w < 1e38f; w *= 1.01f) {
    ASSERT_GE(pack_guide_weight(w), before) << "in order";
    before = pack_guide_weight(w);
  }
}

TEST(GuidePacking, NoWeightIsNoStateAndEveryWeightIsOne) {
  EXPECT_EQ(unpack_guide_weight(pack_guide_weight(0)), 0);
  EXPECT_EQ(unpack_guide_weight(pack_guide_weight(-1)), 0);
  EXPECT_EQ(unpack_guide_weight(pack_guide_weight(std::numeric_limits<float>::quiet_NaN())), 0);
  for (const float w :
       {1e-38f, 1e-30f, 1e30f, std::numeric_limits<float>::max(), std::numeric_limits<float>::infinity()}) {
    EXPECT_GT(unpack_guide_weight(pack_guide_weight(w)), 0) << w;
    EXPECT_LT(unpack_guide_weight(pack_guide_weight(w)), 1e17f) << w;
  }
}

TEST(GuidePacking, SpreadsKeepElevenBitsOfTheirRoot) {
  Rng rng(3);
  for (int i = 0; i < 100000; ++i) {
    GuideState s = some_state();
    s.spread = std::exp(rng.uniform(-30, 22));  // 1e-13 to 3.6e9, 60,000 units squared
    const float root = std::sqrt(s.spread), back = std::sqrt(repacked(s).spread);
    // Halves below 2^-14 have steps of 2^-24. GLM rounds them; a device may cut them.
    ASSERT_NEAR(back, root, std::max(root * 0x1p-10f, 0x1p-24f)) << s.spread;
  }
  for (const float exact : {0.0f, 1.0f}) {
    GuideState s = some_state();
    s.spread = exact;
    EXPECT_EQ(repacked(s).spread, exact);
  }
  for (const float huge : {1e11f, 1e30f, std::numeric_limits<float>::infinity()}) {
    GuideState s = some_state();
    s.spread = huge;
    EXPECT_EQ(repacked(s).spread, 3.6e9f);
  }
}

TEST(GuidePacking, CountsAndSharesStopAtTheirEnds) {
  GuideState s = some_state();
  for (const uint count : {0u, 1u, 254u, 255u, 256u, 100000u}) {
    s.count = count;
    EXPECT_EQ(repacked(s).count, std::min(count, 255u));
  }
  for (const float share : {-1.0f, 0.0f, 0.3f, 1.0f, 1.0001f, 7.0f}) {
    s.emissive = share;
    EXPECT_NEAR(repacked(s).emissive, std::clamp(share, 0.0f, 1.0f), 0.5f / 255 + 1e-6f);
    EXPECT_EQ(repacked(s).check, some_state().check) << "no bit falls into a neighbour";
  }
  s.check = 0xffff;
  EXPECT_EQ(repacked(s).check, 0xffffu);
}

TEST(GuidePacking, MotionIsKeptAndSaidToBeThere) {
  Rng rng(4);
  EXPECT_FALSE(guide_state_moves(pack_guide_state(some_state())));
  for (int i = 0; i < 10000; ++i) {
    GuideState s = some_state();
    s.time = rng.next() & 0xffffu;
    for (int axis = 0; axis < 3; ++axis) s.velocity[axis] = rng.uniform(-1, 1) * std::exp(rng.uniform(-7, 11));
    ASSERT_TRUE(guide_state_moves(pack_guide_state(s)));
    const GuideState back = repacked(s);
    ASSERT_EQ(back.time, s.time);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_NEAR(back.velocity[axis], s.velocity[axis], std::max(std::abs(s.velocity[axis]) * 0x1p-10f, 0x1p-24f));
    }
    ASSERT_EQ(back.target, some_state().target);
  }
  GuideState s = some_state();
  s.velocity = vec3(1e9f, -1e9f, 60001);
  EXPECT_EQ(repacked(s).velocity, vec3(60000, -60000, 60000));
}

TEST(GuidePacking, AnyBitsAreAFiniteState) {  // as of a state that is read while it is written
  Rng rng(5);
  for (int i = 0; i < 100000; ++i) {
    // Every word is one that some state has; together they are none that was stored.
    uvec4 words;
    for (int w = 0; w < 4; ++w) {
      GuideState s = some_state();
      s.target = vec3(rng.uniform(-33000, 33000), rng.uniform(-33000, 33000), rng.uniform(-33000, 33000));
      s.weight = std::exp(rng.uniform(-60, 60));
      s.spread = std::exp(rng.uniform(-60, 60));
      s.count = rng.next() & 0x1ffu;
      words[w] = pack_guide_state(s)[w];
    }
    const GuideState s = unpack_guide_state(words);
    ASSERT_TRUE(std::isfinite(dot(s.target, s.target)));
    ASSERT_TRUE(std::isfinite(s.weight) && std::isfinite(s.spread) && s.weight >= 0 && s.spread >= 0);
  }
}

// --- updates ---

struct Vector {
  Real x = 0, y = 0, z = 0;
};
Vector vector(const vec3& v) { return {v.x, v.y, v.z}; }
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator*(const Vector& a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
Real length(const Vector& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

// The recurrence of update_guide_state (Alber 2025, Alg. 3), and how far off float32 may be by first-order analysis.
struct Reference {
  Vector target;
  Real weight = 0, spread = 0, emissive = 0, target_error = 0, spread_error = 0;
  Real samples = 0;

  void update(const vec3& position, const vec3& hit, float score, float share_emitted, float alpha_min, float count_max,
              bool in_world) {
    const Vector p = vector(position), h = vector(hit), before = target - p, now = h - p;
    samples = std::min(samples + 1, std::min(static_cast<Real>(count_max), 255.0L));
    const Real alpha = std::max(1 / samples, static_cast<Real>(alpha_min));
    const Real kept = weight * (1 - alpha), added = static_cast<Real>(score) * alpha;
    weight = kept + added;
    if (added == 0) return;
    const Real share = added / weight, share_error = weight_error(alpha_min);
    const Real a = length(before), b = length(now), size = length(p) + length(h);
    Real term = spread, term_error = 0;
    if (kept == 0) {
      term = 0;
    } else if (a > 0 && b > 0) {
      const Real chord = length(before * (1 / a) - now * (1 / b));
      const Real c = std::min(chord * chord / 2, 1.0L);
      const Real angle = target_error / a + kEpsilon * (size / a + size / b + 16);
      const Real c_error = chord * angle + angle * angle;
      term = c;
      term_error = c_error;
      if (in_world) {
        const Real rest = std::max(1 - c, 0.05L);
        term = c / rest * a * a;
        term_error = a * a * (c_error / (rest * rest) + c / rest * (2 * target_error / a + 8 * kEpsilon));
      }
    }
    spread_error += share * (term_error - spread_error) + (share_error + 4 * kEpsilon) * std::abs(term - spread) +
                    2 * kEpsilon * std::max(term, spread);
    spread += (term - spread) * share;
    target_error += -share * target_error + share_error * share * length(h - target) + 4 * kEpsilon * (size + a);
    target = target + (h - target) * share;
    emissive += (static_cast<Real>(share_emitted) - emissive) * share;
  }
  // Relative: three roundings an update, of which 1 - alpha is kept.
  static Real weight_error(float alpha_min) { return 4 * kEpsilon / static_cast<Real>(alpha_min); }
};

// What is fed to a state: points from where it is seen, hits, scores.
struct Feed {
  const char* name;
  vec3 position, centre;
  float radius;                 // of the light
  float low_score, high_score;  // uniform in the logarithm
  float zeros;                  // share of scores that are 0
};
const Feed kFeeds[] = {
    {"a lamp", vec3(0), vec3(100, 50, 20), 8, 0.1f, 10, 0},
    {"a lamp, often missed", vec3(0), vec3(100, 50, 20), 8, 0.1f, 10, 0.7f},
    {"a lamp at 30,000", vec3(29900, -30000, 29000), vec3(30000, -29990, 29100), 8, 0.1f, 10, 0.1f},
    {"across the world", vec3(-30000, -30000, -30000), vec3(30000, 30000, 30000), 300, 0.1f, 10, 0.1f},
    {"all around", vec3(5), vec3(5.5f), 50, 0.1f, 10, 0.1f},
    {"faint", vec3(0), vec3(100, 50, 20), 8, 1e-30f, 1e-29f, 0.1f},
    {"blinding", vec3(0), vec3(100, 50, 20), 8, 1e29f, 1e30f, 0.1f},
    {"faint and blinding", vec3(0), vec3(100, 50, 20), 8, 1e-30f, 1e30f, 0.1f},
};

struct Hit {
  vec3 at;
  float score;
};
Hit draw(const Feed& feed, Rng& rng) {
  Hit hit;
  for (int axis = 0; axis < 3; ++axis) hit.at[axis] = feed.centre[axis] + rng.uniform(-feed.radius, feed.radius);
  const float low = std::log(feed.low_score), high = std::log(feed.high_score);
  hit.score = rng.uniform() < feed.zeros ? 0.0f : std::exp(rng.uniform(low, high));
  return hit;
}

TEST(GuideUpdate, FollowsTheRecurrenceInLongDouble) {
  for (const Feed& feed : kFeeds) {
    for (const bool in_world : {false, true}) {
      for (const float alpha_min : {0.01f, 0.03f, 1.0f}) {
        Rng rng(6);
        GuideState s = empty_guide_state();
        Reference r;
        for (int i = 0; i < 400; ++i) {
          const Hit hit = draw(feed, rng);
          const float emissive = rng.uniform();
          s = update_guide_state(s, feed.position, hit.at, hit.score, emissive, alpha_min, 255, in_world);
          r.update(feed.position, hit.at, hit.score, emissive, alpha_min, 255, in_world);
          SCOPED_TRACE(testing::Message()
                       << feed.name << " world " << in_world << " alpha " << alpha_min << " step " << i);
          const auto near = [](float is, Real wanted, Real error) {
            return std::abs(static_cast<Real>(is) - wanted) <= error;
          };
          ASSERT_EQ(s.count, static_cast<uint>(r.samples));
          ASSERT_PRED3(near, s.weight, r.weight, r.weight * Reference::weight_error(alpha_min));
          ASSERT_LE(length(vector(s.target) - r.target), r.target_error);
          ASSERT_PRED3(near, s.spread, r.spread, r.spread_error);
          ASSERT_PRED3(near, s.emissive, r.emissive, Reference::weight_error(alpha_min) + 400 * kEpsilon);
        }
      }
    }
  }
}

// The bound of the comparison must be tight enough to mean something.
TEST(GuideUpdate, TheBoundsAreSmall) {
  for (const Feed& feed : kFeeds) {
    Rng rng(6);
    Reference r;
    for (int i = 0; i < 400; ++i) {
      const Hit hit = draw(feed, rng);
      r.update(feed.position, hit.at, hit.score, 0.5f, 0.03f, 255, false);
    }
    EXPECT_LT(r.target_error, 0.12L * static_cast<Real>(feed.radius)) << feed.name;
    EXPECT_LT(r.spread_error, 0.3L * r.spread) << feed.name;
  }
}

// Lights behind one another, at the point itself, beyond the world; scores of all sizes; packed every time, as on the
// device.
TEST(GuideUpdate, StaysFiniteAndWithinItsLimits) {
  Rng rng(7);
  const float coordinates[] = {0, 1e-30f, 1e-20f, 1e-3f, 1, 100, 30000, 32767, 60000};
  const float scores[] = {0, 1e-38f, 1e-30f, 1e-6f, 1, 1e6f, 1e17f, 1e30f};
  const auto point = [&] {
    vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = coordinates[rng.below(9)] * (rng.below(2) == 0 ? 1.0f : -1.0f);
    return p;
  };
  for (int chain = 0; chain < 3000; ++chain) {
    const bool in_world = rng.below(2) == 0, packs = rng.below(4) != 0;
    GuideState s = empty_guide_state();
    for (int i = 0; i < 60; ++i) {
      const vec3 position = rng.below(4) == 0 ? s.target : point();
      const vec3 hit = rng.below(4) == 0 ? position : point();
      s = update_guide_state(s, position, hit, scores[rng.below(8)], rng.uniform(), 0.03f, 255, in_world);
      ASSERT_TRUE(std::isfinite(s.weight) && s.weight >= 0) << s.weight;
      ASSERT_TRUE(std::isfinite(s.spread) && s.spread >= 0) << s.spread;
      ASSERT_TRUE(in_world || s.spread <= 1.0f) << s.spread;
      ASSERT_TRUE(std::isfinite(dot(s.target, s.target)));
      ASSERT_TRUE(s.emissive >= 0 && s.emissive <= 1) << s.emissive;
      ASSERT_TRUE(s.count >= 1 && s.count <= 255);
      if (packs) s = repacked(s);
    }
  }
}

TEST(GuideUpdate, TheFirstSampleIsTheStateAndAMissOnlyLowersTheWeight) {
  GuideState s = empty_guide_state();
  s = update_guide_state(s, vec3(0), vec3(7, 8, 9), 3, 0.5f, 0.03f, 255, true);
  EXPECT_EQ(s.target, vec3(7, 8, 9));
  EXPECT_EQ(s.weight, 3);
  EXPECT_EQ(s.spread, 0);
  EXPECT_EQ(s.emissive, 0.5f);
  const GuideState missed = update_guide_state(s, vec3(0), vec3(-1, 0, 0), 0, 1, 0.03f, 255, true);
  EXPECT_EQ(missed.target, s.target);
  EXPECT_EQ(missed.weight, 1.5f);
  EXPECT_EQ(missed.emissive, s.emissive);
}

TEST(GuideUpdate, CountsStopAtTheLimitAndTheMeanGoesOn) {
  GuideState s = empty_guide_state();
  for (int i = 0; i < 1000; ++i) s = repacked(update_guide_state(s, vec3(0), vec3(100, 0, 0), 1, 1, 1e-4f, 255, true));
  EXPECT_EQ(s.count, 255u);
  for (int i = 0; i < 3000; ++i) s = repacked(update_guide_state(s, vec3(0), vec3(0, 100, 0), 1, 1, 1e-4f, 255, true));
  // 1/255 of a quarter turn is more than a step of the packing, until it is nearly there.
  EXPECT_NEAR(s.target.y, 100, 255 * 0x1p-5f);
  GuideState few = empty_guide_state();
  for (int i = 0; i < 10; ++i) few = update_guide_state(few, vec3(0), vec3(1), 1, 1, 0.03f, 3, true);
  EXPECT_EQ(few.count, 3u);
}

// --- views ---

TEST(GuideView, IsThatOfLongDoubleFromAnyDistance) {
  Rng rng(8);
  for (int i = 0; i < 200000; ++i) {
    GuideState s = some_state();
    const bool in_world = rng.below(2) == 0;
    s.spread = rng.below(10) == 0 ? 0.0f : std::exp(rng.uniform(-30, in_world ? 22.0f : 0.0f));
    s.count = rng.below(256);
    const float radius2 = std::exp(rng.uniform(-9.2f, 13.8f)), cosine = rng.uniform(-1, 1);
    vec3 d(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    d *= std::exp(rng.uniform(-6.9f, 11)) / std::sqrt(dot(d, d));  // 1e-3 to 6e4 units
    const GuideView v = view_guide_state(s, d, cosine, radius2, in_world);
    const Real d2 = vector(d).x * vector(d).x + vector(d).y * vector(d).y + vector(d).z * vector(d).z;
    const Real n = std::max(static_cast<Real>(s.count), 1.0L), n2 = n * n, r2 = static_cast<Real>(radius2);
    Real spread, scale = 1;
    if (in_world) {
      const Real angle = static_cast<Real>(kPriorAngle), prior = std::max(r2, angle * angle * d2);
      const Real extent2 = (n2 * static_cast<Real>(s.spread) + prior) / (n2 + 1);
      spread = extent2 / (d2 + extent2);
      scale = std::max(static_cast<Real>(cosine), static_cast<Real>(0.1f)) / (d2 + extent2);
    } else {
      spread = (n2 * static_cast<Real>(s.spread) + r2 / d2) / (n2 + r2 / d2);
    }
    const auto relative = [](float is, Real wanted) {
      return static_cast<double>(std::abs(static_cast<Real>(is) - wanted) / wanted);
    };
    ASSERT_LT(relative(v.spread, spread), static_cast<double>(16 * kEpsilon));
    ASSERT_LE(v.spread, 1.0f);
    ASSERT_LT(relative(v.scale, scale), static_cast<double>(16 * kEpsilon));
    ASSERT_LT(relative(v.distance2, d2), static_cast<double>(4 * kEpsilon));
    ASSERT_NEAR(static_cast<double>(length(vector(v.direction))), 1, static_cast<double>(6 * kEpsilon));
    const float kappa = vmf_kappa(v.spread);
    ASSERT_TRUE(kappa >= 0 && kappa <= kVmfMaxKappa && std::isfinite(vmf_normalization(kappa))) << v.spread;
  }
}

// The nearest that the estimator lets a state be, and what was learnt the other way (r_mc_world changed meanwhile).
TEST(GuideView, HoldsAtItsLimits) {
  for (const float spread : {0.0f, 1e-14f, 0.5f, 1.0f, 100.0f, 3.6e9f}) {
    for (const float distance : {1e-3f, 1.0f, 1e5f}) {
      for (const bool in_world : {false, true}) {
        GuideState s = some_state();
        s.spread = spread;
        const GuideView v = view_guide_state(s, vec3(distance, 0, 0), -1, 1e-4f, in_world);
        EXPECT_TRUE(v.spread >= 0 && v.spread <= 1) << spread << ' ' << distance;
        EXPECT_TRUE(std::isfinite(v.scale) && v.scale > 0) << spread << ' ' << distance;
      }
    }
  }
}

}  // namespace
TEST(Guide, MomentsAreCutTogether) {
  const vec4 small(1.0f, 2.0f, 3.0f, 4.0f);
  EXPECT_EQ(bound_moments(small, 4.0f), small);
  EXPECT_EQ(bound_moments(vec4(0.0f), 4.0f), vec4(0.0f));
  // Light outside of every lobe: the moment grows with the share, and must do so afterwards.
  const vec4 cut = bound_moments(vec4(100.0f, 200.0f, 400.0f, 800.0f), 16.0f);
  EXPECT_EQ(cut, vec4(2.0f, 4.0f, 8.0f, 16.0f));
}

}  // namespace fb::shared
