// Screen-space mixtures in the whole renderer: nothing is lost or added through cuts and changes of the picture's
// shape, at pixels without paths, or where no state holds light; the same pictures again.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "render/test_device.h"
#include "render/test_image.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/in_code/scene_of_kinds.h"
#include "scene/in_code/scenes_in_code.h"

namespace fb::render {
namespace {

class SsmmTest : public DeviceTest {
 protected:
  static RenderSettings ssmm_settings(const std::string& estimator) {
    RenderSettings s;
    s.estimator = estimator;
    s.accumulate = 0;
    return s;
  }
};

TEST_F(SsmmTest, CutsSizesAndTilesLeaveTheMeanAsItIs) {
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

// All states are lost in the dark, and come again with the light.
TEST_F(SsmmTest, LightThatGoesOutLeavesNoState) {
  RenderSettings s = ssmm_settings("ssmm");
  auto renderer = make_renderer(s, 48, 36);
  const auto valid = [&](const scene::FrameSnapshot& scene) {
    s.debug_view = static_cast<int>(shared::kViewSsmmCount);
    renderer->render(scene, nullptr, s);
    s.debug_view = 0;
    int count = 0;
    for (const std::uint32_t pixel : renderer->read().output()) count += (pixel & 0xffffffu) != 0 ? 1 : 0;
    return count;
  };
  const scene::FrameSnapshot lit = scene::furnace(0.6f, 0.7f, true), dark = scene::furnace(0.6f, 0.0f, true);
  render_still(*renderer, lit, s, 4);
  EXPECT_GT(valid(lit), 48 * 36 / 2);
  render_still(*renderer, dark, s, 2);
  EXPECT_EQ(valid(dark), 0);
  EXPECT_EQ(renderer->read().counters().not_finite, 0u);
  render_still(*renderer, lit, s, 4);
  EXPECT_GT(valid(lit), 48 * 36 / 2);
}

TEST_F(SsmmTest, TheSamePicturesAgain) {
  RenderSettings s = ssmm_settings("ssmm_nee");
  s.deterministic = 1;
  s.spp = 2;
  const scene::FrameSnapshot scene = scene::light_of_every_kind();
  std::vector<std::uint64_t> hashes[2];
  for (std::vector<std::uint64_t>& of_run : hashes) {
    auto renderer = make_renderer(s, 48, 32);
    for (int frame = 0; frame < 12; ++frame) {
      renderer->render(scene, nullptr, s);
      of_run.push_back(image_hash(*renderer));
    }
  }
  EXPECT_EQ(hashes[0], hashes[1]);
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
