// Fields of light where it is hard: more samples than a cell's sums have room for, light at the ends of what samples
// hold and beyond, light that is no number, places far from the origin, and time that goes back.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "render/techniques/test_pstf.h"
#include "render/techniques/test_wall.h"
#include "scene/in_code/code_scene_parts.h"
#include "scene/shapes.h"
#include "shared/tone.h"

namespace fb::render {
namespace {

using PstfHardTest = PstfTest;
using PstfHardSequences = PstfTest;

// The picture's green (0 to 255) where the field has this light.
double shown_field(float light, float exposure) {
  return 255 * static_cast<double>(shared::srgb_from_linear(shared::filmic(shared::vec3(light * exposure))).y);
}

// A million paths through six cells in a frame: sums have room for 8,191 samples of the most light. What is more says
// how many there are, so that the next frame takes a share of them.
TEST_F(PstfHardSequences, ACellOfAMillionSamples) {
  const float light = 40 / (1 - kFieldAlbedo), exposure = 0.2f / light;
  const scene::FrameSnapshot scene = scene::furnace(kFieldAlbedo, 40, false);
  RenderSettings s = pstf_settings("pstf_cv", 3);
  s.auto_exposure = 0;
  s.exposure = exposure;
  s.pstf_angle = 45;
  s.pstf_change = 0;
  s.pstf_train = 1;
  auto renderer = make_renderer(s, 32, 32);
  s.spp = 1024;
  render_still(*renderer, scene, s, 2);
  s.spp = 16;
  render_still(*renderer, scene, s, 40);
  EXPECT_NEAR(green_of(*renderer, scene, s, shared::kViewPstfField), shown_field(light, exposure), 3);
  expect_furnace(*renderer, 3, "few samples afterwards", 40);
}

// Samples are held to a luminance of 256, and next to nothing is a share of a step: the field is darker then, and no
// picture is.
TEST_F(PstfHardTest, LightAtItsEnds) {
  for (const float emission : {6e4f, 1e-6f}) {
    for (const char* estimator : {"pstf_cv", "pstf_is_cv"}) {
      const scene::FrameSnapshot scene = scene::furnace(kFieldAlbedo, emission, true);
      RenderSettings s = pstf_settings(estimator);
      s.pstf_learn_beta = 0;
      auto renderer = make_renderer(s, 48, 36);
      render_still(*renderer, scene, s, 6);
      expect_furnace(*renderer, 2, estimator, emission);
    }
  }
}

// Light that is no number is counted, and the field is that of a lamp that is dark, to the last bit.
TEST_F(PstfHardTest, LightThatIsNotFiniteIsAsNone) {
  for (const char* estimator : {"pstf_cv_nee", "pstf_is_cv"}) {
    for (const int gaussians : {0, 4}) {
      if (gaussians != 0 && estimator == std::string("pstf_cv_nee")) continue;
      RenderSettings s = pstf_settings(estimator);
      s.jitter = 0;
      s.pstf_gaussians = gaussians;
      const auto fields_of = [&](float radiance) {
        auto renderer = make_renderer(s, 48, 36);
        render_still(*renderer, wall_under_a_lamp(vec3(-60, 0, 0), 40, radiance), s, 6);
        EXPECT_EQ(renderer->read().counters().not_finite > 0, !std::isfinite(radiance)) << radiance;
        for (const vec4& pixel : renderer->read().linear()) EXPECT_TRUE(std::isfinite(pixel.x)) << radiance;
        const auto counted = renderer->read().counters().not_finite;
        render_still(*renderer, wall_under_a_lamp(vec3(-60, 0, 0), 40, 0), s, 1);
        EXPECT_EQ(renderer->read().counters().not_finite, counted) << "the field holds it";
        RenderSettings view = s;
        view.debug_view = static_cast<int>(shared::kViewPstfField);
        renderer->render(wall_under_a_lamp(vec3(-60, 0, 0), 40, 0), nullptr, view);
        return renderer->read().output();
      };
      const auto dark = fields_of(0);
      EXPECT_EQ(fields_of(std::numeric_limits<float>::infinity()), dark) << estimator;
      EXPECT_EQ(fields_of(std::numeric_limits<float>::quiet_NaN()), dark) << estimator;
    }
  }
}

TEST_F(PstfHardTest, ThirtyThousandUnitsAway) {
  scene::FrameSnapshot scene = lit_furnace();
  for (scene::Instance& instance : scene.instances)
    for (mat4x3* transform : {&instance.transform, &instance.prev_transform})
      (*transform)[3] += vec3(30000, -30000, 29000);
  scene.camera.position += vec3(30000, -30000, 29000);
  scene.prev_camera.position += vec3(30000, -30000, 29000);
  for (const char* estimator : {"pstf_cv_nee", "pstf_is_cv"}) {
    RenderSettings s = pstf_settings(estimator);
    auto renderer = make_renderer(s, 64, 48);
    render_still(*renderer, scene, s, 6);
    // Positions are rounded to 2^-9 there, so more rays start or end behind a surface.
    const ImageEstimate e = image_estimate(renderer->read().linear());
    const double a = static_cast<double>(kFieldAlbedo),
                 expected = static_cast<double>(kFieldEmission) * (1 + a + a * a);
    EXPECT_NEAR(e.mean, expected, 4.5 * e.error + 1e-3 * expected) << estimator;
    EXPECT_EQ(renderer->read().counters().not_finite, 0u) << estimator;
  }
}

// A demo that goes back, with the light of what moved still in the cells: the same pictures in another run, all finite.
TEST_F(PstfHardTest, GoingBackIsTheSameAgain) {
  const auto assets = scene::moving_assets();
  for (const int gaussians : {0, 8}) {
    RenderSettings s = pstf_settings("pstf_is_cv_nee");
    s.deterministic = 1;
    s.pstf_gaussians = gaussians;
    std::vector<std::uint64_t> hashes[2];
    for (std::vector<std::uint64_t>& of_run : hashes) {
      auto renderer = make_renderer(s, 33, 22);
      for (const int frame : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 3, 4, 5, 1, 2}) {
        scene::FrameSnapshot scene = scene::moving(assets, frame / 60.0, std::max(frame - 1, 0) / 60.0);
        scene.cut = frame == 3;
        renderer->render(scene, nullptr, s);
        of_run.push_back(image_hash(*renderer));
        EXPECT_EQ(renderer->read().counters().not_finite, 0u) << frame;
      }
    }
    EXPECT_EQ(hashes[0], hashes[1]) << gaussians;
  }
}

}  // namespace
}  // namespace fb::render
