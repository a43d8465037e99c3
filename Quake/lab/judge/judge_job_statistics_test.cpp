// The judge over seeds of a box: four times the samples are a quarter of the error, and its reports say so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "lab/judge/judge_report.h"
#include "lab/judge/test_judge.h"

namespace fb::lab {
namespace {

using JudgeJobStatistics = JudgeTest;

TEST_F(JudgeJobStatistics, FourTimesTheSamplesAreAQuarterOfTheError) {
  const SuiteView view = view_of("cbox", 2, 3, 1);
  const auto references = references_of(view, 2048);
  ASSERT_EQ(references.size(), 1u) << "it stands still";
  const JudgeJob job = job_of({lane("one", 1), lane("four", 4)}, 4);
  int done = 0;
  const auto judged = judge_view(view, "", references, job, [&] { ++done; });
  ASSERT_TRUE(judged.ok()) << judged.error().message;
  EXPECT_EQ(done, 8);
  const auto& lanes = judged->figures.lanes;
  const double one = over_seeds(lanes[0], kRelMse).value, four = over_seeds(lanes[1], kRelMse).value;
  // 8 frames of 576 pixels with heavy tails.
  EXPECT_NEAR(std::log(one / four), std::log(4.0), 0.6);
  const Estimate gain = gain_over_first({judged->figures}, 1, {1, 4}).equal_samples;
  EXPECT_GT(gain.value, 0.6);
  EXPECT_LT(gain.value, 1.6);
  EXPECT_FALSE(gain.has_interval()) << "of four seeds";
  EXPECT_GT(over_seeds(lanes[0], kFlip).value, over_seeds(lanes[1], kFlip).value);
  EXPECT_GT(over_seeds(lanes[1], kFlicker).value, 0.01) << "noise flickers";
  EXPECT_LT(over_seeds(lanes[0], kRelMseTrimmed).value, one);
  // pt is unbiased: twice its interval of 95% holds 0.
  const Estimate bias = over_seeds(lanes[1], kBias, judged->figures.reference.bias_error);
  EXPECT_LT(std::abs(bias.value), bias.interval.high - bias.interval.low);
  EXPECT_NE(lanes[0].seeds[0][kRelMse], lanes[0].seeds[1][kRelMse]) << "seeds differ";

  const JudgeTitle title{"command", "suite", "device", "nee", {"x: skipped"}, {}};
  EXPECT_THAT(judge_heading(job, title), testing::HasSubstr("x: skipped"));
  EXPECT_THAT(view_table(*judged, job), testing::HasSubstr("four"));
  EXPECT_THAT(summary_table({*judged, *judged}, job), testing::HasSubstr("gain of four over one"));
  const auto json = nlohmann::json::parse(judge_json({*judged}, job, title), nullptr, false);
  ASSERT_FALSE(json.is_discarded());
  EXPECT_EQ(json["views"][0]["configurations"].size(), 2u);
  EXPECT_TRUE(std::filesystem::exists(directory_.file("pictures") + "/cbox.png"));
}

}  // namespace
}  // namespace fb::lab
