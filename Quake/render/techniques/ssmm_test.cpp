// Screen-space mixtures in the whole renderer: nothing is lost or added through cuts and changes of the picture's
// shape, at pixels without paths, or where no state holds light; the same pictures again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "render/techniques/test_ssmm.h"
#include "render/test_image.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

using SsmmSequences = SsmmTest;

TEST_F(SsmmSequences, CutsSizesAndTilesLeaveTheMeanAsItIs) {
  const scene::FrameSnapshot scene = scene::furnace(0.6f, 0.7f, true);
  const double expected = 0.7 * (1 + 0.6 + 0.36);
  for (const char* estimator : {"ssmm", "ssmm_nee"}) {
    RenderSettings s = ssmm_settings(estimator);
    auto renderer = make_renderer(s, 64, 48);
    const auto expect_mean = [&](const std::string& what) {
      const ImageEstimate e = image_estimate(renderer->read().linear());
      EXPECT_NEAR(e.mean, expected, 5 * e.error + 1e-5 * expected) << estimator << ", " << what;
      EXPECT_EQ(renderer->read().counters().not_finite, 0u) << estimator << ", " << what;
    };
    render_still(*renderer, scene, s, 4);
    expect_mean("four frames");
    scene::FrameSnapshot cut = scene;
    cut.cut = true;
    renderer->render(cut, nullptr, s);
    expect_mean("a cut");
    for (const int tile : {8, 16, 32}) {
      s.ssmm_tile = tile;
      for (const uvec2 size : {uvec2(33, 47), uvec2(1, 1), uvec2(97, 35)}) {
        renderer->resize(size.x, size.y);
        render_still(*renderer, scene, s, 3);
        if (size.x > 1) expect_mean("a resize");
      }
    }
    s.spp = 6;
    for (const int temporal : {0, 1}) {
      s.ssmm_temporal = temporal;
      render_still(*renderer, scene, s, 2);
      expect_mean("more samples");
    }
  }
}

// Where states do not stay they are lost in the dark, but at pixels without paths, which pass them on (here those that
// see the lamp itself), and come again with the light.
TEST_F(SsmmTest, LightThatGoesOutLeavesNoState) {
  RenderSettings s = ssmm_settings("ssmm");
  s.ssmm_keep = 0;
  s.ssmm_prior_cosine = 0.99f;
  auto renderer = make_renderer(s, 48, 36);
  const auto valid = [&](const scene::FrameSnapshot& scene) { return valid_states(*renderer, scene, s); };
  const scene::FrameSnapshot lit = scene::one_light(24, 300, 0.5f);
  scene::FrameSnapshot dark = lit;
  dark.instances.back().emission = vec3(0.0f);
  render_still(*renderer, lit, s, 16);
  EXPECT_GT(valid(lit), 48 * 36 / 4);
  render_still(*renderer, dark, s, 2);
  EXPECT_LT(valid(dark), 48 * 36 / 20);
  EXPECT_EQ(renderer->read().counters().not_finite, 0u);
  render_still(*renderer, lit, s, 16);
  EXPECT_GT(valid(lit), 48 * 36 / 4);
}

TEST_F(SsmmSequences, TheSamePicturesAgain) {
  const auto assets = scene::moving_assets();
  for (const bool temporal : {false, true}) {
    RenderSettings s = ssmm_settings(temporal ? "ssmm" : "ssmm_nee");
    s.deterministic = 1;
    s.ssmm_world = temporal ? 0 : 1;
    s.ssmm_temporal = temporal ? 1 : 0;
    s.spp = 2;
    std::vector<std::uint64_t> hashes[2];
    for (std::vector<std::uint64_t>& of_run : hashes) {
      auto renderer = make_renderer(s, 33, 22);
      for (int frame = 0; frame < 60; ++frame) {
        renderer->render(scene::moving(assets, frame / 60.0, std::max(frame - 1, 0) / 60.0), nullptr, s);
        of_run.push_back(image_hash(*renderer));
      }
    }
    EXPECT_EQ(hashes[0], hashes[1]) << s.estimator;
  }
}

// What the world keeps is there behind a cut, where the screen has nothing, and the mean is as it was.
TEST_F(SsmmTest, StatesOfTheWorldOutlastACut) {
  const scene::FrameSnapshot scene = scene::furnace(0.6f, 0.7f, true);
  const double expected = 0.7 * (1 + 0.6 + 0.36);
  for (const int world : {0, 1}) {
    RenderSettings s = ssmm_settings("ssmm");
    s.ssmm_world = world;
    auto renderer = make_renderer(s, 48, 36);
    render_still(*renderer, scene, s, 12);
    scene::FrameSnapshot cut = scene;
    cut.cut = true;
    const std::ptrdiff_t valid = valid_states(*renderer, cut, s);
    if (world != 0) {
      EXPECT_GT(valid, 48 * 36 / 2);
    } else {
      EXPECT_EQ(valid, 0);
    }
    double sum = 0, square = 0;
    for (int frame = 0; frame < 8; ++frame) {
      renderer->render(cut, nullptr, s);
      const ImageEstimate e = image_estimate(renderer->read().linear());
      sum += e.mean / 8;
      square += e.error * e.error / 64;
    }
    EXPECT_NEAR(sum, expected, 5 * std::sqrt(square) + 1e-5 * expected) << world;
    EXPECT_EQ(renderer->read().counters().not_finite, 0u);
    EXPECT_EQ(renderer->learnt_bytes(), 48 * 36 * 64 + (world != 0 ? 40u * shared::kSsmmCells + 16u : kEmptyArrays));
  }
}

// With one reflection and no other light a pixel is lit where its one path met the lamp.
std::ptrdiff_t lit_pixels(Renderer& renderer, const scene::FrameSnapshot& scene, const RenderSettings& s) {
  renderer.render(scene, nullptr, s);
  return std::ranges::count_if(renderer.read().linear(), [](const vec4& pixel) { return pixel.x > 0; });
}

// A lamp that goes out, or jumps, leaves states that find nothing; what is found anew takes their place and spreads,
// whether they stay (1) or are gone (0).
TEST_F(SsmmTest, StatesFollowALampThatJumps) {
  constexpr std::ptrdiff_t kPixels = 48 * 36;
  for (const int keep : {0, 1}) {
    SCOPED_TRACE(keep);
    RenderSettings s = ssmm_settings("ssmm");
    s.bounces = 1;
    s.ssmm_keep = keep;
    s.ssmm_prior_cosine = 0.99f;
    auto renderer = make_renderer(s, 48, 36);
    scene::FrameSnapshot scene = scene::one_light(8, 300, 0.5f);
    render_still(*renderer, scene, s, 16);
    const std::ptrdiff_t before = lit_pixels(*renderer, scene, s);
    EXPECT_GT(before, kPixels / 4);
    scene.instances.back().emission = vec3(0.0f);
    render_still(*renderer, scene, s, 8);
    scene.instances.back().emission = vec3(300.0f);
    scene.instances.back().transform[3] += vec3(40, 80, 50);
    scene.instances.back().prev_transform = scene.instances.back().transform;
    EXPECT_LT(lit_pixels(*renderer, scene, s), before / 4);
    render_still(*renderer, scene, s, 24);
    EXPECT_GT(lit_pixels(*renderer, scene, s), before / 2);
    EXPECT_EQ(renderer->read().counters().not_finite, 0u);
  }
}

// As it is set at first a state that found nothing stays in ssmm, and is gone in ssmm_nee.
TEST_F(SsmmTest, WhetherStatesStayIsTheEstimatorsChoice) {
  const scene::FrameSnapshot scene = scene::one_light(8, 300, 0.5f);
  const auto picture = [&](RenderSettings s, int keep) {
    s.deterministic = 1;
    s.ssmm_prior_cosine = 0.99f;
    s.ssmm_keep = keep;
    auto renderer = make_renderer(s, 33, 22);
    render_still(*renderer, scene, s, 12);
    return image_hash(*renderer);
  };
  for (const std::string estimator : {"ssmm", "ssmm_nee"}) {
    const RenderSettings s = ssmm_settings(estimator);
    const int chosen = estimator == "ssmm" ? 1 : 0;
    EXPECT_EQ(picture(s, s.ssmm_keep), picture(s, chosen)) << estimator;
    EXPECT_NE(picture(s, s.ssmm_keep), picture(s, 1 - chosen)) << estimator;
  }
}

// A lamp so small that a few pixels of a frame find it. States that stay become narrow, until their lobes find it
// again, and the few become many. Where what found nothing in a frame is gone a prior as narrow as the lamp is far does
// that, and one without direction loses it (Dittebrandt 2023, Fig. 6).
TEST_F(SsmmTest, WhatOnePixelFoundSpreads) {
  const scene::FrameSnapshot scene = scene::one_light(1, 300, 0.5f);
  const auto lit = [&](int keep, float cosine, int frames) {
    RenderSettings s = ssmm_settings("ssmm");
    s.bounces = 1;
    s.ssmm_keep = keep;
    s.ssmm_count = 1024;
    s.ssmm_prior_cosine = cosine;
    s.ssmm_prior_size = 1;
    auto renderer = make_renderer(s, 48, 36);
    render_still(*renderer, scene, s, frames);
    EXPECT_EQ(renderer->read().counters().not_finite, 0u);
    return lit_pixels(*renderer, scene, s);
  };
  constexpr std::ptrdiff_t kPixels = 48 * 36;
  EXPECT_LT(lit(0, 0, 160), kPixels / 50);
  EXPECT_GT(lit(0, -1, 80), kPixels / 4);
  EXPECT_GT(lit(1, 0, 160), kPixels / 4);
}

// Light that is not finite is counted and is black, and behind it the mean is right. That no state hears of it is asked
// in ssmm_hard_cases_test.cpp.
TEST_F(SsmmTest, BehindLightThatIsNotFiniteTheMeanIsRight) {
  const RenderSettings s = ssmm_settings("ssmm");
  auto renderer = make_renderer(s, 48, 36);
  scene::FrameSnapshot scene = scene::furnace(0.6f, 0.7f, true);
  const scene::Instance sphere = scene.instances[2];
  for (const float emission : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    scene::Instance& changed = scene.instances[2];
    changed.flags |= scene::kInstanceColor;
    changed.color = vec3(0.6f);
    changed.emission = vec3(emission);
    for (int frame = 0; frame < 4; ++frame) {
      const auto before = renderer->read().counters().not_finite;  // of all frames
      renderer->render(scene, nullptr, s);
      EXPECT_GT(renderer->read().counters().not_finite, before);
      const std::vector<vec4> image = renderer->read().linear();  // the sphere itself is seen as it is
      EXPECT_LT(std::ranges::count_if(image, [](const vec4& pixel) { return !std::isfinite(pixel.x); }), 48 * 36 / 8);
    }
    changed = sphere;
    const auto lost = renderer->read().counters().not_finite;
    for (int frame = 0; frame < 3; ++frame) {
      renderer->render(scene, nullptr, s);
      EXPECT_EQ(renderer->read().counters().not_finite, lost) << emission << ' ' << frame;
      const ImageEstimate e = image_estimate(renderer->read().linear());
      EXPECT_NEAR(e.mean, 0.7 * (1 + 0.6 + 0.36), 5 * e.error) << emission << ' ' << frame;
    }
  }
}

// Blocks of other sizes have other states; with some settings at their ends. Pixels that are not lit are black.
TEST_F(SsmmTest, ChangesOfTheLightsScaleLeaveTheMeanAsItIs) {
  const scene::FrameSnapshot scene = scene::furnace(0.6f, 0.7f, true);
  const double expected = 0.7 * (1 + 0.6 + 0.36);
  RenderSettings s = ssmm_settings("ssmm");
  s.denoise = 1;
  auto renderer = make_renderer(s, 71, 41);
  for (const float scale : {1.0f, 0.5f, 0.25f, 0.5f, 1.0f}) {
    s.light_scale = scale;
    s.ssmm_tile = scale == 0.5f ? 32 : 8;
    s.ssmm_keep = scale == 0.25f ? 0 : 1;
    s.ssmm_neighbors = scale == 1.0f ? 5 : 32;
    render_still(*renderer, scene, s, 6);
    std::vector<vec4> image = renderer->read().linear();
    std::erase_if(image, [](const vec4& pixel) { return pixel.x == 0; });
    const ImageEstimate e = image_estimate(image);
    EXPECT_NEAR(e.mean, expected, 5 * e.error) << scale;
    EXPECT_EQ(renderer->read().counters().not_finite, 0u) << scale;
    const std::uint64_t pixels = scale == 1.0f ? 71 * 41 : scale == 0.5f ? 36 * 21 : 18 * 11;
    EXPECT_NEAR(static_cast<double>(image.size()), static_cast<double>(pixels), 0.06 * static_cast<double>(pixels));
    EXPECT_EQ(renderer->learnt_bytes(), 64 * pixels + kEmptyArrays) << scale;
  }
}

// Lobes of a floor under a lamp point up, and are seen to.
TEST_F(SsmmTest, TheViewOfLobesShowsWhereTheyPoint) {
  const scene::FrameSnapshot scene = scene::one_light(16, 300, 0.5f);
  RenderSettings s = ssmm_settings("ssmm");
  s.bounces = 1;
  s.ssmm_prior_cosine = 0.99f;
  auto renderer = make_renderer(s, 48, 36);
  render_still(*renderer, scene, s, 16);
  int up = 0, valid = 0;
  for (const std::uint32_t pixel : view_of(*renderer, scene, s, shared::kViewSsmmLobe)) {
    const std::uint32_t red = pixel & 255u, green = (pixel >> 8) & 255u, blue = pixel >> 16;
    valid += pixel != 0 ? 1 : 0;
    up += blue > red && blue > green ? 1 : 0;
  }
  EXPECT_GT(valid, 48 * 36 / 2);
  EXPECT_GT(up, valid * 6 / 10);
}

// Lobes find what scattering seldom does: after some frames more paths of a frame bring light than pt's.
TEST_F(SsmmTest, ChainsMoveToTheLight) {
  const scene::FrameSnapshot scene = scene::cornell_box();
  int lit[2] = {};
  for (const bool mixes : {false, true}) {
    RenderSettings s = ssmm_settings(mixes ? "ssmm" : "pt");
    s.bounces = 1;
    auto renderer = make_renderer(s, 64, 48);
    render_still(*renderer, scene, s, 16);
    for (int frame = 0; frame < 4; ++frame) {
      s.seed = frame + 1;
      renderer->render(scene, nullptr, s);
      for (const vec4& pixel : renderer->read().linear()) lit[mixes ? 1 : 0] += pixel.y > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(lit[1], 1.5 * lit[0]);
}

}  // namespace
}  // namespace fb::render
