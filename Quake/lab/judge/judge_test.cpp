// The whole judge on scenes in code, in miniature.
#include "lab/judge/judge_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>

#include "lab/jobs.h"
#include "lab/judge/judge_report.h"
#include "lab/judge/test_judge.h"

namespace fb::lab {
namespace {

using JudgeSequences = JudgeTest;

TEST_F(JudgeSequences, AMovingViewIsHeldToEachFramesReference) {
  const SuiteView view = view_of("moving", 40, 41, 0);
  const auto references = references_of(view, 256), others = references_of(view_of("moving", 0, 1, 0), 256);
  ASSERT_EQ(references.size(), 2u);
  EXPECT_NE(references[0].guides.motion, std::vector<vec2>(std::size_t{kWidth} * kHeight, vec2(0.0f)));
  const JudgeJob job = job_of({lane("pt", 64)}, 1);
  const auto right = judge_view(view, "", references, job, nullptr);
  ASSERT_TRUE(right.ok()) << right.error().message;
  const auto wrong = judge_view(view, "", others, job, nullptr);
  EXPECT_TRUE(std::isfinite(right->figures.lanes[0].seeds[0][kFlicker]));
  EXPECT_LT(2 * right->figures.lanes[0].seeds[0][kRelMse], wrong->figures.lanes[0].seeds[0][kRelMse]);
}

TEST_F(JudgeSequences, ReferencesAreMadeOnceAndKeptByWhatTheyDependOn) {
  const std::string folder = directory_.file("references");
  const SuiteView view = view_of("cbox", 0, 1, 0);
  const auto made = references_of(view, 64, folder);
  const auto files = [&] {
    return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator{});
  };
  ASSERT_EQ(files(), 1);
  const auto time = std::filesystem::last_write_time(*std::filesystem::directory_iterator(folder));
  const auto kept = references_of(view, 64, folder);
  EXPECT_EQ(std::filesystem::last_write_time(*std::filesystem::directory_iterator(folder)), time) << "not made again";
  EXPECT_EQ(made[0].exposure, kept[0].exposure);
  EXPECT_GT(kept[0].exposure, 0);
  EXPECT_EQ(made[0].guides.id, kept[0].guides.id);
  EXPECT_EQ(made[0].guides.depth, kept[0].guides.depth);
  EXPECT_EQ(made[0].radiance.mean.pixels[77], kept[0].radiance.mean.pixels[77]);
  EXPECT_EQ(made[0].radiance.variance[77], kept[0].radiance.variance[77]);
  references_of(view, 96, folder);
  references_of(view_of("one_light", 0, 1, 0), 64, folder);
  EXPECT_EQ(files(), 3) << "other samples, another scene: other references";

  auto source = code_scene("cbox", 60);
  scene::FrameSnapshot snapshot;
  ASSERT_TRUE((*source)->next(snapshot).ok());
  render::RenderSettings settings;
  const std::uint64_t key = reference_key(snapshot, settings, {});
  settings.mc_states = 2048;
  settings.svgf_alpha = 0.1f;
  EXPECT_EQ(reference_key(snapshot, settings, {}), key) << "what does not change the mean";
  settings.bounces = 7;
  EXPECT_NE(reference_key(snapshot, settings, {}), key);
  settings.bounces = render::RenderSettings().bounces;
  settings.emit_lava = 1;
  EXPECT_NE(reference_key(snapshot, settings, {}), key);
  settings = {};
  settings.water = 0;
  EXPECT_NE(reference_key(snapshot, settings, {}), key);
  settings = {};
  settings.exposure_target = 1.6f;
  EXPECT_NE(reference_key(snapshot, settings, {}), key);
}

TEST_F(JudgeSequences, AReferenceIsShownAsTheRendererShowsIt) {
  const JudgeJob job = job_of({}, 1);
  const auto steps = tone_curve_difference({"this", "fullbright-lab", true}, job);
  ASSERT_TRUE(steps.ok()) << steps.error().message;
  EXPECT_LE(*steps, kSameToneCurve);
  EXPECT_GT(*steps, 0) << "there is dither";
}

TEST_F(JudgeSequences, RefusesWhatCannotBe) {
  const SuiteView view = view_of("moving", 0, 1, 0);
  auto references = references_of(view, 32);
  JudgeJob job = job_of({lane("pt", 1)}, 1);
  job.width = 64;
  EXPECT_THAT(judge_view(view, "", references, job, nullptr).error().message, testing::HasSubstr("32x18"));
  job.width = kWidth;
  job.runner = [](const SequenceRequest&) -> Result<Sequence> { return Error{"no sequence"}; };
  EXPECT_EQ(judge_view(view, "", references, job, nullptr).error().message, "no sequence");
  references.push_back(references[0]);
  EXPECT_THAT(judge_view(view, "", references, job, nullptr).error().message, testing::HasSubstr("3 references of 2"));
}

}  // namespace
}  // namespace fb::lab
