// The proof that a bias would be seen: two sides of one scene, of which one is brighter by a little, or neither.
#include <gtest/gtest.h>

#include <memory>

#include "lab/ztest/ztest_job.h"
#include "render/test_device.h"

namespace fb::lab {
namespace {

constexpr double kFalseAlarm = 1e-4;

RunPlan small_plan(std::uint32_t runs, std::uint32_t frames) {
  RunPlan p;
  p.width = 48;
  p.height = 36;
  p.block = 6;
  p.runs = runs;
  p.frames = frames;
  return p;
}

using PowerTest = render::DeviceTest;

TEST_F(PowerTest, FindsTwoPercentMoreLight) {
  auto source = code_scene("lava", 60);
  ASSERT_TRUE(source.ok());
  auto film = collect_film(**source, 0);
  ASSERT_TRUE(film.ok());
  Film brighter = *film;  // no cvar scales what glows in scenes made in code
  auto assets = std::make_shared<scene::Assets>(*brighter[0].assets);
  assets->generation = scene::next_generation();
  for (scene::Material& material : assets->materials) material.emission *= 1.02f;
  brighter[0].assets = assets;
  Sampling reference{{}, small_plan(16, 4)}, tested = reference;
  reference.settings.spp = tested.settings.spp = 4;
  tested.settings.seed = 1000;
  const auto expected = render_runs(*device_, *film, reference), found = render_runs(*device_, brighter, tested);
  ASSERT_TRUE(expected.ok() && found.ok());
  const ZTest test = z_test(expected->blocks, found->blocks);
  EXPECT_LT(test.p, kFalseAlarm) << ztest_text(test);
  EXPECT_LT(test.detectable(kFalseAlarm), 0.02);
  EXPECT_LT(test.energy.low, 0.02);
  EXPECT_GT(test.energy.high, 0.02);
}

// With the same seeds on both sides every difference would be zero, and no bias would ever be found.
TEST_F(PowerTest, TheSidesAreIndependent) {
  auto source = code_scene("lava", 60);
  ASSERT_TRUE(source.ok());
  const auto film = collect_film(**source, 0);
  ASSERT_TRUE(film.ok());
  const Sampling sampling{{}, small_plan(8, 2)};
  ReferenceRuns reference(*device_, *film, sampling);
  const auto verdict = judge(reference, sampling, kFalseAlarm);
  ASSERT_TRUE(verdict.ok());
  EXPECT_FALSE(verdict->biased);
  EXPECT_GT(verdict->test.chi_squared, 0.5 * static_cast<double>(verdict->test.tested));
}

}  // namespace
}  // namespace fb::lab
