// Reservoirs of light in the whole renderer: no light of what has left, none lost of what has come, through cuts and
// changes of the picture's shape; the same pictures again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "render/techniques/test_restir.h"
#include "render/test_denoiser.h"
#include "render/test_image.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scene_of_kinds.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/shapes.h"

namespace fb::render {
namespace {

using RestirSequences = RestirTest;

// A floor below two lamps of 32 units, each of them there or not.
scene::FrameSnapshot floor_below_lamps(const std::shared_ptr<const scene::Assets>& assets, std::uint32_t floor,
                                       std::uint32_t lamp, bool first, bool second) {
  scene::FrameSnapshot s = scene::still(assets, scene::camera_at({0, 0, 100}, {90, 0, 0}, 90));
  s.instances.push_back(scene::make_instance(scene::kIdWorld, floor));
  for (const bool left : {true, false}) {
    if (!(left ? first : second)) continue;
    const mat4x3 at(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(left ? -80.0f : 80.0f, 0, 120));
    s.instances.push_back(scene::make_instance(left ? 100 : 101, lamp, at));
  }
  return s;
}

struct Lamps {
  std::shared_ptr<scene::Assets> assets = scene::new_code_assets();
  std::uint32_t floor, lamp;
  Lamps() {
    const std::uint32_t grey = scene::add_material(*assets, "floor", vec3(0.5f));
    const std::uint32_t glow = scene::add_material(*assets, "lamp", vec3(0.0f), vec3(10.0f));
    scene::Mesh ground, light;
    scene::add_quad(ground, {-512, -512, 0}, {1024, 0, 0}, {0, 1024, 0}, grey);
    scene::add_box(light, vec3(-16), vec3(16), glow, false);
    floor = scene::add_finished(*assets, std::move(ground), "floor");
    lamp = scene::add_finished(*assets, std::move(light), "lamp");
  }
  scene::FrameSnapshot with(bool first, bool second) const {
    return floor_below_lamps(assets, floor, lamp, first, second);
  }
};

// Nothing is left of it, and what is left of the other is what that alone gives, from the first frame on.
TEST_F(RestirSequences, ALampThatLeavesTakesItsLightAtOnce) {
  const Lamps lamps;
  Means of[2];
  for (const bool reuses : {false, true}) {
    for (int run = 0; run < 24; ++run) {
      RenderSettings s = reuse_settings(2, reuses ? "restir_gi" : "nee");
      s.seed = run;
      auto renderer = make_renderer(s, 48, 36);
      render_still(*renderer, lamps.with(true, true), s, 8);
      renderer->render(lamps.with(false, true), nullptr, s);
      of[reuses ? 1 : 0].add(mean_of(*renderer));
      renderer->render(lamps.with(false, false), nullptr, s);
      EXPECT_EQ(mean_of(*renderer), 0);
      EXPECT_EQ(renderer->read().counters().not_finite, 0u);
    }
  }
  expect_equal(of[1], of[0], 0.02);
}

// Light of a lamp that was not there in the former frame: reservoirs of then could not have held it, and weights that
// thought so would lose most of it.
TEST_F(RestirSequences, ALampThatComesIsNeitherLateNorLost) {
  const Lamps lamps;
  double mean[3] = {}, square[3] = {};
  constexpr int kRuns = 24;
  for (const int way : {0, 1, 2}) {
    for (int run = 0; run < kRuns; ++run) {
      RenderSettings s = reuse_settings(1);
      s.estimator = way > 0 ? "restir_di" : "nee";
      s.restir_mis = way > 1 ? 1 : 0;
      s.seed = run;
      auto renderer = make_renderer(s, 48, 36);
      render_still(*renderer, lamps.with(true, false), s, 6);
      renderer->render(lamps.with(true, true), nullptr, s);
      const double m = mean_of(*renderer);
      mean[way] += m / kRuns;
      square[way] += m * m / kRuns;
    }
  }
  const auto error = [&](int i) { return std::sqrt(std::max(square[i] - mean[i] * mean[i], 0.0) / (kRuns - 1)); };
  EXPECT_NEAR(mean[1], mean[0], 4.5 * std::hypot(error(0), error(1)));
  EXPECT_LT(std::hypot(error(0), error(1)), 0.02 * mean[0]) << "the test can see little";
  EXPECT_LT(mean[2], 0.8 * mean[0]) << "by confidence alone it is lost";
}

// The same of a sun: one that was dark, one that was not in the list, one that shone on the floor's other side.
TEST_F(RestirSequences, ASunThatComesIsNeitherLateNorLost) {
  const Lamps lamps;
  const scene::Sun sun{glm::normalize(vec3(0.2f, 0.1f, 1.0f)), vec3(10.0f), 2.0f};
  const auto under = [&](std::vector<scene::Sun> suns) {
    scene::FrameSnapshot scene = lamps.with(true, false);
    scene.sky.beyond_everything = true;
    scene.sky.suns = std::move(suns);
    return scene;
  };
  scene::Sun dark = sun, below = sun;
  dark.irradiance = vec3(0.0f);
  below.direction = -sun.direction;
  const auto means = [&](const std::string& estimator, const std::vector<scene::Sun>& before) {
    Means found;
    for (int run = 0; run < 12; ++run) {
      RenderSettings s = reuse_settings(1, estimator);
      s.seed = run;
      auto renderer = make_renderer(s, 48, 36);
      render_still(*renderer, under(before), s, 6);
      renderer->render(under({sun}), nullptr, s);
      found.add(mean_of(*renderer));
    }
    return found;
  };
  const Means expected = means("nee", {sun});
  for (const std::vector<scene::Sun>& before : {std::vector{dark}, std::vector<scene::Sun>{}, std::vector{below}})
    expect_equal(means("restir_di", before), expected, 0.02);
}

// Frames of one reflection write no reservoirs of two: behind them those of long ago are no history.
TEST_F(RestirSequences, ReservoirsOfLongAgoAreNoHistory) {
  const auto assets = scene::moving_assets();
  for (const std::string estimator : {"restir_gi", "restir_guided"}) {
    RenderSettings s = reuse_settings(2, estimator);
    s.deterministic = 1;
    std::vector<std::uint64_t> after[2];
    for (const bool knows : {false, true}) {
      auto renderer = make_renderer(s, 33, 22);
      const auto frames = [&](int first, int last, int bounces) {
        s.bounces = bounces;
        for (int frame = first; frame <= last; ++frame)
          renderer->render(scene::moving(assets, frame / 60.0, std::max(frame - 1, 0) / 60.0), nullptr, s);
      };
      frames(0, 5, 2);
      frames(6, 9, 1);
      s.restir_gi_history = knows ? 20.0f : 0.0f;  // of the first frame behind them there should be none
      frames(10, 10, 2);
      EXPECT_EQ(renderer->read().counters().not_finite, 0u);
      after[knows ? 1 : 0].push_back(image_hash(*renderer));
      s.restir_gi_history = 20;
    }
    EXPECT_EQ(after[0], after[1]) << estimator;
  }
}

TEST_F(RestirTest, CutsSizesAndScalesLeaveNothingBehind) {
  RenderSettings s = reuse_settings(2, "restir_gi");
  const scene::FrameSnapshot scene = scene::furnace(0.6f, 0.7f, true);
  const double expected = 0.7 * (1 + 0.6 + 0.36);
  auto renderer = make_renderer(s, 64, 48);
  const auto expect_mean = [&](const std::string& what) {
    const ImageEstimate e = image_estimate(renderer->read().linear());
    EXPECT_NEAR(e.mean, expected, 6 * e.error + 1e-5 * expected) << what;  // neighbours' samples are alike
    EXPECT_EQ(renderer->read().counters().not_finite, 0u) << what;
  };
  render_still(*renderer, scene, s, 4);
  expect_mean("four frames");
  scene::FrameSnapshot cut = scene;
  cut.cut = true;
  renderer->render(cut, nullptr, s);
  expect_mean("a cut");
  for (const uvec2 size : {uvec2(48, 64), uvec2(33, 47), uvec2(1, 1), uvec2(97, 80)}) {
    renderer->resize(size.x, size.y);
    render_still(*renderer, scene, s, 3);
    if (size.x > 1) expect_mean("a resize");
  }
  for (const float scale : {0.5f, 0.25f, 1.0f}) {
    s.light_scale = scale;
    render_still(*renderer, scene, s, 3);
    if (scale == 1.0f) expect_mean("light at all pixels again");
    EXPECT_EQ(renderer->read().counters().not_finite, 0u);
  }
  for (const float history : {0.0f, 1000.0f}) {
    for (const int neighbors : {0, 8}) {
      s.restir_history = s.restir_gi_history = history;
      s.restir_neighbors = s.restir_gi_neighbors = neighbors;
      render_still(*renderer, scene, s, 4);
      expect_mean("history and neighbours");
    }
  }
  for (const int candidates : {1, 2}) {
    s.restir_candidates = candidates;
    render_still(*renderer, scene, s, 4);
    expect_mean("what scattered rays meet");
  }
  s.restir_gi_radiance = 1;
  renderer->reset_learning();  // samples of before have no light with them
  render_still(*renderer, scene, s, 4);
  expect_mean("samples that keep their light, of walls that send the same to all");
}

// No W is 64 times the mean of a square of 64.
TEST_F(RestirSequences, BoilingEmptiesWhatStandsOut) {
  const scene::FrameSnapshot scene = scene::light_of_every_kind();
  std::uint64_t hashes[2] = {};
  double means[3] = {};
  const float limits[3] = {0, 64, 1};
  for (int i = 0; i < 3; ++i) {
    RenderSettings s = reuse_settings(2, "restir_gi");
    s.deterministic = 1;
    s.restir_boiling = limits[i];
    auto renderer = make_renderer(s, 64, 48);
    render_still(*renderer, scene, s, 6);
    means[i] = mean_of(*renderer);
    if (i < 2) hashes[i] = image_hash(*renderer);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_LT(means[2], 0.9 * means[0]);
  EXPECT_GT(means[2], 0);
}

// Confidence of a history that all pixels share.
TEST_F(RestirTest, AHistoryThatPixelsShareCountsAsLess) {
  const scene::FrameSnapshot scene = scene::cornell_box();
  double confidence[2] = {};
  for (const bool counts : {false, true}) {
    RenderSettings s = reuse_settings(1);
    s.restir_history = 4;
    s.restir_neighbors = 8;
    s.restir_duplicates = counts ? 1 : 0;
    s.auto_exposure = s.fxaa = s.tone_map = 0;
    s.debug_view = static_cast<int>(shared::kViewRestirConfidence);
    auto renderer = make_renderer(s, 48, 36);
    render_still(*renderer, scene, s, 16);
    for (const std::uint32_t pixel : renderer->read().output()) confidence[counts ? 1 : 0] += (pixel >> 8u) & 255u;
  }
  EXPECT_LT(confidence[1], 0.95 * confidence[0]) << confidence[0];
}

TEST_F(RestirSequences, TheSamePicturesAgain) {
  const scene::FrameSnapshot scene = scene::light_of_every_kind();
  for (const char* estimator : {"restir_gi", "restir_guided"}) {
    RenderSettings s = reuse_settings(2, estimator);
    s.deterministic = 1;
    if (s.estimator == "restir_guided") {
      s.restir_candidates = 2;
      s.restir_boiling = 20;
      s.restir_duplicates = 1;
    }
    std::vector<std::uint64_t> hashes[2];
    for (std::vector<std::uint64_t>& of_run : hashes) {
      auto renderer = make_renderer(s, 48, 32);
      for (int frame = 0; frame < 20; ++frame) {
        renderer->render(scene, nullptr, s);
        of_run.push_back(image_hash(*renderer));
      }
    }
    EXPECT_EQ(hashes[0], hashes[1]) << estimator;
  }
}

// Forgotten is as if it had never been.
TEST_F(RestirTest, ForgettingStartsAnew) {
  RenderSettings s = reuse_settings(2, "restir_gi");
  s.deterministic = 1;
  const scene::FrameSnapshot scene = scene::light_of_every_kind();
  auto renderer = make_renderer(s, 48, 32);
  renderer->render(scene, nullptr, s);
  const std::uint64_t fresh = image_hash(*renderer);
  render_still(*renderer, scene, s, 3);
  renderer->reset_learning();  // the view goes on: the former frame is there
  renderer->render(scene, nullptr, s);
  EXPECT_EQ(image_hash(*renderer), fresh);
}

// Where light is sampled at one pixel of four, whose turn it is another's in the next frame.
TEST_F(RestirSequences, LightAtOnePixelOfFourHasTheSameMean) {
  const scene::FrameSnapshot scene = scene::cornell_box();
  Means of[2];
  for (const bool reuses : {false, true}) {
    for (int run = 0; run < 16; ++run) {
      RenderSettings s = denoising();
      s.estimator = reuses ? "restir_gi" : "nee";
      s.light_scale = 0.5f;
      s.accumulate = 1;
      s.seed = run;
      auto renderer = make_renderer(s, 40, 30);
      render_still(*renderer, scene, s, 16);
      of[reuses ? 1 : 0].add(mean_of(*renderer));
    }
  }
  expect_equal(of[1], of[0], 0.02);
}

// A sample stays at its pixel: what a reservoir held in the former frame is found there, and not beside it.
TEST_F(RestirTest, SamplesStayAtTheirPixels) {
  const scene::FrameSnapshot scene = scene::light_of_every_kind();
  RenderSettings s = reuse_settings(1);
  s.restir_neighbors = 0;
  s.auto_exposure = s.fxaa = s.tone_map = 0;
  s.debug_view = static_cast<int>(shared::kViewRestirLamp);
  constexpr int kWidth = 64, kHeight = 48;
  auto renderer = make_renderer(s, kWidth, kHeight);
  render_still(*renderer, scene, s, 24);
  const std::vector<std::uint32_t> former = renderer->read().output();
  render_still(*renderer, scene, s, 1);
  const std::vector<std::uint32_t> now = renderer->read().output();
  int same = 0, beside = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x + 1 < kWidth; ++x) {
      const auto at = static_cast<std::size_t>(y * kWidth + x);
      same += now[at] == former[at] ? 1 : 0;
      beside += now[at] == former[at + 1] ? 1 : 0;
    }
  }
  EXPECT_GT(same, 1.2 * beside);
}

// Another sample of the picture is no cut: what the former frame held is still of use.
TEST_F(RestirTest, AccumulationBeginsAnewAndHistoryGoesOn) {
  const scene::FrameSnapshot scene = scene::light_of_every_kind();
  std::uint64_t hashes[2] = {};
  for (const bool history : {false, true}) {
    RenderSettings s = reuse_settings(2, "restir_gi");
    s.deterministic = 1;
    s.accumulate = 1;
    if (!history) s.restir_history = s.restir_gi_history = 0;
    auto renderer = make_renderer(s, 48, 32);
    for (int frame = 0; frame < 3; ++frame) {
      renderer->restart_accumulation();
      render_still(*renderer, scene, s, 1);
    }
    hashes[history ? 1 : 0] = image_hash(*renderer);
  }
  EXPECT_NE(hashes[0], hashes[1]);
}

// Panels of which one is lit, and sends its light to the floor; in every second frame the scene has its things in
// another order, so that a sample which kept a number of the former frame's would mean another panel.
class PanelsInTurn {
 public:
  PanelsInTurn() {
    const std::uint32_t grey = scene::add_material(*assets_, "panel", vec3(0.8f));
    const std::uint32_t glow = scene::add_material(*assets_, "lamp", vec3(0.0f), vec3(40.0f));
    const std::uint32_t dark = scene::add_material(*assets_, "dark", vec3(0.5f));
    scene::Mesh ground, panel, light;
    scene::add_quad(ground, {-64, -64, 0}, {128, 0, 0}, {0, 128, 0}, dark);
    scene::add_quad(panel, {-40, 0, -40}, {80, 0, 0}, {0, 0, 80}, grey);
    scene::add_quad(light, {-8, 0, -8}, {16, 0, 0}, {0, 0, 16}, glow);
    ground_ = scene::add_finished(*assets_, std::move(ground), "ground");
    panel_ = scene::add_finished(*assets_, std::move(panel), "panel");
    light_ = scene::add_finished(*assets_, std::move(light), "light");
  }
  scene::FrameSnapshot in_order(bool forward) const {
    scene::FrameSnapshot s = scene::still(assets_, scene::camera_at({0, -20, 90}, {80, 90, 0}, 70));
    s.instances.push_back(scene::make_instance(scene::kIdWorld, ground_));
    std::vector<scene::Instance> things;
    const auto at = [](float x, float y, float z) {
      return mat4x3(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(x, y, z));
    };
    for (int i = 0; i < 4; ++i)
      things.push_back(scene::make_instance(static_cast<std::uint32_t>(100 + i), panel_,
                                            at(0, 64.0f + 40.0f * static_cast<float>(i), 45)));
    // Right before the first panel, facing it: hidden from the floor by what it is mounted on.
    things.push_back(scene::make_instance(200, light_, at(0, 48, 45)));
    things.push_back(scene::make_instance(201, panel_, at(0, 47, 85)));
    if (!forward) std::reverse(things.begin(), things.end());
    s.instances.insert(s.instances.end(), things.begin(), things.end());
    return s;
  }

 private:
  std::shared_ptr<scene::Assets> assets_ = scene::new_code_assets();
  std::uint32_t ground_, panel_, light_;
};

TEST_F(RestirSequences, SamplesFollowThingsThatChangeTheirPlaceInTheTable) {
  const PanelsInTurn panels;
  Means of[2];
  for (const bool reuses : {false, true}) {
    for (int run = 0; run < 24; ++run) {
      RenderSettings s = reuse_settings(2, reuses ? "restir_gi" : "nee");
      s.seed = run;
      auto renderer = make_renderer(s, 32, 24);
      double m = 0;
      for (int frame = 0; frame < 12; ++frame) {
        renderer->render(panels.in_order(frame % 2 == 0), nullptr, s);
        if (frame >= 4) m += mean_of(*renderer) / 8;
      }
      of[reuses ? 1 : 0].add(m);
    }
  }
  expect_equal(of[1], of[0], 0.03);
}

}  // namespace
}  // namespace fb::render
