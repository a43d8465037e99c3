// Offline iterations: schedules as they are typed, runs that begin with nothing, pictures of all samples.
#include "lab/iterate/iterate_job.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "lab/iterate/iterate_report.h"
#include "lab/reference/replicates.h"
#include "render/test_device.h"

namespace fb::lab {
namespace {

std::vector<std::uint32_t> parsed(const std::string& text) {
  const auto schedule = parse_schedule(text);
  EXPECT_TRUE(schedule.ok()) << text;
  return schedule ? *schedule : Schedule();
}

TEST(Schedule, IsAListOrDoubles) {
  EXPECT_THAT(parsed("1,1,2,4"), testing::ElementsAre(1, 1, 2, 4));
  EXPECT_THAT(parsed("24"), testing::ElementsAre(24));
  EXPECT_THAT(parsed("doubling:1"), testing::ElementsAre(1));
  EXPECT_THAT(parsed("doubling:2"), testing::ElementsAre(1, 1));
  EXPECT_THAT(parsed("doubling:10"), testing::ElementsAre(1, 1, 2, 4, 8, 16, 32, 64, 128, 256));
  EXPECT_EQ(samples_of(parsed("doubling:10")), 512u);
  EXPECT_EQ(samples_of(parsed("doubling:21")), kMostScheduled);
  EXPECT_EQ(samples_of(parsed("1048575,1")), kMostScheduled);
  EXPECT_EQ(schedule_text(parsed("doubling:4")), "1,1,2,4");
}

TEST(Schedule, SaysInOneSentenceWhatIsWanted) {
  for (const char* text : {"", ",", "1,", ",1", "1,,2", "0", "1,0", "-1", "1.5", "1;2", "twice", "doubling",
                           "doubling:", "doubling:0", "doubling:22", "doubling:-1", "doubling:2,4"}) {
    const auto schedule = parse_schedule(text);
    ASSERT_FALSE(schedule.ok()) << text;
    EXPECT_EQ(schedule.error().message, std::string("--schedule ") + text +
                                            ": samples a pixel of each iteration are wanted, as 1,1,2,4, or doubling:N "
                                            "with N from 1 to 21");
  }
  for (const char* text : {"1048577", "1048576,1", "18446744073709551615,1", "4294967295,2"}) {
    const auto schedule = parse_schedule(text);
    ASSERT_FALSE(schedule.ok()) << text;
    EXPECT_EQ(schedule.error().message,
              std::string("--schedule ") + text + ": it has more than 1048576 samples a pixel");
  }
}

class IterateSequences : public render::DeviceTest {
 protected:
  static constexpr std::uint32_t kWidth = 32, kHeight = 24;
  static View view_of(const std::string& scene) {
    auto source = code_scene(scene, 60);
    EXPECT_TRUE(source.ok());
    auto view = collect_view(**source, {0, 0, 0, true});
    EXPECT_TRUE(view.ok());
    return std::move(*view);
  }
  static render::RenderSettings settings_of(const std::string& estimator) {
    render::RenderSettings settings;
    settings.estimator = estimator;
    settings.jitter = 0;
    settings.deterministic = 1;
    settings.mc_states = settings.mc_cells = 1 << 16;
    return settings;
  }
  static Reference reference_of(const View& view, std::uint32_t spp) {
    auto made = make_references(view, *device_, settings_of("pt"), {"pt", spp, kWidth, kHeight, "", true});
    EXPECT_TRUE(made.ok());
    return std::move(made->front());
  }
  static IterateJob job_of(const std::vector<Configuration>& configurations, const Schedule& schedule,
                           std::uint32_t runs) {
    IterateJob job;
    job.configurations = configurations;
    job.schedule = schedule;
    job.width = kWidth;
    job.height = kHeight;
    job.runs = runs;
    job.quiet = true;
    return job;
  }
};

TEST_F(IterateSequences, ThePictureIsTheMeanOfAllSamples) {
  const View view = view_of("cbox");
  const auto renderer = make_renderer(settings_of("pt"), kWidth, kHeight);
  std::vector<std::uint32_t> told;
  const IteratedPicture parts = render_iterations(*renderer, settings_of("pt"), view.at(0, 0), {1, 1, 2, 4},
                                                  [&](std::uint32_t done) { told.push_back(done); });
  EXPECT_EQ(parts.samples, 8u);
  EXPECT_EQ(renderer->accumulated_frames(), 8u);
  EXPECT_THAT(told, testing::ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));

  // The same frames without iterations, of a renderer of their own.
  const render::RenderSettings settings = settings_of_samples(settings_of("pt"));
  const auto plain = make_renderer(settings, kWidth, kHeight);
  scene::FrameSnapshot snapshot = view.at(0, 0);
  double gpu_ms = 0;
  for (int k = 0; k < 8; ++k) {
    plain->render(snapshot, nullptr, settings);
    gpu_ms += plain->gpu_milliseconds();
  }
  const auto linear = plain->read().linear();
  EXPECT_EQ(linear.front().w, 8.0f);
  EXPECT_EQ(parts.picture.pixels, picture_of(linear, {kWidth, kHeight}).pixels);
  if (gpu_ms <= 0) return;  // no timestamps
  EXPECT_GT(parts.estimator_ms, 0);
  EXPECT_GT(parts.gpu_ms, parts.estimator_ms);
  EXPECT_GT(parts.gpu_ms, renderer->gpu_milliseconds()) << "of all frames, not of the last";
}

TEST_F(IterateSequences, EveryRunBeginsWithNothing) {
  const View view = view_of("kinds");
  for (const char* estimator : {"mcpg", "mcpg_nee"}) {
    const auto renderer = make_renderer(settings_of(estimator), kWidth, kHeight);
    const auto run = [&](int seed) {
      render::RenderSettings settings = settings_of(estimator);
      settings.seed = seed;
      return render_iterations(*renderer, settings, view.at(0, 0), {1, 1, 2}, nullptr).picture.pixels;
    };
    const auto first = run(5), other = run(6), again = run(5);
    EXPECT_EQ(first, again) << estimator;
    EXPECT_NE(first, other) << estimator;
  }
}

TEST_F(IterateSequences, RunsAreMeasuredAgainstTheReference) {
  const View view = view_of("cbox");
  const Reference reference = reference_of(view, 4096);
  const auto result = run_iterate(*device_, view, reference,
                                  job_of({{"pt", settings_of("pt")}, {"again", settings_of("pt")}}, {1, 1, 2, 4}, 8));
  ASSERT_TRUE(result.ok()) << result.error().message;
  ASSERT_EQ(result->configurations.size(), 2u);
  const auto &pt = result->configurations[0], &again = result->configurations[1];
  ASSERT_EQ(pt.runs.records.size(), 8u);
  EXPECT_EQ(pt.runs.spp, 8u);
  EXPECT_EQ(pt.not_finite, 0u);
  // The order of the configurations turns; what they make does not.
  for (std::uint32_t run = 0; run < 8; ++run)
    EXPECT_EQ(pt.runs.at(run, 0).errors.mse, again.runs.at(run, 0).errors.mse);
  EXPECT_NE(pt.runs.at(0, 0).errors.mse, pt.runs.at(1, 0).errors.mse) << "runs have seeds of their own";
  EXPECT_NEAR(again.statistics.gains->samples.value, 1, 1e-12);
  EXPECT_NEAR(again.statistics.rel_gains->samples.value, 1, 1e-12);
  // pt is unbiased: its error is variance, an eighth of a sample's.
  EXPECT_NEAR(pt.statistics.mse.mean, pt.variance, 4 * pt.statistics.mse.standard_error);
  const auto one = run_iterate(*device_, view, reference, job_of({{"pt", settings_of("pt")}}, {1}, 16));
  ASSERT_TRUE(one.ok());
  const Errored& mse = one->configurations[0].statistics.mse;
  const double error = std::hypot(mse.standard_error / 8, pt.statistics.mse.standard_error);
  EXPECT_NEAR(pt.statistics.mse.mean, mse.mean / 8, 4 * error);

  const BenchTitle title{"command", "scene cbox", "pt"};
  EXPECT_THAT(iterate_table(*result, title), testing::HasSubstr("iterations of 1,1,2,4 samples a pixel, 8 together"));
  EXPECT_THAT(iterate_table(*result, title), testing::HasSubstr("gain of again over pt [95%]"));
  EXPECT_THAT(iterate_json(*result, title), testing::HasSubstr("\"gain_relmse\""));
}

TEST_F(IterateSequences, RefusesWhatCannotBe) {
  const View view = view_of("cbox");
  Configuration four{"four", settings_of("pt")};
  four.settings.spp = 4;
  const Reference reference = reference_of(view, 32);
  const auto spp = run_iterate(*device_, view, reference, job_of({four}, {1}, 1));
  ASSERT_FALSE(spp.ok());
  EXPECT_EQ(spp.error().message, "four: r_spp 4: the schedule says how many samples there are, and r_spp is 1");
  IterateJob small = job_of({{"pt", settings_of("pt")}}, {1}, 1);
  small.width = small.height = 8;
  const auto size = run_iterate(*device_, view, reference, small);
  ASSERT_FALSE(size.ok());
  EXPECT_EQ(size.error().message, "the reference has 32x24 pixels, pt renders 8x8");
}

}  // namespace
}  // namespace fb::lab
