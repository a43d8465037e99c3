// Screen-space mixtures where it is hard: what moves, light without end, states that are all invalid or as narrow and
// as wide as can be, pixels without paths, and a demo that goes back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "render/techniques/test_ssmm.h"
#include "render/techniques/test_wall.h"
#include "render/test_image.h"
#include "render/test_means.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scenes_in_code.h"
#include "scene/in_code/scenes_of_water.h"
#include "scene/shapes.h"

namespace fb::render {
namespace {

constexpr std::uint32_t kWidth = 48, kHeight = 36;

class SsmmHardTest : public SsmmTest {
 protected:
  static RenderSettings hard_settings() {
    RenderSettings s = ssmm_settings("ssmm");
    s.bounces = 1;
    s.jitter = 0;
    return s;
  }
  // The states that pixels sample from in a frame of `moved` after some of `still`.
  static std::vector<std::uint32_t> states_after(const scene::FrameSnapshot& still, const scene::FrameSnapshot& moved,
                                                 int neighbors) {
    RenderSettings s = hard_settings();
    s.ssmm_prior_cosine = 0.99f;
    auto renderer = make_renderer(s, kWidth, kHeight);
    render_still(*renderer, still, s, 6);
    s.ssmm_neighbors = neighbors;
    s.ssmm_window = 1;  // neighbours are the pixel itself
    return view_of(*renderer, moved, s, shared::kViewSsmmCount);
  }
};

using SsmmHardSequences = SsmmHardTest;

// A pixel finds the state of the surface that it sees, wherever that was on the screen, and so do its neighbours: when
// the camera moves along the wall, and when the wall moves.
TEST_F(SsmmHardTest, StatesAreFoundWhereTheSurfaceWas) {
  constexpr int kPixels = 5;
  const scene::FrameSnapshot still = wall_under_a_lamp();
  const float units = static_cast<float>(kPixels) * 200.0f / static_cast<float>(kWidth);
  scene::FrameSnapshot camera = still, wall = still;
  camera.camera.position.y = units;  // to the left: what a pixel sees was further left
  wall.instances[0].transform[3].y = units;
  for (const int neighbors : {0, 5}) {
    const std::vector<std::uint32_t> before = states_after(still, still, neighbors);
    int alike = 0, valid = 0;
    for (const auto& [moved, shift] : {std::pair(&camera, -kPixels), std::pair(&wall, kPixels)}) {
      const std::vector<std::uint32_t> after = states_after(still, *moved, neighbors);
      for (int y = 0; y < static_cast<int>(kHeight); ++y) {
        for (int x = 0; x < static_cast<int>(kWidth); ++x) {
          const int was = x + shift;
          const std::size_t row = static_cast<std::size_t>(y) * kWidth;
          const bool inside = was >= 0 && was < static_cast<int>(kWidth);
          const std::uint32_t expected = inside ? before[row + static_cast<std::size_t>(was)] : 0;
          const std::uint32_t found = after[row + static_cast<std::size_t>(x)];
          ASSERT_EQ(found, expected) << x << ' ' << y << ", shift " << shift << ", neighbours " << neighbors;
          alike += found == before[row + static_cast<std::size_t>(x)] ? 1 : 0;
          valid += found != 0 ? 1 : 0;
        }
      }
    }
    // The states are of a kind that tells places apart.
    EXPECT_LT(alike, 2 * 9 * static_cast<int>(kWidth * kHeight) / 10);
    EXPECT_GT(valid, static_cast<int>(kWidth * kHeight) / 10);
  }
}

// Light without end, and light that is no number, is counted and is as no light: pictures and states are those of a
// lamp that has gone out, to the last bit, whether states that find nothing stay or not.
TEST_F(SsmmHardTest, LightThatIsNotFiniteIsAsNone) {
  for (const int keep : {0, 1}) {
    RenderSettings s = hard_settings();
    s.ssmm_keep = keep;
    const auto frames_of = [&](float emission) {
      auto renderer = make_renderer(s, kWidth, kHeight);
      scene::FrameSnapshot scene = wall_under_a_lamp();
      render_still(*renderer, scene, s, 6);
      scene.instances.back().emission = vec3(emission);
      std::vector<std::vector<std::uint32_t>> seen;
      for (int frame = 0; frame < 3; ++frame) {
        const auto before = renderer->read().counters().not_finite;
        renderer->render(scene, nullptr, s);
        EXPECT_EQ(renderer->read().counters().not_finite > before, !std::isfinite(emission)) << emission;
        for (const vec4& pixel : renderer->read().linear()) EXPECT_EQ(pixel.x, 0) << emission;
        seen.push_back(view_of(*renderer, scene, s, shared::kViewSsmmCount));
        seen.push_back(view_of(*renderer, scene, s, shared::kViewSsmmLobe));
      }
      return seen;
    };
    const auto dark = frames_of(0);
    EXPECT_EQ(frames_of(std::numeric_limits<float>::infinity()), dark) << keep;
    EXPECT_EQ(frames_of(std::numeric_limits<float>::quiet_NaN()), dark) << keep;
  }
}

// In a room that glows evenly scattering has no variance, so every pixel tells whether anything but scattering was
// sampled or weighed: not in a first frame, nor behind a cut, also where tiles are cut off.
TEST_F(SsmmHardTest, StatesThatAreAllInvalidLeaveScatteringAlone) {
  scene::FrameSnapshot scene = scene::furnace(0.6f, 0.7f);
  for (const int tile : {8, 16, 32}) {
    for (const int temporal : {0, 1}) {
      RenderSettings s = ssmm_settings("ssmm");
      s.ssmm_tile = tile;
      s.ssmm_temporal = temporal;
      s.spp = 1 + temporal;
      auto renderer = make_renderer(s, 45, 35);
      for (const bool cut : {false, true}) {
        scene.cut = cut;
        renderer->render(scene, nullptr, s);
        for (const vec4& pixel : renderer->read().linear())
          ASSERT_NEAR(pixel.x, 0.7 * (1 + 0.6 + 0.36), 1e-4) << tile << ' ' << temporal << ' ' << cut;
        scene.cut = false;
        render_still(*renderer, scene, s, 2);
      }
    }
  }
}

// A room that glows, in which one pixel sees a lamp as bright that reflects nothing: it has no path, and its place in
// the tile is kept. With one reflection all other pixels are as without it, whatever their lobes are: as wide or as
// narrow as the prior can make them, or on top of what is lit.
TEST_F(SsmmHardTest, OnePixelThatGlowsAndLobesOfAnyWidth) {
  const scene::FrameSnapshot room = scene::furnace(0.6f, 0.7f);
  scene::FrameSnapshot scene = room;
  auto assets = std::make_shared<scene::Assets>(*room.assets);
  const std::uint32_t light = scene::add_material(*assets, "lamp", vec3(0.0f), vec3(1.0f));
  const std::uint32_t sphere = scene::add_sphere_mesh(*assets);
  scene.assets = assets;
  // In the middle of a pixel beside the picture's centre, 100 units away.
  constexpr std::ptrdiff_t kLampPixel = (kHeight / 2) * kWidth + kWidth / 2;
  scene.instances.push_back(
      scene::glowing(scene::kIdEntityLight, sphere, light, vec3(100, -2.08f, -2.08f), vec3(1.5f), vec3(0.7f)));
  for (const float cosine : {0.0f, 1.0f}) {
    RenderSettings s = hard_settings();
    s.ssmm_prior = 1000;
    s.ssmm_prior_cosine = cosine;
    auto renderer = make_renderer(s, kWidth, kHeight);
    render_still(*renderer, scene, s, 8);
    double sum = 0, square = 0;
    constexpr int kFrames = 16;
    for (int frame = 0; frame < kFrames; ++frame) {
      renderer->render(scene, nullptr, s);
      std::vector<vec4> image = renderer->read().linear();
      EXPECT_EQ(image[kLampPixel].x, 0.7f);
      image.erase(image.begin() + kLampPixel);
      const ImageEstimate e = image_estimate(image);
      sum += e.mean / kFrames;
      square += e.error * e.error / (kFrames * kFrames);
    }
    EXPECT_NEAR(sum, 0.7 * 1.6, 5 * std::sqrt(square)) << cosine;
    EXPECT_LT(std::sqrt(square), 0.01) << cosine;
    EXPECT_EQ(renderer->read().counters().not_finite, 0u) << cosine;
  }
}

// The only light is a lamp of one pixel close to a wall: chains find it and pass it on, also over the pixel that has no
// path, and the wall has the mean of `nee`.
TEST_F(SsmmHardTest, OnePixelThatGlowsIsTheOnlyLight) {
  constexpr float kPixel = 2.0f * 80.0f / kWidth;  // 80 units away
  constexpr std::ptrdiff_t kLampPixel = (kHeight / 2) * kWidth + kWidth / 2;
  const scene::FrameSnapshot scene = wall_under_a_lamp(vec3(80, -kPixel / 2, -kPixel / 2), 0.35f * kPixel);
  const auto means = [&](const std::string& estimator) {
    Means found;
    std::ptrdiff_t valid = 0;
    RenderSettings s = hard_settings();
    s.estimator = estimator;
    for (s.seed = 0; s.seed < 8; ++s.seed) {
      auto renderer = make_renderer(s, kWidth, kHeight);
      double mean = 0;
      for (int frame = 0; frame < 32; ++frame) {
        renderer->render(scene, nullptr, s);
        std::vector<vec4> image = renderer->read().linear();
        EXPECT_EQ(image[kLampPixel].x, 300.0f);
        image.erase(image.begin() + kLampPixel);
        if (frame >= 16) mean += image_estimate(image).mean / 16;
      }
      EXPECT_EQ(renderer->read().counters().not_finite, 0u);
      if (estimator == "ssmm") valid = valid_states(*renderer, scene, s);
      found.add(mean);
    }
    if (estimator == "ssmm") {
      EXPECT_GT(valid, static_cast<std::ptrdiff_t>(kWidth * kHeight) / 2);
    }
    return found;
  };
  expect_equal(means("ssmm"), means("nee"), 0.04);
}

// Cells of the world are taught in every frame, by more pixels than one workgroup's: behind a cut, where the screen has
// nothing, more are known after many frames than after few.
TEST_F(SsmmHardTest, TheWorldIsTaughtInEveryFrame) {
  scene::FrameSnapshot scene = scene::one_light(16, 300, 0.5f);
  RenderSettings s = hard_settings();
  s.ssmm_world = 1;
  s.ssmm_prior_cosine = 0.99f;
  std::ptrdiff_t valid[2] = {};
  for (const bool many : {false, true}) {
    auto renderer = make_renderer(s, kWidth, kHeight);
    scene.cut = false;
    render_still(*renderer, scene, s, many ? 24 : 3);
    scene.cut = true;
    valid[many ? 1 : 0] = valid_states(*renderer, scene, s);
  }
  EXPECT_GT(valid[0], 0);
  EXPECT_GT(valid[1], 3 * valid[0]);
  EXPECT_GT(valid[1], static_cast<std::ptrdiff_t>(kWidth * kHeight) / 2);
}

// Settings away from their defaults: each makes another picture than all others, with the mean of `nee`.
TEST_F(SsmmHardSequences, SettingsThatLeaveTheMean) {
  struct Change {
    const char* name;
    void (*apply)(RenderSettings&);
  };
  const std::vector<Change> under_a_lamp = {
      {"as it is", [](RenderSettings&) {}},
      {"light alone", [](RenderSettings& s) { s.ssmm_product = 0; }},
      {"no least weight", [](RenderSettings& s) { s.ssmm_count = 1024, s.ssmm_alpha = 0.001f; }},
      {"one sample counted", [](RenderSettings& s) { s.ssmm_count = 1; }},
      {"many samples counted", [](RenderSettings& s) { s.ssmm_count = 1024; }},
      {"cells of the world", [](RenderSettings& s) { s.ssmm_world = 1; }},
      {"small cells", [](RenderSettings& s) { s.ssmm_world = 1, s.ssmm_cell = 4; }},
      {"states stay", [](RenderSettings& s) { s.ssmm_keep = 1; }},
  };
  const std::vector<Change> in_water = {
      {"targets where they appear", [](RenderSettings& s) { s.water = 1; }},
      {"targets on the interface", [](RenderSettings& s) { s.water = 1, s.ssmm_apparent = 0; }},
  };
  const auto means_of = [&](const scene::FrameSnapshot& scene, RenderSettings s) {
    Means means;
    for (s.seed = 0; s.seed < 8; ++s.seed) {
      auto renderer = make_renderer(s, 32, 24);
      double mean = 0;
      for (int frame = 0; frame < 16; ++frame) {
        renderer->render(scene, nullptr, s);
        if (frame >= 8) mean += mean_of(*renderer) / 8;
      }
      EXPECT_EQ(renderer->read().counters().not_finite, 0u);
      means.add(mean);
    }
    return means;
  };
  for (const auto& [scene, changes] : {std::pair(scene::one_light(24, 300, 0.5f), under_a_lamp),
                                       std::pair(scene::ripple({.sun_radius = 12, .lamps = true}), in_water)}) {
    RenderSettings plain = ssmm_settings("nee");
    plain.water = 1;
    const Means expected = means_of(scene, plain);
    std::set<std::uint64_t> pictures;
    for (const Change& change : changes) {
      SCOPED_TRACE(change.name);
      RenderSettings s = ssmm_settings("ssmm_nee");
      s.ssmm_prior_cosine = 0.99f;  // without it hardly a pixel has a state
      change.apply(s);
      expect_equal(means_of(scene, s), expected, 0.02);
      s.deterministic = 1;
      auto renderer = make_renderer(s, 32, 24);
      render_still(*renderer, scene, s, 12);
      EXPECT_TRUE(pictures.insert(image_hash(*renderer)).second) << "it changes nothing";
    }
  }
}

// A demo that goes back: the first frame behind it has no state of what came later, and frames repeat.
TEST_F(SsmmHardTest, GoingBackBeginsAnew) {
  const auto assets = scene::moving_assets();
  RenderSettings s = hard_settings();
  s.deterministic = 1;
  std::vector<std::uint64_t> hashes[2];
  for (std::vector<std::uint64_t>& of_run : hashes) {
    auto renderer = make_renderer(s, 33, 22);
    const auto play = [&](int frame, bool jumped) {
      scene::FrameSnapshot scene = scene::moving(assets, frame / 60.0, std::max(frame - 1, 0) / 60.0);
      scene.cut = jumped;
      return scene;
    };
    for (int frame = 0; frame < 12; ++frame) renderer->render(play(frame, false), nullptr, s);
    EXPECT_GT(valid_states(*renderer, play(12, false), s), 0);
    EXPECT_EQ(valid_states(*renderer, play(3, true), s), 0);
    for (int frame = 4; frame < 10; ++frame) {
      renderer->render(play(frame, false), nullptr, s);
      of_run.push_back(image_hash(*renderer));
    }
    EXPECT_EQ(renderer->read().counters().not_finite, 0u);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace fb::render
