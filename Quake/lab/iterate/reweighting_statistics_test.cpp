// Technique mir, over many runs: the decorrelated form has the mean of pt, the others lose energy, less with more
// samples, and a store that is full at once changes what it must and no more.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "lab/frame_source.h"
#include "lab/iterate/iterate_job.h"
#include "lab/ztest/ztest.h"
#include "render/test_device.h"
#include "shared/color.h"

namespace fb::lab {
namespace {

constexpr double kMirAlpha = 1e-4;

class ReweightingStatistics : public render::DeviceTest {
 protected:
  static constexpr std::uint32_t kWidth = 32, kHeight = 24, kBlock = 8;
  static render::RenderSettings settings_of(const std::string& estimator) {
    render::RenderSettings settings;
    settings.estimator = estimator;
    settings.jitter = 0;
    settings.bounces = 3;
    settings.mir_split = 300;  // so that a small picture has leaves
    return settings;
  }
  struct Scene {
    View view;
    BlockRuns expected;
    double mean;
  };
  static Scene scene_of(const std::string& name, std::uint32_t runs, std::uint32_t samples,
                        const std::string& estimator = "pt") {
    auto source = code_scene(name, 60);
    EXPECT_TRUE(source.ok());
    auto view = collect_view(**source, {0, 0, 0, true});
    EXPECT_TRUE(view.ok());
    Scene scene{std::move(*view), BlockRuns(kWidth, kHeight, kBlock), 0};
    scene.expected = runs_of(scene.view, settings_of(estimator), {samples}, runs, 1000);
    return scene;
  }
  static BlockRuns runs_of(const View& view, render::RenderSettings settings, const Schedule& schedule,
                           std::uint32_t runs, int seed) {
    const auto renderer = make_renderer(settings, kWidth, kHeight);
    BlockRuns result(kWidth, kHeight, kBlock);
    for (std::uint32_t i = 0; i < runs; ++i) {
      settings.seed = seed + static_cast<int>(i);
      const IteratedPicture run = render_iterations(*renderer, settings, view.at(0, 0), schedule, nullptr);
      for (const vec3& pixel : run.picture.pixels) EXPECT_TRUE(finite(pixel));
      result.add(run.picture);
    }
    return result;
  }
  static IteratedPicture one_run(render::RenderSettings settings, const Schedule& schedule) {
    auto source = code_scene("cbox", 60);
    auto view = collect_view(**source, {0, 0, 0, true});
    const auto renderer = make_renderer(settings, kWidth, kHeight);
    return render_iterations(*renderer, settings, view->at(0, 0), schedule, nullptr);
  }
  static ZTest compared(const Scene& scene, const render::RenderSettings& settings, const Schedule& schedule,
                        std::uint32_t runs) {
    return z_test(scene.expected, runs_of(scene.view, settings, schedule, runs, 1));
  }
};

TEST_F(ReweightingStatistics, TheDecorrelatedFormHasTheMeanOfPt) {
  for (const char* name : {"cbox", "one_light"}) {
    const Scene scene = scene_of(name, 24, 128);
    render::RenderSettings settings = settings_of("mir");
    settings.mir_decorrelated = 1;
    const ZTest test = compared(scene, settings, {4, 4, 4, 4}, 64);
    fmt::print("{}: p {:.2g}, bias {:+.2f}% to {:+.2f}%\n", name, test.p, 100 * test.energy.low,
               100 * test.energy.high);
    EXPECT_GT(test.p, kMirAlpha) << name << '\n' << ztest_text(test) << ztest_map(test);
  }
}

// With light that is looked for, too: water, glass, suns and flames in `kinds`.
TEST_F(ReweightingStatistics, TheDecorrelatedFormThatLooksForLightHasTheMeanOfNee) {
  for (const char* name : {"cbox", "one_light", "kinds"}) {
    const Scene scene = scene_of(name, 24, 64, "nee");
    render::RenderSettings settings = settings_of("mir_nee");
    settings.mir_decorrelated = 1;
    const ZTest test = compared(scene, settings, {4, 4, 4, 4}, 48);
    fmt::print("{}: p {:.2g}, bias {:+.2f}% to {:+.2f}%\n", name, test.p, 100 * test.energy.low,
               100 * test.energy.high);
    EXPECT_GT(test.p, kMirAlpha) << name << '\n' << ztest_text(test) << ztest_map(test);
  }
}

// The same samples that are seen teach: energy is lost.
TEST_F(ReweightingStatistics, FewSamplesLoseEnergyWhereTheyTeach) {
  const Scene scene = scene_of("cbox", 24, 128);
  render::RenderSettings settings = settings_of("mir");
  const Schedule few{1, 1, 1, 1, 1, 1, 1, 1};
  const ZTest own = compared(scene, settings, few, 96);
  settings.mir_weights = 2;
  const ZTest accumulated = compared(scene, settings, few, 96);
  fmt::print("eight samples: {:+.2f}% to {:+.2f}%; all alike {:+.2f}% to {:+.2f}%\n", 100 * own.energy.low,
             100 * own.energy.high, 100 * accumulated.energy.low, 100 * accumulated.energy.high);
  EXPECT_LT(own.energy.high, 0);
  EXPECT_GT(own.energy.low, -0.5);
  EXPECT_GT(accumulated.p, kMirAlpha) << ztest_text(accumulated);
}

TEST_F(ReweightingStatistics, StoredDensitiesAreThoseThatAreAskedAndRunsRepeat) {
  for (const char* estimator : {"mir", "mir_nee"}) {
    const IteratedPicture run = one_run(settings_of(estimator), {2, 2, 4, 8});
    const IteratedPicture again = one_run(settings_of(estimator), {2, 2, 4, 8});
    EXPECT_EQ(run.picture.pixels, again.picture.pixels);
    std::uint64_t others = 0, vertices = 0;
    const std::size_t at = run.report.find("densities of ");
    ASSERT_NE(at, std::string::npos) << run.report;
    ASSERT_EQ(std::sscanf(run.report.c_str() + at, "densities of %lu of %lu", &others, &vertices), 2) << run.report;
    EXPECT_GT(vertices, 500u);
    EXPECT_LE(others, 1u) << "on edges of a distribution's parts alone";
  }
}

// What is not stored would count as it does without weights, which no test of bias finds: all that frames show is
// what first surfaces emit, and stored paths.
TEST_F(ReweightingStatistics, StoredPathsBringAllLightButWhatIsSeenAtOnce) {
  const auto light_of = [](const IteratedPicture& run) {
    double sum = 0;
    for (const vec3& pixel : run.picture.pixels) sum += static_cast<double>(shared::luminance(pixel));
    return sum;
  };
  for (const char* estimator : {"mir", "mir_nee"}) {
    render::RenderSettings settings = settings_of(estimator);
    const double seen_at_once = [&] {
      render::RenderSettings emission = settings_of("pt");
      emission.bounces = 0;
      return light_of(one_run(emission, {1}));
    }();
    const Schedule schedule{4, 4};
    const IteratedPicture run = one_run(settings, schedule);
    settings.mir_weights = 2;  // the same frames
    const double all = light_of(one_run(settings, schedule));
    double stored = 0;
    const std::size_t at = run.report.find("stored paths brought ");
    ASSERT_NE(at, std::string::npos) << run.report;
    ASSERT_EQ(std::sscanf(run.report.c_str() + at, "stored paths brought %lf%%", &stored), 1) << run.report;
    EXPECT_GT(stored, 30);
    EXPECT_NEAR(stored, 100 * (1 - seen_at_once / all), 0.01) << estimator;
  }
}

TEST_F(ReweightingStatistics, WithoutRoomAllSamplesCountAlike) {
  const Schedule schedule{2, 2, 4};
  render::RenderSettings settings = settings_of("mir");
  const auto weighed = one_run(settings, schedule).picture.pixels;
  settings.mir_weights = 2;
  const auto alike = one_run(settings, schedule).picture.pixels;
  settings.mir_weights = 0;
  settings.mir_storage = 0;
  const auto by_parts = one_run(settings, schedule).picture.pixels;  // Eq. 8
  settings.mir_partial = 0;
  const auto naive = one_run(settings, schedule).picture.pixels;
  EXPECT_EQ(naive, alike);
  EXPECT_NE(weighed, alike);
  EXPECT_NE(by_parts, alike);
  EXPECT_NE(by_parts, weighed);
  double sum = 0, by_parts_sum = 0;
  for (std::size_t i = 0; i < weighed.size(); ++i) {
    sum += static_cast<double>(weighed[i].y);
    by_parts_sum += static_cast<double>(by_parts[i].y);
  }
  EXPECT_NEAR(by_parts_sum, sum, 0.2 * sum);
}

TEST_F(ReweightingStatistics, AnIterationThatIsNotSeenAndOneSampleAreFine) {
  render::RenderSettings settings = settings_of("mir");
  settings.mir_decorrelated = 1;
  for (const Schedule& schedule : {Schedule{1, 2}, Schedule{2, 1, 1}, Schedule{1}})
    for (const vec3& pixel : one_run(settings, schedule).picture.pixels) EXPECT_TRUE(finite(pixel));
}

}  // namespace
}  // namespace fb::lab
