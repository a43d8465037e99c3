// Path guiding in the whole renderer: what parts of a frame learn from each other, what a sun is to it, changes of
// size, and its memory. Its mean: guide_statistics_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/techniques/test_guide.h"
#include "render/test_denoiser.h"
#include "render/test_image.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_in_motion.h"
#include "scene/shapes.h"

namespace fb::render {
namespace {

using GuideSequences = GuideTest;

// With r_deterministic, as where a device runs all paths at once, a state takes one sample of each part of a frame.
class GuideAtOnceSequences : public GuideTest {
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

TEST_F(GuideAtOnceSequences, APartOfAFrameLearnsFromThoseBefore) {
  const double gain = std::exp(rocket_error("mcpg", 1, 3, 5) - rocket_error("mcpg", 0, 3, 5));
  RecordProperty("gain", std::to_string(gain));
  EXPECT_GT(gain, 2);
}

// Else a state forgets where its light is by what those found who do not see it.
TEST_F(GuideAtOnceSequences, ASightOutranksAMiss) {
  const double gain = std::exp(rocket_error("pt", 1, 11, 13) - rocket_error("mcpg", 1, 11, 13));
  RecordProperty("gain", std::to_string(gain));
  EXPECT_GT(gain, 8);
}

// A face of sky near by shows a sun that is far off: what one point learns of it must serve its neighbours.
TEST_F(GuideSequences, ASunIsADirection) {
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
    render_still(*renderer, snapshot, s, 24);
    for (int frame = 0; frame < 8; ++frame) {
      renderer->render(snapshot, nullptr, s);
      const ImageEstimate e = image_estimate(renderer->read().linear());
      variance[guides ? 1 : 0] += e.error * e.error;
    }
  }
  RecordProperty("gain", std::to_string(variance[0] / variance[1]));
  EXPECT_GT(variance[0] / variance[1], 50);
}

TEST_F(GuideSequences, ResizingKeepsTheMean) {
  for (const int deterministic : {0, 1}) {
    const RenderSettings s = guided(2, 2, [&](RenderSettings& r) { r.deterministic = deterministic; });
    auto renderer = make_renderer(s, 64, 48);
    for (const uvec2 size : {uvec2(64, 48), uvec2(33, 47), uvec2(1, 1), uvec2(97, 80)}) {
      renderer->resize(size.x, size.y);
      render_still(*renderer, furnace(), s, 4);
      if (size.x > 1) expect_furnace(*renderer, 2, static_cast<double>(kAlbedo), "after a resize");
    }
  }
}

TEST_F(GuideTest, ForgettingIsAsIfNothingHadBeenLearnt) {
  const RenderSettings s = guided(2, 2, [](RenderSettings& r) { r.deterministic = 1; });
  const scene::FrameSnapshot scene = scene::many_lights(50);
  auto renderer = make_renderer(s, 64, 48);
  renderer->render(scene, nullptr, s);
  const std::uint64_t fresh = image_hash(*renderer);
  render_still(*renderer, scene, s, 5);
  renderer->restart_accumulation();
  renderer->render(scene, nullptr, s);
  EXPECT_NE(image_hash(*renderer), fresh) << "what was learnt shows";
  renderer->restart_accumulation();
  renderer->reset_learning();
  renderer->render(scene, nullptr, s);
  EXPECT_EQ(image_hash(*renderer), fresh);
  // Another scene is another world.
  render_still(*renderer, furnace(), s, 3);
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
      render_still(*renderer, scene, s, 2);
      EXPECT_GE(renderer->learnt_bytes(), static_cast<std::uint64_t>(states) * 24);
      EXPECT_GE(renderer->device_bytes(), before + renderer->learnt_bytes());
    }
    renderer->render(scene, nullptr, pt);
    EXPECT_EQ(renderer->learnt_bytes(), 0u);
    EXPECT_EQ(renderer->device_bytes(), before);
  }
}

}  // namespace
}  // namespace fb::render
