// Guided paths under a control variate: it moves no mean and no direction, and takes variance away.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "render/techniques/test_pstf.h"
#include "scene/in_code/scene_of_kinds.h"

namespace fb::render {
namespace {

class McpgCvTest : public PstfTest {};

// A furnace's light, whatever the field holds; as Eq. 24 is printed it is another.
TEST_F(McpgCvTest, NothingIsLostOrAddedByAWrongField) {
  const scene::FrameSnapshot scene = lit_furnace();
  RenderSettings s = pstf_settings("mcpg_cv");
  s.pstf_learn_beta = 0;
  s.pstf_beta = 1;
  auto renderer = make_renderer(s, 64, 48);
  render_still(*renderer, scene, s, 5);
  expect_furnace(*renderer, 2, "a fixed factor");
  s.pstf_noise = 1;
  render_still(*renderer, scene, s, 3);
  expect_furnace(*renderer, 2, "a wrong field");
  s.pstf_noise = 0;
  s.pstf_form = 1;
  render_still(*renderer, scene, s, 1);
  const ImageEstimate printed = image_estimate(renderer->read().linear());
  const double light = static_cast<double>(kFieldEmission) * (1 + 0.6 + 0.36);
  EXPECT_GT(std::abs(printed.mean - light), 0.05 * light);
}

// Where no vertex has one, pictures are those of `mcpg`, but for how compilers round.
TEST_F(McpgCvTest, DirectionsAreThoseOfMcpg) {
  const scene::FrameSnapshot scene = scene::light_of_every_kind();
  std::vector<vec4> pictures[2];
  for (const int with : {0, 1}) {
    RenderSettings s = pstf_settings(with != 0 ? "mcpg_cv" : "mcpg", 3);
    s.deterministic = 1;
    s.pstf_vertices = 0;
    auto renderer = make_renderer(s, 48, 32);
    render_still(*renderer, scene, s, 2);
    pictures[with] = renderer->read().linear();
  }
  std::size_t apart = 0;
  for (std::size_t i = 0; i < pictures[0].size(); ++i)
    apart += std::abs(pictures[0][i].y - pictures[1][i].y) > 1e-3f * (pictures[0][i].y + 1e-3f) ? 1u : 0u;
  EXPECT_LT(apart, pictures[0].size() / 50);
}

}  // namespace
}  // namespace fb::render
