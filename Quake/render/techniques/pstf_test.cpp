// Fields of light in the whole renderer: what a furnace's fields are; nothing lost or added through cuts, changes of
// size and whatever is set; the same pictures again; nothing remembered that is to be forgotten.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/techniques/test_pstf.h"
#include "render/test_image.h"
#include "scene/in_code/scene_of_kinds.h"
#include "scene/in_code/scenes_in_code.h"
#include "shared/tone.h"

namespace fb::render {
namespace {

using PstfSequences = PstfTest;

// Light from everywhere is the same, so that incident light is e / (1 - a) in all fields once they have settled,
// however few reflections paths have: fields take light on from field to field. With the ends of paths counted, too, as
// printed, they are darker.
TEST_F(PstfSequences, AFurnacesFieldHasItsClosedForm) {
  const scene::FrameSnapshot scene = lit_furnace();
  const float light = kFieldEmission / (1 - kFieldAlbedo), exposure = 0.2f;
  const auto shown = [&](float l) {
    return 255 * static_cast<double>(shared::srgb_from_linear(shared::filmic(shared::vec3(l * exposure))).y);
  };
  double ends[2] = {};
  for (const int counts : {0, 1}) {
    RenderSettings s = pstf_settings("pstf_cv_nee", 3);
    s.auto_exposure = 0;
    s.exposure = exposure;
    s.pstf_ends = counts;
    s.pstf_change = 0;
    auto renderer = make_renderer(s, 64, 48);
    render_still(*renderer, scene, s, 60);
    ends[counts] = green_of(*renderer, scene, s, shared::kViewPstfField);
  }
  EXPECT_NEAR(ends[0], shown(light), 1.5);
  EXPECT_LT(ends[1], shown(0.95f * light));
}

// Of any number of reflections where the field stands for paths, of as many as paths have where it is of whole paths,
// and the unbiased estimate alone where gamma is 1.
TEST_F(PstfSequences, BiasedFormsHaveAFurnacesLight) {
  const scene::FrameSnapshot scene = lit_furnace();
  const double e = static_cast<double>(kFieldEmission), a = static_cast<double>(kFieldAlbedo);
  const double all = e / (1 - a), four = e * (1 + a + a * a + a * a * a);
  struct Form {
    const char* name;
    int vertex;
    float gamma;
    int progressive;
    double expected;
  };
  const Form forms[] = {{"second vertices", 2, 0.5f, 1, all},
                        {"first vertices", 1, 0, 1, all},
                        {"half of first vertices", 1, 0.5f, 1, (all + four) / 2},
                        {"path space filtering", 1, 0, 0, four},
                        {"gamma 1", 1, 1, 1, four}};
  RenderSettings s = pstf_settings("pstf_b", 3);
  s.pstf_change = 0;
  auto renderer = make_renderer(s, 48, 36);
  for (const Form& form : forms) {
    s.pstf_vertex = form.vertex;
    s.pstf_gamma = form.gamma;
    s.pstf_progressive = form.progressive;
    renderer->reset_learning();
    render_still(*renderer, scene, s, form.vertex == 2 ? 100 : 60);  // what one of two paths sees is learnt later
    EXPECT_NEAR(image_estimate(renderer->read().linear()).mean, form.expected, 0.006 * form.expected) << form.name;
    EXPECT_EQ(renderer->read().counters().not_finite, 0u) << form.name;
  }
}

const std::pair<const char*, std::function<void(RenderSettings&)>> kFieldVariants[] = {
    {"defaults", {}},
    {"cells of the paper", [](RenderSettings& s) { s.pstf_key = 1, s.pstf_directions = 3; }},
    {"one normal", [](RenderSettings& s) { s.pstf_normals = 0; }},
    {"a full table", [](RenderSettings& s) { s.pstf_cells = 1024, s.pstf_pixels = 0, s.pstf_angle = 0.01f; }},
    {"one sample a cell", [](RenderSettings& s) { s.pstf_samples = 1; }},
    {"one cell", [](RenderSettings& s) { s.pstf_angle = 45, s.pstf_samples = 4096; }},
    {"a fixed factor", [](RenderSettings& s) { s.pstf_learn_beta = 0, s.pstf_beta = 2; }},
    {"a wrong field", [](RenderSettings& s) { s.pstf_learn_beta = 0, s.pstf_beta = 1, s.pstf_noise = 1; }},
    {"ends count", [](RenderSettings& s) { s.pstf_ends = 1, s.pstf_vertices = 1; }},
    {"trees alone, nearly", [](RenderSettings& s) { s.pstf_defence = 0.05f, s.pstf_split = 1; }},
    {"many samples", [](RenderSettings& s) { s.spp = 8; }},
    {"directions without rays",
     [](RenderSettings& s) { s.pstf_two_level = 3, s.pstf_learn_beta = 0, s.pstf_beta = 1; }},
    {"and a wrong field", [](RenderSettings& s) { s.pstf_two_level = 1, s.pstf_learn_beta = 0, s.pstf_noise = 2; }},
    {"4 Gaussians", [](RenderSettings& s) { s.pstf_gaussians = 4, s.pstf_defence = 0.1f; }},
    {"8 Gaussians", [](RenderSettings& s) { s.pstf_gaussians = 8, s.pstf_em = 0, s.pstf_defence = 0.1f; }},
};

TEST_F(PstfSequences, NothingIsLostOrAddedWhateverIsSet) {
  const scene::FrameSnapshot scene = lit_furnace();
  for (const char* estimator : {"pstf_cv", "pstf_is_cv_nee"}) {
    auto renderer = make_renderer(pstf_settings(estimator), 64, 48);
    for (const auto& [name, change] : kFieldVariants) {
      RenderSettings s = pstf_settings(estimator);
      if (change) change(s);
      render_still(*renderer, scene, s, 5);
      expect_furnace(*renderer, 2, std::string(estimator) + ", " + name);
    }
    RenderSettings s = pstf_settings(estimator);
    scene::FrameSnapshot cut = scene;
    cut.cut = true;
    renderer->render(cut, nullptr, s);
    expect_furnace(*renderer, 2, "a cut");
    for (const uvec2 size : {uvec2(33, 47), uvec2(1, 1), uvec2(97, 35)}) {
      renderer->resize(size.x, size.y);
      render_still(*renderer, scene, s, 3);
      if (size.x > 1) expect_furnace(*renderer, 2, "a resize");
    }
  }
}

// Black, white, and without any light.
TEST_F(PstfTest, AlbedosAtTheirEnds) {
  for (const float albedo : {0.0f, 1.0f}) {
    for (const float emission : {0.0f, 1.0f}) {
      const scene::FrameSnapshot scene = scene::furnace(albedo, emission, true);
      RenderSettings s = pstf_settings("pstf_cv_nee");
      s.pstf_learn_beta = 0;
      auto renderer = make_renderer(s, 48, 36);
      render_still(*renderer, scene, s, 6);
      const ImageEstimate e = image_estimate(renderer->read().linear());
      EXPECT_NEAR(e.mean, static_cast<double>(emission * (1 + albedo + albedo * albedo)), 5 * e.error + 1e-5);
      EXPECT_EQ(renderer->read().counters().not_finite, 0u);
    }
  }
}

TEST_F(PstfSequences, TheSamePicturesAgain) {
  RenderSettings s = pstf_settings("pstf_cv_nee");
  s.deterministic = 1;
  s.spp = 2;
  const scene::FrameSnapshot scene = scene::light_of_every_kind();
  std::vector<std::uint64_t> hashes[2];
  for (std::vector<std::uint64_t>& of_run : hashes) {
    auto renderer = make_renderer(s, 48, 32);
    for (int frame = 0; frame < 60; ++frame) {
      renderer->render(scene, nullptr, s);
      of_run.push_back(image_hash(*renderer));
    }
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST_F(PstfTest, AFieldThatIsForgottenIsDark) {
  const scene::FrameSnapshot scene = lit_furnace();
  RenderSettings s = pstf_settings("pstf_cv");
  auto renderer = make_renderer(s, 48, 36);
  render_still(*renderer, scene, s, 8);
  EXPECT_GT(green_of(*renderer, scene, s, shared::kViewPstfField), 40);
  renderer->reset_learning();
  EXPECT_LT(green_of(*renderer, scene, s, shared::kViewPstfField), 1) << "magenta: nothing is known";
}

// In a room with one lamp most light comes from one side: the factor is learnt, and the variance is less than without.
TEST_F(PstfTest, WhatIsKnownTakesVarianceAway) {
  const scene::FrameSnapshot scene = scene::cornell_box();
  double square[2] = {};
  for (const int applies : {0, 1}) {
    RenderSettings s = pstf_settings("pstf_cv_nee", 4);
    s.pstf_vertices = applies;
    s.jitter = 0;
    auto renderer = make_renderer(s, 64, 48);
    render_still(*renderer, scene, s, 32);
    std::vector<vec4> former;
    for (int frame = 0; frame < 12; ++frame) {
      renderer->render(scene, nullptr, s);
      const std::vector<vec4> now = renderer->read().linear();
      for (std::size_t i = 0; i < former.size(); ++i) {
        const double off = static_cast<double>(now[i].y - former[i].y);
        square[applies] += std::min(off * off, 1.0);
      }
      former = now;
    }
  }
  RecordProperty("gain", std::to_string(square[0] / square[1]));
  EXPECT_LT(square[1], square[0]);
}

}  // namespace
}  // namespace fb::render
