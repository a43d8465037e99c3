// Looking for light with the memory of what shadow rays reached: a sun that stands behind walls costs little once it
// was looked for in vain, and the mean is the same throughout.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "render/techniques/test_seen_grid.h"
#include "render/test_image.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

constexpr int kFrames = 24;

// A room with a lamp, behind whose back wall bright boxes have nearly all of the list's power.
scene::FrameSnapshot room_with_neighbours(std::uint32_t boxes = 64, float radiance = 5) {
  constexpr std::uint32_t kLamp = 3;  // of its materials
  scene::FrameSnapshot snapshot = scene::cornell_box();
  for (std::uint32_t i = 0; i < boxes; ++i) {
    const vec3 position(700.0f + 200.0f * static_cast<float>(i % 8), 0, 200.0f * static_cast<float>(i / 8));
    snapshot.instances.push_back(scene::glowing(scene::kIdEntity + 100 + i, snapshot.instances.back().mesh, kLamp,
                                                position, vec3(150), vec3(radiance)));
  }
  return snapshot;
}

// Of the red channel: means over the pixels, of squares also over all but the worst of a hundred: single samples that
// graze a lamp are half of the whole.
struct Difference {
  double bias = 0, square = 0, trimmed = 0;
};
Difference difference(const std::vector<vec4>& image, const std::vector<vec4>& truth) {
  Difference d;
  std::vector<double> squares;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double x = static_cast<double>(image[i].x) - static_cast<double>(truth[i].x);
    d.bias += x / static_cast<double>(image.size());
    squares.push_back(x * x / static_cast<double>(image.size()));
  }
  std::sort(squares.begin(), squares.end());
  d.square = std::accumulate(squares.begin(), squares.end(), 0.0);
  d.trimmed = std::accumulate(squares.begin(), squares.end() - static_cast<std::ptrdiff_t>(squares.size() / 100), 0.0);
  return d;
}

// Frames that remember nothing and frames that learn, against many samples of `pt`: trimmed squares of both, and how
// far the mean of the latter is off, with its error; in the picture's own mean.
struct Memory {
  double fresh = 0, learnt = 0, bias = 0, error = 0;
};

class SeenGridStatistics : public SeenGridTest {
 protected:
  static Memory memory_in(const scene::FrameSnapshot& scene, std::unique_ptr<Renderer> renderer,
                          const RenderSettings& how = {}) {
    RenderSettings truth_settings = looking(1);
    truth_settings.estimator = "pt";
    truth_settings.accumulate = 1;
    truth_settings.spp = 64;
    truth_settings.bounces = how.bounces;
    for (int i = 0; i < 32; ++i) renderer->render(scene, nullptr, truth_settings);
    const std::vector<vec4> truth = renderer->read().linear();
    double truth_variance = 0, mean = 0;
    for (const vec4& v : renderer->read().variance_of_mean()) truth_variance += static_cast<double>(v.x);
    for (const vec4& p : truth) mean += static_cast<double>(p.x);
    const double pixels = static_cast<double>(truth.size());
    mean /= pixels;

    Memory m;
    double square = 0;
    const auto settings = [&](int seed) {
      RenderSettings s = looking(seed);
      s.nee_candidates = how.nee_candidates;
      s.nee_remembered = how.nee_remembered;
      s.bounces = how.bounces;
      return s;
    };
    for (int i = 0; i < kFrames; ++i) {
      renderer->reset_learning();
      renderer->render(scene, nullptr, settings(i + 2));
      m.fresh += difference(renderer->read().linear(), truth).trimmed / kFrames;
    }
    for (int i = 0; i < kFrames; ++i) {
      renderer->render(scene, nullptr, settings(i + 2));
      const Difference d = difference(renderer->read().linear(), truth);
      m.learnt += d.trimmed / kFrames;
      square += d.square / kFrames;
      m.bias += d.bias / kFrames / mean;
    }
    m.error = std::sqrt(square / (pixels * kFrames) + truth_variance / (pixels * pixels)) / mean;
    return m;
  }
};

TEST_F(SeenGridStatistics, WhatIsNeverReachedIsSeldomLookedFor) {
  const Memory sun = memory_in(room_without_view(), make_renderer(looking(1), 64, 48));
  EXPECT_LT(sun.learnt, 0.85 * sun.fresh);
  EXPECT_NEAR(sun.bias, 0.0, 4.5 * sun.error);
  EXPECT_LT(sun.error, 0.01) << "the test can see little";
}

TEST_F(SeenGridStatistics, LampsThatWereFoundAreLookedForAgain) {
  const Memory lamps = memory_in(room_with_neighbours(), make_renderer(looking(1), 64, 48));
  EXPECT_LT(lamps.learnt, 0.3 * lamps.fresh);
  EXPECT_NEAR(lamps.bias, 0.0, 4.5 * lamps.error);
  EXPECT_LT(lamps.error, 0.01) << "the test can see little";
}

// No lamp is remembered, but nearly all draws of the list have the room's.
TEST_F(SeenGridStatistics, WaysThatWereShutAreSeldomTried) {
  RenderSettings how;
  how.nee_candidates = 128;
  how.nee_remembered = 0;
  how.bounces = 1;
  const Memory ways = memory_in(room_with_neighbours(8, 40), make_renderer(looking(1), 64, 48), how);
  EXPECT_LT(ways.learnt, 0.75 * ways.fresh);
  EXPECT_NEAR(ways.bias, 0.0, 4.5 * ways.error);
  EXPECT_LT(ways.error, 0.01) << "the test can see little";
}

// Where all walls glow, light that is looked for and light that is met have like densities: a share that is wrong
// shows.
TEST_F(SeenGridStatistics, FurnaceHasItsClosedForm) {
  constexpr double kAlbedo = 0.6, kEmission = 0.7;
  const scene::FrameSnapshot scene = scene::furnace(0.6f, 0.7f, true);
  double expected = kEmission, reflected = kEmission;
  for (int bounces = 1; bounces <= 3; ++bounces) {
    expected += reflected *= kAlbedo;
    RenderSettings s = looking(bounces);
    s.bounces = bounces;
    s.spp = 64;
    auto renderer = make_renderer(s, 64, 48);
    // Learnt, too.
    for (int frame = 0; frame < bounces; ++frame) renderer->render(scene, nullptr, s);
    const ImageEstimate e = image_estimate(renderer->read().linear());
    EXPECT_NEAR(e.mean, expected, 4.5 * e.error + 4e-6 * expected) << bounces;
    EXPECT_LT(e.error, 0.003 * expected) << bounces << ": the test can see little";
  }
}

}  // namespace
}  // namespace fb::render
