// The whole judge on scenes in code, in miniature. Sequences are rendered here as `render` would, without a program.
#include "lab/judge/judge_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/number.h"
#include "base/test_directory.h"
#include "lab/jobs.h"
#include "lab/judge/judge_report.h"
#include "render/test_device.h"

namespace fb::lab {
namespace {

constexpr std::uint32_t kWidth = 32, kHeight = 18;

class JudgeTest : public render::DeviceTest {
 protected:
  static SuiteView view_of(const std::string& scene, std::uint64_t first, std::uint64_t last, std::uint32_t warmup) {
    SuiteView view;
    view.name = view.scene = scene;
    view.first = first;
    view.last = last;
    view.warmup = warmup;
    return view;
  }
  static Lane lane(const std::string& name, std::uint32_t spp, std::vector<std::string> sets = {"r_denoise=0"}) {
    return {name, {"this", "fullbright-lab", true}, "pt", spp, std::move(sets)};
  }
  std::vector<JudgedReference> references_of(const SuiteView& view, std::uint32_t spp, const std::string& folder = "") {
    auto source = code_scene(view.scene, 60);
    auto collected = collect_view(**source, {view.first, view.last, 0});
    EXPECT_TRUE(collected.ok());
    auto renderer = make_renderer({}, kWidth, kHeight);
    auto made = make_judged_references(*collected, *renderer, {}, {"nee", spp, kWidth, kHeight, folder, "", true});
    EXPECT_TRUE(made.ok()) << (made ? "" : made.error().message);
    return std::move(*made);
  }
  // What a program's `render` does, in this process.
  Result<Sequence> render(const SequenceRequest& request) {
    const SuiteView& view = *request.view;
    con::Console console;
    render::register_render_cvars(console);
    console.set("r_denoise", "1");
    console.set("r_estimator", request.lane->estimator);
    for (const auto* sets : {&view.sets, &request.lane->sets, &request.sets})
      for (const std::string& text : *sets)
        console.set(text.substr(0, text.find('=')), text.substr(text.find('=') + 1));
    RenderJob job;
    job.first = view.first - view.warmup;
    job.last = view.last;
    job.width = request.width;
    job.height = request.height;
    job.spp = request.lane->spp;
    job.out = request.folder;
    job.format = ImageFormat::kBoth;
    job.quiet = true;
    const auto settings = render::read_render_settings(console);
    auto renderer = make_renderer(settings, job.width, job.height);
    auto source = code_scene(view.scene, view.frames_per_second);
    auto summary = render_frames(**source, *renderer, settings, job);
    if (!summary) return summary.error();
    Sequence sequence;
    for (const auto& pass : summary->passes) sequence.times.all += pass.median();
    auto frames = read_frames(request);
    if (!frames) return frames.error();
    sequence.frames = std::move(*frames);
    return sequence;
  }
  JudgeJob job_of(std::vector<Lane> lanes, std::uint32_t seeds) {
    JudgeJob job;
    job.lanes = std::move(lanes);
    job.width = kWidth;
    job.height = kHeight;
    job.seeds = seeds;
    job.scratch = directory_.file("scratch");
    job.pictures = directory_.file("pictures");
    job.runner = [this](const SequenceRequest& request) { return render(request); };
    return job;
  }
  const TestDirectory directory_;
};

TEST_F(JudgeTest, FourTimesTheSamplesAreAQuarterOfTheError) {
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

TEST_F(JudgeTest, AMovingViewIsHeldToEachFramesReference) {
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

TEST_F(JudgeTest, ReferencesAreMadeOnceAndKeptByWhatTheyDependOn) {
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
}

TEST_F(JudgeTest, AReferenceIsShownAsTheRendererShowsIt) {
  const JudgeJob job = job_of({}, 1);
  const auto steps = tone_curve_difference({"this", "fullbright-lab", true}, job);
  ASSERT_TRUE(steps.ok()) << steps.error().message;
  EXPECT_LE(*steps, kSameToneCurve);
  EXPECT_GT(*steps, 0) << "there is dither";
}

TEST_F(JudgeTest, RefusesWhatCannotBe) {
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
