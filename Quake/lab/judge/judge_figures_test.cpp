// Figures over seeds and views, held to arithmetic.
#include "lab/judge/judge_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/rng.h"

namespace fb::lab {
namespace {

Figures with(JudgeFigure figure, double value) {
  Figures figures = unknown_figures();
  figures[figure] = value;
  return figures;
}
LaneFigures lane(JudgeFigure figure, const std::vector<double>& seeds) {
  LaneFigures l;
  for (const double v : seeds) l.seeds.push_back(with(figure, v));
  return l;
}

TEST(JudgeFigures, FramesAreAveragedWhereTheyAreKnown) {
  Figures a = with(kFlip, 0.2), b = with(kFlip, 0.4);
  b[kFlicker] = 0.1;  // a first frame has none
  const Figures mean = mean_of({a, b});
  EXPECT_NEAR(mean[kFlip], 0.3, 1e-12);
  EXPECT_NEAR(mean[kFlicker], 0.1, 1e-12);
  EXPECT_TRUE(std::isnan(mean[kBias]));
}

TEST(JudgeFigures, ErrorsOverSeedsAreGeometric) {
  const Estimate e = over_seeds(lane(kFlip, {1, 1, 100, 100}), kFlip);
  EXPECT_NEAR(e.value, 10, 1e-9);
  // t of three degrees is 3.182; the logarithms' standard error is ln(10) / sqrt(3).
  EXPECT_NEAR(std::log(e.interval.high / e.value), 3.182 * std::log(10.0) / std::sqrt(3.0), 0.01);
  EXPECT_NEAR(e.interval.low * e.interval.high, 100, 1e-6);
  EXPECT_FALSE(over_seeds(lane(kFlip, {0.3, 0.3, 0.3}), kFlip).has_interval());
  EXPECT_FALSE(over_seeds(lane(kRelMse, {1, 1, 2, 2, 3, 3, 4}), kRelMse).has_interval()) << "fireflies rule it: eight";
  EXPECT_TRUE(over_seeds(lane(kRelMse, {1, 1, 2, 2, 3, 3, 4, 4}), kRelMse).has_interval());
  EXPECT_TRUE(std::isnan(over_seeds(lane(kFlip, {0.3, NAN}), kFlip).value));
}

TEST(JudgeFigures, BiasIsAPlainMeanAndKnowsTheReference) {
  const Estimate e = over_seeds(lane(kBias, {-0.1, 0.1, -0.1, 0.1}), kBias);
  EXPECT_NEAR(e.value, 0, 1e-12);
  EXPECT_NEAR(e.interval.high, 3.182 * 0.1 / std::sqrt(3.0), 1e-3) << "t of three degrees";
  const Estimate exact = over_seeds(lane(kBias, {0.02, 0.02, 0.02, 0.02}), kBias, 0.01);
  EXPECT_NEAR(exact.interval.high, 0.02 + 0.0196, 1e-9) << "only the reference is uncertain";
}

// Four seeds of FLIP, eight of biases whose reference has as much error as they together: 1,000 times each. Within four
// binomial standard errors.
TEST(JudgeFigures, IntervalsOverSeedsAndViewsHoldTheTruthAsOftenAsTheySay) {
  constexpr int kTrials = 1000;
  Rng rng(12);
  const auto normal = [&] {  // Box and Muller
    return std::sqrt(-2 * std::log(1.0 - rng.uniform())) * std::cos(2 * M_PI * rng.uniform());
  };
  const auto holds = [](const Estimate& e, double truth) {
    return e.interval.low <= truth && truth <= e.interval.high;
  };
  int flip = 0, bias = 0, all = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto seeds = [&](std::size_t count, auto value) {
      std::vector<double> values(count);
      for (double& v : values) v = value();
      return values;
    };
    flip += holds(over_seeds(lane(kFlip, seeds(4, [&] { return 0.2 * std::exp(0.1 * normal()); })), kFlip), 0.2);
    const double reference = 0.01 / std::sqrt(8.0), off = reference * normal();
    bias +=
        holds(over_seeds(lane(kBias, seeds(8, [&] { return 0.03 + 0.01 * normal() + off; })), kBias, reference), 0.03);
    std::vector<ViewFigures> views(3);
    for (ViewFigures& view : views) view.lanes = {lane(kRelMse, seeds(8, [&] { return std::exp(0.5 * normal()); }))};
    all += holds(over_views(views, 0, kRelMse), 1.0);
  }
  for (const int held : {flip, bias, all}) EXPECT_NEAR(held, 0.95 * kTrials, 28);
}

TEST(JudgeFigures, ASuiteWeighsViewsAlike) {
  // The second lane's error is half of the first's in every view and seed, at twice the time.
  std::vector<ViewFigures> views;
  for (const double scale : {0.01, 1.0, 100.0}) {
    ViewFigures view;
    std::vector<double> errors;
    for (int seed = 0; seed < 8; ++seed) errors.push_back(seed % 2 == 0 ? scale : 1.2 * scale);
    std::vector<double> halves = errors;
    for (double& error : halves) error *= 0.5;
    view.lanes = {lane(kRelMse, errors), lane(kRelMse, halves)};
    for (Figures& f : view.lanes[0].seeds) f[kAllMs] = 10;
    for (Figures& f : view.lanes[1].seeds) f[kAllMs] = 20;
    views.push_back(view);
  }
  EXPECT_NEAR(over_views(views, 0, kRelMse).value, std::sqrt(1.2), 1e-9);
  const JudgeGain gain = gain_over_first(views, 1, {1, 1});
  EXPECT_NEAR(gain.equal_samples.value, 2, 1e-9);
  EXPECT_NEAR(gain.equal_samples.interval.low, 2, 1e-9) << "seeds are paired: what they share is no uncertainty";
  EXPECT_NEAR(gain.equal_time.value, 1, 1e-9);
  EXPECT_NEAR(gain_over_first(views, 1, {1, 4}).equal_samples.value, 0.5, 1e-9);
  EXPECT_NEAR(gain_over_first(views, 0, {1, 1}).equal_time.value, 1, 1e-12);
}

TEST(JudgeFigures, AViewThatALaneDoesNotKnowIsLeftOut) {
  std::vector<ViewFigures> views(2);
  views[0].lanes = {lane(kFlip, {0.2}), lane(kFlip, {0.4})};
  views[1].lanes = {lane(kFlip, {0.8}), LaneFigures{}};
  EXPECT_NEAR(over_views(views, 0, kFlip).value, 0.2, 1e-12) << "both lanes over the same views";
  EXPECT_TRUE(std::isnan(over_views(views, 0, kBias).value));
  EXPECT_TRUE(std::isnan(gain_over_first(views, 1, {1, 1}).equal_time.value));
}

TEST(JudgeFigures, NothingButTheReferencesNoiseIsNoLessThanThat) {
  std::vector<ViewFigures> views(1);
  views[0].lanes = {lane(kRelMse, {-0.001}), lane(kRelMse, {0.04})};
  views[0].reference.rel_variance = 0.01;
  EXPECT_NEAR(over_views(views, 0, kRelMse).value, 0.01, 1e-12);
  EXPECT_NEAR(gain_over_first(views, 1, {1, 1}).equal_samples.value, 0.25, 1e-9);
}

}  // namespace
}  // namespace fb::lab
