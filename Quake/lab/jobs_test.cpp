// The laboratory's jobs on scenes in code: files, references, repetition, and sentences for what cannot be done.
#include "lab/jobs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "base/test_directory.h"
#include "lab/client_source.h"
#include "lab/image_io.h"
#include "render/test_device.h"

namespace fb::lab {
namespace {

class JobsTest : public render::DeviceTest {
 protected:
  std::string path(const std::string& name) const { return directory_.file(name); }
  static std::unique_ptr<FrameSource> scene(const std::string& name) {
    auto source = code_scene(name, 60);
    EXPECT_TRUE(source.ok());
    return std::move(*source);
  }
  const TestDirectory directory_;
};

TEST_F(JobsTest, WritesTheChosenFramesAndNoOthers) {
  auto renderer = make_renderer({}, 32, 18);
  RenderJob job;
  job.first = 2;
  job.last = 4;
  job.width = 32;
  job.height = 18;
  job.out = path("frames");
  job.quiet = true;
  const auto summary = render_frames(*scene("moving"), *renderer, {}, job);
  ASSERT_TRUE(summary.ok());
  EXPECT_EQ(summary->frames, 3u);
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(job.out))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"frame_000002.png", "frame_000003.png", "frame_000004.png"}));
}

TEST_F(JobsTest, ReferenceOfTheFurnaceIsItsClosedFormWithItsUncertainty) {
  auto renderer = make_renderer({}, 32, 18);
  ReferenceJob job;
  job.width = 32;
  job.height = 18;
  job.spp = 48;
  job.out = path("furnace.exr");
  job.quiet = true;
  const auto summary = render_reference(*scene("furnace_objects"), *renderer, {}, job);
  ASSERT_TRUE(summary.ok()) << summary.error().message;
  EXPECT_NEAR(summary->mean_luminance, 1.75, 1e-3);  // emission 1, albedo 1/2, two bounces
  EXPECT_EQ(summary->frames, 3u);
  const auto image = read_exr(job.out);
  ASSERT_TRUE(image.ok());
  for (const char* name : {"R", "G", "B", "variance.R", "albedo.G", "normal.X", "Z"})
    EXPECT_NE(image->channel(name), nullptr) << name;
  for (const float v : *image->channel("variance.R")) EXPECT_GE(v, 0.0f);
  EXPECT_EQ(image->texts().at("fullbright.jitter"), "1") << "r_jitter -1: while accumulating";
  EXPECT_EQ(image->texts().at("fullbright.spp"), "48");
}

TEST_F(JobsTest, AReferencesVarianceTellsTheSpreadBetweenSeeds) {
  // Two references with different seeds: the squared difference of their means is the sum of their variances, on
  // average.
  std::vector<std::vector<float>> means, variances;
  for (const int seed : {1, 2}) {
    auto renderer = make_renderer({}, 48, 48);
    render::RenderSettings settings;
    settings.seed = seed;
    settings.jitter = 0;
    ReferenceJob job;
    job.width = job.height = 48;
    job.spp = 512;  // 32 passes of 16
    job.out = path("box.exr");
    job.quiet = true;
    ASSERT_TRUE(render_reference(*scene("cbox"), *renderer, settings, job).ok());
    const auto image = read_exr(job.out);
    ASSERT_TRUE(image.ok());
    means.push_back(*image->channel("R"));
    variances.push_back(*image->channel("variance.R"));
  }
  double difference = 0, variance = 0;
  for (std::size_t i = 0; i < means[0].size(); ++i) {
    difference += (means[0][i] - means[1][i]) * (means[0][i] - means[1][i]);
    variance += variances[0][i] + variances[1][i];
  }
  // 2304 pixels, each ratio with a chi-squared-like spread of about sqrt(2) and heavy tails: within 25%.
  EXPECT_NEAR(difference / variance, 1.0, 0.25);
}

TEST_F(JobsTest, WarmingUpTeachesWhoLearnsAndChangesNothingElse) {
  struct Run {
    ReferenceSummary summary;
    double variance;  // the mean pixel's
  };
  // Repeatable to the bit whatever the threads do, and without edges, which are as noisy for one who has learnt all.
  const auto run = [&](const char* estimator, std::uint32_t warmup) {
    render::RenderSettings settings;
    settings.estimator = estimator;
    settings.deterministic = 1;
    settings.jitter = 0;
    auto renderer = make_renderer(settings, 48, 48);
    ReferenceJob job;
    job.width = job.height = 48;
    job.spp = 64;
    job.warmup = warmup;
    job.out = path("warm.exr");
    job.quiet = true;
    const auto summary = render_reference(*scene("one_light"), *renderer, settings, job);
    const auto image = read_exr(job.out);
    const std::vector<float>& variances = *image->channel("variance.G");
    return Run{*summary, std::accumulate(variances.begin(), variances.end(), 0.0) / double(variances.size())};
  };
  EXPECT_EQ(run("pt", 100).summary.mean_luminance, run("pt", 0).summary.mean_luminance) << "the same random numbers";
  const Run cold = run("mcpg", 0), warm = run("mcpg", 512);
  EXPECT_EQ(warm.summary.frames, 4u) << "what it has learnt from is not in the mean";
  EXPECT_LT(warm.variance, 0.2 * cold.variance);  // 0.01 to 0.04 with six seeds
  EXPECT_NEAR(warm.summary.mean_luminance, cold.summary.mean_luminance, 0.05 * cold.summary.mean_luminance);
}

TEST_F(JobsTest, RefusesWhatCannotBe) {
  EXPECT_NE(code_scene("nowhere", 60).error().message.find("cbox"), std::string::npos) << "names what there is";
  auto renderer = make_renderer({}, 8, 8);
  RenderJob job;
  job.first = 5;
  job.last = 2;
  EXPECT_FALSE(render_frames(*scene("cbox"), *renderer, {}, job).ok());
  ReferenceJob nowhere;
  nowhere.width = nowhere.height = 8;
  nowhere.spp = 1;
  nowhere.quiet = true;
  nowhere.out = path("no/such/folder/x.exr");
  EXPECT_FALSE(render_reference(*scene("cbox"), *renderer, {}, nowhere).ok());
}

}  // namespace
}  // namespace fb::lab
