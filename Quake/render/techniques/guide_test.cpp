// Path guiding in the whole renderer: the right mean whatever is set and however full the tables are, far from the
// origin, through changes of size and settings; and its memory.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <vector>
#include <algorithm>

#include "base/hash.h"
#include "render/test_denoiser.h"
#include "render/test_device.h"
#include "render/test_image.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_in_motion.h"
#include "scene/shapes.h"

namespace fb::render {
namespace {

class GuideTest : public DeviceTest {
 protected:
  // A frame of the rocket's flight without noise to speak of.
  static std::vector<vec4> rocket_reference(const std::shared_ptr<const scene::Assets>& assets, std::uint64_t frame,
                                            const uvec2& size) {
    RenderSettings s;
    s.estimator = "nee";
    s.spp = 64;
    s.jitter = 0;
    s.seed = 77;
    auto renderer = make_renderer(s, size.x, size.y);
    for (int i = 0; i < 4; ++i) renderer->render(scene::rocket(assets, frame, 60), nullptr, s);
    return renderer->read().linear();
  }
};

RenderSettings guided(int spp, int bounces, const std::function<void(RenderSettings&)>& change = {}) {
  RenderSettings s;
  s.estimator = "mcpg";
  s.spp = spp;
  s.bounces = bounces;
  if (change) change(s);
  return s;
}

void render_frames(Renderer& renderer, const scene::FrameSnapshot& snapshot, const RenderSettings& settings,
                   int frames) {
  for (int i = 0; i < frames; ++i) renderer.render(snapshot, nullptr, settings);
}

constexpr float kAlbedo = 0.6f, kEmission = 0.7f;
scene::FrameSnapshot furnace() { return scene::furnace(kAlbedo, kEmission, true); }

// 4.5 standard errors, and rounding (lost rays are in the errors).
void expect_furnace(const Renderer& renderer, int bounces, double albedo, const std::string& what) {
  double expected = 0;
  for (int k = 0; k <= bounces; ++k) expected += std::pow(albedo, k);
  expected *= static_cast<double>(kEmission);
  const ImageEstimate e = image_estimate(renderer.read().linear());
  EXPECT_NEAR(e.mean, expected, 4.5 * e.error + 4e-6 * expected) << what;
  EXPECT_LT(e.error, 0.01 * expected) << what << ": the test can see little";
  EXPECT_EQ(renderer.read().counters().not_finite, 0u) << what;
  EXPECT_EQ(renderer.read().counters().states_not_finite, 0u) << what;
}

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

TEST_F(GuideTest, FurnaceHasItsClosedFormWithEveryFeature) {
  // One for all: a change of settings in mid-flight keeps what was learnt, and starts the frame's numbers anew.
  auto renderer = make_renderer(guided(1, 2), 64, 48);
  const scene::FrameSnapshot scene = furnace();
  for (const auto& [name, change] : kFeatures) {
    const RenderSettings s = guided(4, 2, change);
    render_frames(*renderer, scene, s, 6);  // cold and warm frames alike
    expect_furnace(*renderer, 2, static_cast<double>(kAlbedo), name);
  }
}

TEST_F(GuideTest, FurnaceHasItsClosedFormThirtyThousandUnitsAway) {
  for (const vec3& by : {vec3(30000, 30000, 30000), vec3(-30000, 29999.7f, -32500)}) {
    auto renderer = make_renderer(guided(1, 2), 64, 48);
    const scene::FrameSnapshot scene = moved(furnace(), by);
    for (const auto& [name, change] : kFeatures) {
      if (name != std::string("defaults") && name != std::string("extreme numbers")) continue;
      const RenderSettings s = guided(4, 2, change);
      render_frames(*renderer, scene, s, 6);
      // Positions are rounded to 2^-9 there, so more rays start or end behind a surface.
      const ImageEstimate e = image_estimate(renderer->read().linear());
      const double a = static_cast<double>(kAlbedo), expected = static_cast<double>(kEmission) * (1 + a + a * a);
      EXPECT_NEAR(e.mean, expected, 4.5 * e.error + 1e-3 * expected) << name;
      EXPECT_EQ(renderer->read().counters().not_finite + renderer->read().counters().states_not_finite, 0u) << name;
    }
  }
}

// A state knows how fast its light moves; where it is depends on the time that has passed, not on the number of frames.
TEST_F(GuideTest, FollowsALightThroughFramesOfUnevenLength) {
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

// With r_deterministic, as where a device runs all paths at once, a state takes one sample of each part of a frame.
class GuideAtOnceTest : public GuideTest {
 protected:
  // Mean of the logarithm of the squared error of frames of a rocket's flight.
  double rocket_error(const std::string& estimator, int parts, std::uint64_t first, std::uint64_t last) {
    const auto assets = scene::rocket_assets();
    double sum = 0;
    for (std::uint64_t judged = first; judged <= last; ++judged) {
      const std::vector<vec4>& truth = truth_of(assets, judged);
      for (int seed = 0; seed < kSeeds; ++seed) {
        const RenderSettings s = guided(1, 2, [&](RenderSettings& r) {
          r.estimator = estimator;
          r.jitter = r.accumulate = 0;
          r.seed = seed;
          r.deterministic = 1;
          r.mc_parts = parts;
        });
        auto renderer = make_renderer(s, kSize.x, kSize.y);
        for (std::uint64_t frame = 0; frame <= judged; ++frame)
          renderer->render(scene::rocket(assets, frame, 60), nullptr, s);
        sum += std::log(mean_square_difference(renderer->read().linear(), truth));
      }
    }
    return sum / static_cast<double>(kSeeds * (last - first + 1));
  }

 private:
  static constexpr int kSeeds = 4;
  static constexpr uvec2 kSize{96, 54};
  const std::vector<vec4>& truth_of(const std::shared_ptr<const scene::Assets>& assets, std::uint64_t frame) {
    std::vector<vec4>& truth = truths_[frame];
    if (truth.empty()) truth = rocket_reference(assets, frame, kSize);
    return truth;
  }
  std::map<std::uint64_t, std::vector<vec4>> truths_;
};

TEST_F(GuideAtOnceTest, APartOfAFrameLearnsFromThoseBefore) {
  const double gain = std::exp(rocket_error("mcpg", 1, 3, 5) - rocket_error("mcpg", 0, 3, 5));
  RecordProperty("gain", std::to_string(gain));
  EXPECT_GT(gain, 2);
}

// Else a state forgets where its light is by what those found who do not see it.
TEST_F(GuideAtOnceTest, ASightOutranksAMiss) {
  const double gain = std::exp(rocket_error("pt", 1, 11, 13) - rocket_error("mcpg", 1, 11, 13));
  RecordProperty("gain", std::to_string(gain));
  EXPECT_GT(gain, 8);
}

// A face of sky near by shows a sun that is far off: what one point learns of it must serve its neighbours.
TEST_F(GuideTest, ASunIsADirection) {
  auto assets = scene::new_code_assets();
  const std::uint32_t ground = scene::add_material(*assets, "ground", vec3(0.5f));
  const std::uint32_t sky = scene::add_material(*assets, "sky", vec3(0.0f), vec3(1.0f));
  assets->materials[sky].emission_kind = scene::EmissionKind::kSky;
  scene::Mesh place;
  scene::add_quad(place, {-512, -512, 0}, {1024, 0, 0}, {0, 1024, 0}, ground);
  scene::add_quad(place, {-768, -768, 160}, {0, 1536, 0}, {1536, 0, 0}, sky);
  scene::FrameSnapshot snapshot = scene::still(assets, scene::camera_at({-200, 0, 120}, {40, 0, 0}, 90));
  snapshot.instances.push_back(
      scene::make_instance(scene::kIdWorld, scene::add_finished(*assets, std::move(place), "place")));
  snapshot.sky.mode = scene::SkyMode::kConstant;
  snapshot.sky.color = vec3(0.0f);
  snapshot.sky.suns = {{glm::normalize(vec3(0.5f, 0.2f, 1.0f)), vec3(1000), 1.5f}};
  double variance[2] = {};
  for (const bool guides : {false, true}) {
    RenderSettings s = guided(1, 1, [](RenderSettings& r) { r.accumulate = 0; });
    if (!guides) s.estimator = "pt";
    auto renderer = make_renderer(s, 96, 54);
    render_frames(*renderer, snapshot, s, 24);
    for (int frame = 0; frame < 8; ++frame) {
      renderer->render(snapshot, nullptr, s);
      const ImageEstimate e = image_estimate(renderer->read().linear());
      variance[guides ? 1 : 0] += e.error * e.error;
    }
  }
  RecordProperty("gain", std::to_string(variance[0] / variance[1]));
  EXPECT_GT(variance[0] / variance[1], 50);
}

TEST_F(GuideTest, EveryNumberOfBouncesAndSamples) {
  auto renderer = make_renderer(guided(1, 2), 64, 48);
  for (const int deterministic : {0, 1}) {
    for (const int bounces : {0, 1, 4}) {
      for (int spp = 1; spp <= 4; ++spp) {
        const RenderSettings s = guided(spp, bounces, [&](RenderSettings& r) { r.deterministic = deterministic; });
        render_frames(*renderer, furnace(), s, 4);
        expect_furnace(*renderer, bounces, static_cast<double>(kAlbedo), "bounces and samples");
      }
    }
  }
}

TEST_F(GuideTest, ResizingKeepsTheMean) {
  for (const int deterministic : {0, 1}) {
    const RenderSettings s = guided(2, 2, [&](RenderSettings& r) { r.deterministic = deterministic; });
    auto renderer = make_renderer(s, 64, 48);
    for (const uvec2 size : {uvec2(64, 48), uvec2(33, 47), uvec2(1, 1), uvec2(97, 80)}) {
      renderer->resize(size.x, size.y);
      render_frames(*renderer, furnace(), s, 4);
      if (size.x > 1) expect_furnace(*renderer, 2, static_cast<double>(kAlbedo), "after a resize");
    }
  }
}

// Each shape is a shader of its own, and wide mixtures take long to compile: with FULLBRIGHT_UNBIASED_TIMES there are
// more.
TEST_F(GuideTest, EveryShapeOfTheMixture) {
  std::vector<std::pair<int, int>> shapes{{1, 1}, {16, 1}, {2, 16}};
  if (std::getenv("FULLBRIGHT_UNBIASED_TIMES") != nullptr) shapes.insert(shapes.end(), {{1, 16}, {4, 8}, {3, 3}});
  for (const auto& [accesses, bucket] : shapes) {
    const RenderSettings s = guided(2, 2, [&, a = accesses, b = bucket](RenderSettings& r) {
      r.mc_accesses = a;
      r.mc_bucket = b;
    });
    auto renderer = make_renderer(s, 64, 48);
    render_frames(*renderer, furnace(), s, 6);
    expect_furnace(*renderer, 2, static_cast<double>(kAlbedo),
                   std::to_string(accesses) + " cells of " + std::to_string(bucket));
  }
}

// Hundreds of cells want each slot: states of all kinds of places are thrown out all the time, and the mean stays.
TEST_F(GuideTest, FullTablesKeepTheMean) {
  const auto full = [](RenderSettings& s) { s.mc_states = s.mc_cells = 1024; };
  for (const auto& scene : {scene::cornell_box(), scene::many_lights(200)}) {
    ImageEstimate found[2];
    for (const bool guide : {false, true}) {
      RenderSettings s = guided(4, 2, full);
      if (!guide) s.estimator = "pt";
      s.seed = guide ? 1 : 0;
      auto renderer = make_renderer(s, 64, 48);
      render_frames(*renderer, scene, s, guide ? 48 : 96);
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

TEST_F(GuideTest, ForgettingIsAsIfNothingHadBeenLearnt) {
  const RenderSettings s = guided(2, 2, [](RenderSettings& r) { r.deterministic = 1; });
  const scene::FrameSnapshot scene = scene::many_lights(50);
  auto renderer = make_renderer(s, 64, 48);
  renderer->render(scene, nullptr, s);
  const std::uint64_t fresh = image_hash(*renderer);
  render_frames(*renderer, scene, s, 5);
  renderer->restart_accumulation();
  renderer->render(scene, nullptr, s);
  EXPECT_NE(image_hash(*renderer), fresh) << "what was learnt shows";
  renderer->restart_accumulation();
  renderer->reset_learning();
  renderer->render(scene, nullptr, s);
  EXPECT_EQ(image_hash(*renderer), fresh);
  // Another scene is another world.
  render_frames(*renderer, furnace(), s, 3);
  renderer->render(scene, nullptr, s);
  EXPECT_EQ(image_hash(*renderer), fresh);
}

TEST_F(GuideTest, ItsMemoryIsGivenBackWhenNothingLearns) {
  RenderSettings pt = guided(2, 2);
  pt.estimator = "pt";
  auto renderer = make_renderer(pt, 64, 48);
  const scene::FrameSnapshot scene = furnace();
  renderer->render(scene, nullptr, pt);
  const std::uint64_t before = renderer->device_bytes();
  EXPECT_EQ(renderer->learnt_bytes(), 0u);
  for (int round = 0; round < 3; ++round) {
    for (const int states : {1024, 100000}) {
      const RenderSettings s =
          guided(2, 2, [&](RenderSettings& r) { r.mc_states = states, r.deterministic = round == 1; });
      render_frames(*renderer, scene, s, 2);
      EXPECT_GE(renderer->learnt_bytes(), static_cast<std::uint64_t>(states) * 24);
      EXPECT_GE(renderer->device_bytes(), before + renderer->learnt_bytes());
    }
    renderer->render(scene, nullptr, pt);
    EXPECT_EQ(renderer->learnt_bytes(), 0u);
    EXPECT_EQ(renderer->device_bytes(), before);
  }
}

// The mean of the view of the cache: what its cells say is reflected, on the screen's scale.
class CacheTest : public GuideTest {
 protected:
  double brightness(RenderSettings s, int frames) {
    s.debug_view = 27;
    s.auto_exposure = s.fxaa = s.tone_map = 0;
    s.mc_cache_pixels = 64;
    auto renderer = make_renderer(s, 16, 12);
    render_frames(*renderer, scene::furnace(kAlbedo, kEmission), s, frames);
    double sum = 0;
    for (const std::uint32_t pixel : renderer->read().output())
      sum += (pixel >> 8u) & 255u;  // a missing cell has no green
    return sum / (16 * 12);
  }
};

// Sums and counts of a cell's samples stay within their words however many a frame brings: the cache is as bright with
// 4096 samples a pixel as with 4.
TEST_F(CacheTest, CellsBearAnyNumberOfSamplesAFrame) {
  const double few = brightness(guided(4, 1), 24), many = brightness(guided(4096, 1), 3);
  EXPECT_GT(few, 100);
  EXPECT_NEAR(many, few, 0.05 * few);
}

// Light that was looked for counts in it like light that was met.
TEST_F(CacheTest, IsTheSameWhicheverWayLightsAreFound) {
  const double met = brightness(guided(16, 1), 24);
  const double looked_for = brightness(guided(16, 1, [](RenderSettings& r) { r.estimator = "mcpg_nee"; }), 24);
  EXPECT_NEAR(looked_for, met, 0.05 * met);
}

}  // namespace
}  // namespace fb::render
