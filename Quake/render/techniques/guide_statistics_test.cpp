// Path guiding in the whole renderer: the right mean whatever is set and however full the tables are, and far from the
// origin; and how well it follows a light.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <string>
#include <vector>
#include <algorithm>

#include "render/techniques/test_guide.h"
#include "render/test_denoiser.h"
#include "render/test_image.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_in_motion.h"

namespace fb::render {
namespace {

using GuideStatistics = GuideTest;

// The same scene elsewhere.
scene::FrameSnapshot moved(scene::FrameSnapshot snapshot, const vec3& by) {
  for (scene::Instance& instance : snapshot.instances) {
    instance.transform[3] += by;
    instance.prev_transform[3] += by;
  }
  snapshot.camera.position += by;
  snapshot.prev_camera.position += by;
  return snapshot;
}

const std::pair<const char*, std::function<void(RenderSettings&)>> kFeatures[] = {
    {"defaults", {}},
    {"deterministic", [](RenderSettings& s) { s.deterministic = 1; }},
    {"static grid of one width", [](RenderSettings& s) { s.mc_adaptive = 0, s.mc_wider = 1; }},
    {"both grids", [](RenderSettings& s) { s.mc_adaptive = 0.7f; }},
    {"adaptive grid", [](RenderSettings& s) { s.mc_adaptive = 1, s.mc_coarser = 0; }},
    {"share not learnt", [](RenderSettings& s) { s.mc_learn_share = 0; }},
    {"scores as in the paper", [](RenderSettings& s) { s.mc_share_score = 0, s.mc_in_world = 0; }},
    {"the paper's method", [](RenderSettings& s) { s.mc_paper = 1; }},
    {"no cache", [](RenderSettings& s) { s.mc_cache = 0; }},
    {"exponent 0", [](RenderSettings& s) { s.mc_power = 0; }},
    {"exponent 4", [](RenderSettings& s) { s.mc_power = 4; }},
    {"one in 64 trains", [](RenderSettings& s) { s.mc_train = 64; }},
    {"three parts", [](RenderSettings& s) { s.mc_parts = 3; }},
    {"extreme numbers", [](RenderSettings& s) { s.mc_alpha = 1e-4f, s.mc_radius = 0.01f, s.mc_static_width = 1; }},
    {"and the other way",
     [](RenderSettings& s) { s.mc_alpha = 1, s.mc_count = 1, s.mc_radius = 1024, s.mc_angle = 45; }},
};

TEST_F(GuideStatistics, FurnaceHasItsClosedFormWithEveryFeature) {
  // One for all: a change of settings in mid-flight keeps what was learnt, and starts the frame's numbers anew.
  auto renderer = make_renderer(guided(1, 2), 64, 48);
  const scene::FrameSnapshot scene = furnace();
  for (const auto& [name, change] : kFeatures) {
    const RenderSettings s = guided(4, 2, change);
    render_still(*renderer, scene, s, 6);  // cold and warm frames alike
    expect_furnace(*renderer, 2, static_cast<double>(kAlbedo), name);
  }
}

TEST_F(GuideStatistics, FurnaceHasItsClosedFormThirtyThousandUnitsAway) {
  for (const vec3& by : {vec3(30000, 30000, 30000), vec3(-30000, 29999.7f, -32500)}) {
    auto renderer = make_renderer(guided(1, 2), 64, 48);
    const scene::FrameSnapshot scene = moved(furnace(), by);
    for (const auto& [name, change] : kFeatures) {
      if (name != std::string("defaults") && name != std::string("extreme numbers")) continue;
      const RenderSettings s = guided(4, 2, change);
      render_still(*renderer, scene, s, 6);
      // Positions are rounded to 2^-9 there, so more rays start or end behind a surface.
      const ImageEstimate e = image_estimate(renderer->read().linear());
      const double a = static_cast<double>(kAlbedo), expected = static_cast<double>(kEmission) * (1 + a + a * a);
      EXPECT_NEAR(e.mean, expected, 4.5 * e.error + 1e-3 * expected) << name;
      EXPECT_EQ(renderer->read().counters().not_finite + renderer->read().counters().states_not_finite, 0u) << name;
    }
  }
}

// A state knows how fast its light moves; where it is depends on the time that has passed, not on the number of frames.
TEST_F(GuideStatistics, FollowsALightThroughFramesOfUnevenLength) {
  const auto assets = scene::rocket_assets();
  const auto at = [&](std::uint64_t frame) { return scene::rocket(assets, frame, 60); };
  const std::vector<std::uint64_t> shown = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 14, 18, 22, 26}, judged = {14, 18, 22, 26};
  const uvec2 size(96, 54);
  std::vector<std::vector<vec4>> references;
  for (const std::uint64_t frame : judged) references.push_back(rocket_reference(assets, frame, size));
  // Geometric means: without prediction a frame either finds the light or misses it by a factor of a hundred, so that
  // its median jumps from run to run.
  std::vector<double> errors;
  for (const int predicts : {0, 1}) {
    std::vector<double> logs;
    for (int seed = 0; seed < 4; ++seed) {
      const RenderSettings s = guided(2, 2, [&](RenderSettings& r) {
        r.jitter = 0;
        r.accumulate = 0;
        r.seed = seed;
        r.mc_radius = 4;
        r.mc_predict = predicts;
        r.deterministic = 1;  // else the gain is 4 to 38 from run to run
      });
      auto renderer = make_renderer(s, size.x, size.y);
      for (const std::uint64_t frame : shown) {
        renderer->render(at(frame), nullptr, s);
        const auto place = std::find(judged.begin(), judged.end(), frame);
        if (place == judged.end()) continue;
        const std::vector<vec4>& reference = references[static_cast<std::size_t>(place - judged.begin())];
        logs.push_back(std::log(mean_square_difference(renderer->read().linear(), reference)));
      }
    }
    errors.push_back(std::exp(std::accumulate(logs.begin(), logs.end(), 0.0) / static_cast<double>(logs.size())));
  }
  RecordProperty("gain", std::to_string(errors[0] / errors[1]));
  EXPECT_LT(errors[1], 0.33 * errors[0]);
}

TEST_F(GuideStatistics, EveryNumberOfBouncesAndSamples) {
  auto renderer = make_renderer(guided(1, 2), 64, 48);
  for (const int deterministic : {0, 1}) {
    for (const int bounces : {0, 1, 4}) {
      for (int spp = 1; spp <= 4; ++spp) {
        const RenderSettings s = guided(spp, bounces, [&](RenderSettings& r) { r.deterministic = deterministic; });
        render_still(*renderer, furnace(), s, 4);
        expect_furnace(*renderer, bounces, static_cast<double>(kAlbedo), "bounces and samples");
      }
    }
  }
}

// Each shape is a shader of its own, and wide mixtures take long to compile: with FULLBRIGHT_UNBIASED_TIMES there are
// more.
TEST_F(GuideStatistics, EveryShapeOfTheMixture) {
  std::vector<std::pair<int, int>> shapes{{1, 1}, {16, 1}, {2, 16}};
  if (std::getenv("FULLBRIGHT_UNBIASED_TIMES") != nullptr) shapes.insert(shapes.end(), {{1, 16}, {4, 8}, {3, 3}});
  for (const auto& [accesses, bucket] : shapes) {
    const RenderSettings s = guided(2, 2, [&, a = accesses, b = bucket](RenderSettings& r) {
      r.mc_accesses = a;
      r.mc_bucket = b;
    });
    auto renderer = make_renderer(s, 64, 48);
    render_still(*renderer, furnace(), s, 6);
    expect_furnace(*renderer, 2, static_cast<double>(kAlbedo),
                   std::to_string(accesses) + " cells of " + std::to_string(bucket));
  }
}

// Hundreds of cells want each slot: states of all kinds of places are thrown out all the time, and the mean stays.
TEST_F(GuideStatistics, FullTablesKeepTheMean) {
  const auto full = [](RenderSettings& s) { s.mc_states = s.mc_cells = 1024; };
  for (const auto& scene : {scene::cornell_box(), scene::many_lights(200)}) {
    ImageEstimate found[2];
    for (const bool guide : {false, true}) {
      RenderSettings s = guided(4, 2, full);
      if (!guide) s.estimator = "pt";
      s.seed = guide ? 1 : 0;
      auto renderer = make_renderer(s, 64, 48);
      render_still(*renderer, scene, s, guide ? 48 : 96);
      EXPECT_EQ(renderer->read().counters().not_finite + renderer->read().counters().states_not_finite, 0u);
      // The picture's own structure is no error: that of the mean is told by the frames.
      double variance = 0;
      const auto variances = renderer->read().variance_of_mean();
      for (const vec4& v : variances) variance += v.x;
      found[guide] = {image_estimate(renderer->read().linear()).mean,
                      std::sqrt(variance) / static_cast<double>(variances.size())};
    }
    const double error = std::hypot(found[0].error, found[1].error);
    EXPECT_NEAR(found[1].mean, found[0].mean, 4.5 * error);
    EXPECT_LT(error, 0.01 * found[0].mean) << "the test can see little";
  }
}

// The mean of the view of the cache: what its cells say is reflected, on the screen's scale.
class CacheStatistics : public GuideTest {
 protected:
  double brightness(RenderSettings s, int frames) {
    s.debug_view = 27;
    s.auto_exposure = s.fxaa = s.tone_map = 0;
    s.mc_cache_pixels = 64;
    auto renderer = make_renderer(s, 16, 12);
    render_still(*renderer, scene::furnace(kAlbedo, kEmission), s, frames);
    double sum = 0;
    for (const std::uint32_t pixel : renderer->read().output())
      sum += (pixel >> 8u) & 255u;  // a missing cell has no green
    return sum / (16 * 12);
  }
};

// Sums and counts of a cell's samples stay within their words however many a frame brings: the cache is as bright with
// 4096 samples a pixel as with 4.
TEST_F(CacheStatistics, CellsBearAnyNumberOfSamplesAFrame) {
  const double few = brightness(guided(4, 1), 24), many = brightness(guided(4096, 1), 3);
  EXPECT_GT(few, 100);
  EXPECT_NEAR(many, few, 0.05 * few);
}

// Light that was looked for counts in it like light that was met.
TEST_F(CacheStatistics, IsTheSameWhicheverWayLightsAreFound) {
  const double met = brightness(guided(16, 1), 24);
  const double looked_for = brightness(guided(16, 1, [](RenderSettings& r) { r.estimator = "mcpg_nee"; }), 24);
  EXPECT_NEAR(looked_for, met, 0.05 * met);
}

}  // namespace
}  // namespace fb::render
