// Estimators mcpg_tail and mcpg_nee_tail: paths that end in the irradiance cache, which knows any number of
// reflections. Biased, so that it is held to closed forms and to pt within stated tolerances, not to a test of means.
#include <gtest/gtest.h>

#include <cmath>

#include "render/renderer.h"
#include "render/test_device.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

using PathTailStatistics = DeviceTest;
constexpr const char* kTails[]{"mcpg_tail", "mcpg_nee_tail"};

RenderSettings settings_of(const char* estimator, int spp, int bounces) {
  RenderSettings s;
  s.intersector = Intersector::kBvh;
  s.estimator = estimator;
  s.spp = spp;
  s.bounces = bounces;
  s.deterministic = 1;
  return s;
}

double image_mean(const std::vector<vec4>& image) {
  double sum = 0;
  for (const vec4& p : image) sum += p.y;
  return sum / static_cast<double>(image.size());
}

// Mean radiance of `frames` frames after `warm` of them.
double mean_after(Renderer& renderer, const scene::FrameSnapshot& snapshot, const RenderSettings& settings, int warm,
                  int frames) {
  for (int i = 0; i < warm; ++i) renderer.render(snapshot, nullptr, settings);
  renderer.restart_accumulation();
  for (int i = 0; i < frames; ++i) renderer.render(snapshot, nullptr, settings);
  return image_mean(renderer.read().linear());
}

// Any number of reflections in a closed room of albedo a and emission e: e / (1 - a). What the cache lacks of it
// shrinks by a share of r_mc_cache_alpha (1 - a) at most each time that a cell is trained; cells out of sight are
// trained seldom, so that the brighter room needs every path to go on.
TEST_F(PathTailStatistics, FurnaceGivesTheSumOfAllReflections) {
  for (const char* tail : kTails) {
    for (const float albedo : {0.3f, 0.7f}) {
      const bool objects = albedo > 0.5f;
      const float emission = 0.7f;
      RenderSettings s = settings_of(tail, 1, 2);
      if (albedo > 0.5f) s.mc_tail_train = 1;
      auto renderer = make_renderer(s, 48, 32);
      const double found = mean_after(*renderer, scene::furnace(albedo, emission, objects), s, 150, 16);
      const double expected = emission / (1.0 - albedo);
      EXPECT_NEAR(found, expected, 0.02 * expected) << tail << ' ' << albedo;
      EXPECT_EQ(renderer->read().counters().not_finite, 0u);
      EXPECT_EQ(renderer->read().counters().states_not_finite, 0u);
    }
  }
}

// Nothing is known yet: paths go on, and no pixel lacks the second reflection.
TEST_F(PathTailStatistics, FirstFrameHasNoHoles) {
  const float albedo = 0.5f;
  const RenderSettings s = settings_of("mcpg_tail", 4, 2);
  auto renderer = make_renderer(s, 48, 32);
  for (int frame = 0; frame < 8; ++frame) {
    renderer->restart_accumulation();
    renderer->render(scene::furnace(albedo, 1.0f), nullptr, s);
    for (const vec4& p : renderer->read().linear()) ASSERT_GT(p.y, 0.999f * (1 + albedo + albedo * albedo)) << frame;
  }
}

TEST_F(PathTailStatistics, NoReflectionIsNoReflection) {
  const RenderSettings s = settings_of("mcpg_tail", 1, 0);
  auto renderer = make_renderer(s, 16, 16);
  renderer->render(scene::furnace(0.5f, 1.0f), nullptr, s);
  EXPECT_NEAR(image_mean(renderer->read().linear()), 1.0, 1e-4);
}

TEST_F(PathTailStatistics, CornellBoxIsNearAllReflections) {
  const scene::FrameSnapshot box = scene::cornell_box();
  const auto of = [&](const RenderSettings& s, int warm, int frames) {
    auto renderer = make_renderer(s, 64, 64);
    const double mean = mean_after(*renderer, box, s, warm, frames);
    EXPECT_EQ(renderer->read().counters().not_finite, 0u);
    return mean;
  };
  const double two = of(settings_of("pt", 64, 2), 0, 4), many = of(settings_of("pt", 64, 16), 0, 4);
  RecordProperty("two", std::to_string(two));
  RecordProperty("many", std::to_string(many));
  for (const char* tail : kTails) {
    const double found = of(settings_of(tail, 4, 2), 150, 48);
    RecordProperty(tail, std::to_string(found));
    EXPECT_NEAR(found, many, 0.05 * many) << tail << ' ' << two;
    EXPECT_GT(found, two) << tail;
  }
}

}  // namespace
}  // namespace fb::render
